"""The model of silo_discharge.fmcmd, built in Python.

Written by `tribo convert silo_discharge.fmcmd -o silo_discharge.py`: the commands in the order in which they run, with values
in place of variables.
"""

import tribo

m = tribo.Model("plane strain", title="A silo that empties", units=("m", "kg", "s"), name="silo_discharge")
with m.header():
    m.text("""Units m, kg, s. Sand in a silo with a flat floor flows out through a slot. Sand that has left the grid below the slot is removed. According to Beverloo's law the flow depends on the width W of the slot alone, not on the height of the filling: the mass per time is about rho sqrt(g) W^1.5 for a slot of unit length. The model is one half of the silo.""")
m.mpm_method("USL-", "B2SPLINE")
m.transfer("APIC")
m.time_step(1, 1.2, 0.4)
m.archive_time(0.05)
m.global_archive_time(0.01)
m.leave_limit(-1000000)
m.global_archive("mass", "sand")
m.global_archive("maxy", "sand")
m.global_archive("contacty", "silo")
m.to_archive("velocity", "displacement", "stress", "pressure", "volume_ratio", "material", "id")
m.multimaterial_mpm()
m.contact_mm("friction")
m.material("silo", "RigidContact", called="Silo")
m.material("sand", "MohrCoulomb", called="Sand", rho=1500, E=1e6, nu=0.3, cohesion=0, friction=30, dilation=0)
m.material("friction", "CoulombFriction", called="Friction", coeff=0.3)
m.grid_rect(0, 0.66, -0.42, 1.17)
m.grid_horiz(22, 0, -1)
m.grid_vert(53)
m.body("silo", tribo.polygon((0.15, 0), (0.63, 0), (0.63, -0.2), (0.35, -0.2)), tribo.rect(0.51, 0.63, 0, 1.14))
with m.region("sand", 0, 0):
    m.initial_stress("K0", 0.5)
    m.rect(0, 0.51, 0, 0.99)
m.gravity(0, -9.81)

if __name__ == "__main__":
    m.run()
