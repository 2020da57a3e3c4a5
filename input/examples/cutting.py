"""The model of cutting.fmcmd, built in Python.

Written by `tribo convert cutting.fmcmd -o cutting.py`: the commands in the order in which they run, with values
in place of variables.
"""

import tribo

m = tribo.Model("plane strain", title="Orthogonal cutting", units=("mm", "g", "ms"), name="cutting")
with m.header():
    m.text("""Units mm, g, ms (MPa). The tool moves with 100 m/s, in plane strain. The block is held at its bottom. With APIC the error of the energy balance stays below 8 %.""")
m.mpm_method("USL-", "uGIMP")
m.transfer("APIC")
m.time_step(1, 0.01, 0.3)
m.archive_time(0.000416666666666667)
m.global_archive_time(4.16666666666667e-05)
m.global_archive("contactx", "tool")
m.global_archive("contacty", "tool")
m.global_archive("Plastic Energy")
m.global_archive("Friction Work")
m.to_archive("velocity", "displacement", "stress", "von_mises", "history", "material", "id")
m.multimaterial_mpm()
m.contact_mm("friction")
m.custom_task("AdjustTimeStep")
m.material("block", "IsoPlasticity", called="Aluminium", properties={"rho": 2.7e-3, "E": 70e3, "nu": 0.33,
           "hardening": "Linear", "yield": 300, "Ep": 100})
m.material("tool", "RigidContact", called="Tool")
m.material("friction", "CoulombFriction", called="Friction", coeff=0.2)
m.grid_horiz(168)
m.grid_vert(96)
m.grid_rect(-1.2, 3, -0.2, 2.2)
m.body("block", tribo.rect(0, 2, 0, 0.8))
m.body("tool", tribo.polygon((0, 0.6), (-0.436764281119443, 1.8), (-0.936764281119443, 1.8), (-0.5, 0.68)),
       velocity=(100, 0))
with m.grid_bc():
    m.rect(-1.2, 3, -0.2, 0)
    m.velocity("x", "constant", 0)
    m.velocity("y", "constant", 0)

if __name__ == "__main__":
    m.run()
