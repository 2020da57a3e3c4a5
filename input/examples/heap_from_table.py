"""The model of heap_from_table.fmcmd, built in Python.

Written by `tribo convert heap_from_table.fmcmd -o heap_from_table.py`: the commands in the order in which they run, with values
in place of variables.
"""

import tribo

m = tribo.Model("plane strain", title="A heap from a table", units=("m", "kg", "s"), name="heap_from_table")
with m.header():
    m.text("""Units m, kg, s. Each row of heap_from_table.csv is a particle with its position, its size (0.05 or 0.1) and its stress, which is due
to the weight of the sand above it. The left slope is steeper than the angle of friction and slides.""")
m.mpm_method("USL-", "uGIMP")
m.transfer("APIC")
m.time_step(1, 0.6, 0.4)
m.archive_time(0.05)
m.global_archive_time(0.01)
m.global_archive("maxy", "sand")
m.global_archive("Kinetic Energy")
m.material("sand", "MohrCoulomb", called="Sand", rho=1500, E=5e6, nu=0.3, cohesion=0, friction=31, dilation=0)
m.grid_horiz(50, 0, -1)
m.grid_vert(22)
m.grid_rect(0, 5, -0.2, 2)
m.particle_table("sand", "heap_from_table.csv")
with m.grid_bc():
    m.rect(0, 5, -0.2, 0)
    m.velocity("x", "constant", 0)
    m.velocity("y", "constant", 0)
m.gravity(0, -9.81)

if __name__ == "__main__":
    m.run()
