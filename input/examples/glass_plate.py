"""The model of glass_plate.fmcmd, built in Python.

Written by `tribo convert glass_plate.fmcmd -o glass_plate.py`: the commands in the order in which they run, with values
in place of variables.
"""

import tribo

m = tribo.Model("plane strain", title="A ball breaks a glass plate", units=("mm", "g", "ms"), name="glass_plate")
with m.header():
    m.text("""Units mm, g, ms (MPa). A steel ball (in plane strain, a cylinder) hits a plate of glass between two supports. The glass (IsoSoftening) breaks where its tensile strength is reached, first on the side opposite to the ball. The ball breaks through the plate and goes on with a smaller velocity.""")
m.mpm_method("USL-", "lCPDI")
m.transfer("APIC")
m.time_step(1, 0.28, 0.4)
m.archive_time(0.014)
m.global_archive_time(0.000933333333333333)
m.global_archive("vely", "ball")
m.global_archive("contacty", "ball")
m.global_archive("Kinetic Energy")
m.global_archive("Plastic Energy")
m.to_archive("velocity", "displacement", "stress", "von_mises", "plastic_energy", "history", "volume_ratio",
             "material", "id")
m.multimaterial_mpm()
m.material("ball", "NeoHookean", called="Ball", rho=7.8e-3, E=70e3, nu=0.3)
m.material("supports", "RigidContact", called="Supports")
m.material("glass", "IsoSoftening", called="Glass", properties={"rho": 2.5e-3, "E": 70e3, "nu": 0.22, "sigmac": 60,
           "I-Gc": 0.05, "Initiation": "MaxPrinciple", "SofteningI": "Linear"})
m.grid_rect(-54, 54, -24, 28)
m.grid_horiz(108)
m.grid_vert(52)
m.body("supports", tribo.rect(-45, -35, -6, 0), tribo.rect(35, 45, -6, 0))
m.body("glass", tribo.rect(-50, 50, 0, 6))
m.body("ball", tribo.oval(-8, 8, 6.5, 22.5), velocity=(0, -10))

if __name__ == "__main__":
    m.run()
