"""The model of slope_failure.fmcmd, built in Python.

Written by `tribo convert slope_failure.fmcmd -o slope_failure.py`: the commands in the order in which they run, with values
in place of variables.
"""

import tribo

m = tribo.Model("plane strain", title="Failure of a slope", units=("m", "kg", "s"), name="slope_failure")
with m.header():
    m.text("""Units m, kg, s. Gravity acts suddenly. Where the soil has sheared by 10 %, the cohesion has fallen to its residual value.""")
m.mpm_method("USL-", "uGIMP")
m.transfer("APIC")
m.time_step(1, 8, 0.4)
m.archive_time(0.25)
m.global_archive_time(0.05)
m.global_archive("maxx", "soil")
m.global_archive("dispx", "soil")
m.global_archive("Kinetic Energy")
m.global_archive("Plastic Energy")
m.to_archive("velocity", "displacement", "stress", "pressure", "von_mises", "history", "material", "id")
m.material("soil", "MohrCoulomb", called="Soil", rho=2000, E=2e7, nu=0.3, cohesion=12000, friction=20, dilation=0,
           cohesion_residual=1000, softening_end=0.1)
m.grid_rect(0, 50, -4, 12)
m.grid_horiz(100, 0, -1)
m.grid_vert(32)
m.body("soil", tribo.polygon((0, -4), (48, -4), (48, 0), (24, 0), (12, 10), (0, 10)))
with m.grid_bc():
    m.line(0, 50, -4, -4)
    m.velocity("x", "constant", 0)
    m.velocity("y", "constant", 0)
with m.grid_bc():
    m.line(48, 48, -4, 0.1)
    m.velocity("x", "constant", 0)
m.gravity(0, -10)

if __name__ == "__main__":
    m.run()
