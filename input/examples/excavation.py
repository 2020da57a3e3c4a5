"""The model of excavation.fmcmd, built in Python.

Written by `tribo convert excavation.fmcmd -o excavation.py`: the commands in the order in which they run, with values
in place of variables.
"""

import tribo

m = tribo.Model("plane strain", title="Excavation in stages", units=("m", "kg", "s"), name="excavation")
with m.header():
    m.text("""Units m, kg, s. The ground is at rest under its weight with K0 = 0.5. Two metres of ground are removed at a time. The floor heaves, and the wall leans into the pit.""")
m.mpm_method("USL-", "uGIMP")
m.transfer("APIC")
m.time_step(1, 4, 0.4)
m.damping(4)
m.archive_time(0.2)
m.global_archive_time(0.02)
m.global_archive("dispx", 5.3, -0.3)
m.global_archive("dispy", 0.3, -6.3)
m.global_archive("Kinetic Energy")
m.to_archive("velocity", "displacement", "stress", "pressure", "von_mises", "history", "material", "id")
m.material("clay", "MohrCoulomb", called="Clay", rho=1900, E=4e7, nu=0.3, cohesion=30000, friction=25, dilation=0)
m.material("concrete", "LinearElastic", called="Concrete", rho=2400, E=4e8, nu=0.2)
m.grid_rect(0, 24, -14, 2)
m.grid_horiz(48, 0, -1, 24)
m.grid_vert(32, -14, -1)
with m.region("clay", 0, 0):
    m.initial_stress("K0", 0.5)
    m.rect(0, 24, -14, 0)
m.gravity(0, -10)
with m.stage(0.8, "lift 1"):
    with m.excavate():
        m.rect(0, 5, -2, 0)
with m.stage(1.6, "lift 2"):
    with m.excavate():
        m.rect(0, 5, -4, -2)
with m.stage(2.4, "lift 3"):
    with m.excavate():
        m.rect(0, 5, -6, -4)
with m.stage(3.2, "slab"):
    m.body("concrete", tribo.rect(0, 5, -6, -5))

if __name__ == "__main__":
    m.run()
