"""The model of granular_column.fmcmd, built in Python.

Written by `tribo convert granular_column.fmcmd -o granular_column.py`: the commands in the order in which they run, with values
in place of variables.
"""

import tribo

m = tribo.Model("plane strain", title="Collapse of a granular column", units=("m", "kg", "s"), name="granular_column")
with m.header():
    m.text("""Units m, kg, s. The half width of the column is 1, so lengths such as the run-out are in half widths.""")
m.mpm_method("USL-", "uGIMP")
m.transfer("APIC")
m.time_step(1, 1.5, 0.4)
m.archive_time(0.05)
m.global_archive_time(0.02)
m.global_archive("posx", "sand")
m.global_archive("maxx", "sand")
m.global_archive("maxy", "sand")
m.global_archive("Kinetic Energy")
m.material("sand", "MohrCoulomb", called="Sand", rho=1500, E=5e6, nu=0.3, cohesion=0, friction=31, dilation=0)
m.grid_horiz(100, 0, -1)
m.grid_vert(32)
m.grid_rect(0, 5, -0.2, 1.4)
m.body("sand", tribo.rect(0, 1, 0, 1))
with m.grid_bc():
    m.rect(0, 5, -0.2, 0)
    m.velocity("x", "constant", 0)
    m.velocity("y", "constant", 0)
m.gravity(0, -9.81)

if __name__ == "__main__":
    m.run()
