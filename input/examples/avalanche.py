"""The model of avalanche.fmcmd, built in Python.

Written by `tribo convert avalanche.fmcmd -o avalanche.py`: the commands in the order in which they run, with values
in place of variables.
"""

import tribo

m = tribo.Model("plane strain", title="An avalanche against a wall", units=("m", "kg", "s"), name="avalanche")
with m.header():
    m.text("""Units m, kg, s. The x axis runs down the slope: the slope is drawn level, and gravity is inclined by its angle. Dry sand slides down, meets a rigid retaining wall, and comes to rest as a wedge behind the wall. The force on the wall first exceeds the one that remains at the end, which is the static thrust of the deposit.""")
m.mpm_method("USL-", "B2SPLINE")
m.transfer("APIC")
m.time_step(1, 3, 0.4)
m.archive_time(0.1)
m.global_archive_time(0.02)
m.global_archive("contactx", "wall")
m.global_archive("posx", "sand")
m.global_archive("maxy", "sand")
m.global_archive("Kinetic Energy")
m.to_archive("velocity", "displacement", "stress", "pressure", "volume_ratio", "material", "id")
m.multimaterial_mpm()
m.contact_mm("friction")
m.material("slope", "RigidContact", called="Slope")
m.material("wall", "RigidContact", called="Wall")
m.material("sand", "MohrCoulomb", called="Sand", rho=1600, E=2e6, nu=0.3, cohesion=0, friction=33, dilation=0)
m.material("friction", "CoulombFriction", called="Friction", coeff=0.4)
m.grid_rect(-0.4, 6, -0.4, 2.8)
m.grid_horiz(64)
m.grid_vert(32)
m.body("slope", tribo.rect(-0.3, 5.9, -0.3, 0))
m.body("wall", tribo.rect(5, 5.3, 0, 2.5))
m.body("sand", tribo.polygon((0.5, 0), (3, 0), (3, 0.5), (2.5, 1), (1.5, 1)))
m.gravity(5.62678484060376, -8.03588155447501)

if __name__ == "__main__":
    m.run()
