"""The model of brazilian_test.fmcmd, built in Python.

Written by `tribo convert brazilian_test.fmcmd -o brazilian_test.py`: the commands in the order in which they run, with values
in place of variables.
"""

import tribo

m = tribo.Model("plane strain", title="Brazilian test", units=("mm", "g", "ms"), name="brazilian_test")
with m.header():
    m.text("""Units mm, g, ms (MPa). A disc of a brittle solid (IsoSoftening) between rigid platens splits along the loaded diameter. Under the force P the tension across this diameter is 2 P/(pi D t) in a disc of diameter D, radius R and thickness t. The largest force is therefore P = pi R t f, where f is the tensile strength.""")
m.mpm_method("USL-", "lCPDI")
m.transfer("FMPM", 2)
m.time_step(1, 0.5, 0.4)
m.archive_time(0.025)
m.global_archive_time(0.001)
m.global_archive("contacty", "top")
m.global_archive("contacty", "bottom")
m.global_archive("sxx", 0.1, 0.1)
m.to_archive("velocity", "displacement", "stress", "von_mises", "history", "volume_ratio", "material", "id")
m.xml_data("MPMHeader", """
<MultiMaterialMode Impulses='faces'/>
""")
m.material("top", "RigidContact", called="Top")
m.material("bottom", "RigidContact", called="Bottom")
m.material("rock", "IsoSoftening", called="Rock", properties={"rho": 2.5e-3, "E": 20000, "nu": 0.2, "sigmac": 5,
           "I-Gc": 0.015, "Initiation": "MaxPrinciple", "SofteningI": "Linear"})
m.grid_rect(-30, 30, -32, 32)
m.grid_horiz(30)
m.grid_vert(32)
m.body("top", tribo.rect(-10, 10, 25, 29), velocity=(0, -0.2))
m.body("bottom", tribo.rect(-10, 10, -29, -25), velocity=(0, 0.2))
m.body("rock", tribo.oval(-25, 25, -25, 25))

if __name__ == "__main__":
    m.run()
