"""The model of dam_break.fmcmd, built in Python.

Written by `tribo convert dam_break.fmcmd -o dam_break.py`: the commands in the order in which they run, with values
in place of variables.
"""

import tribo

m = tribo.Model("plane strain", title="Dam break against a wall", units=("m", "kg", "s"), name="dam_break")
with m.header():
    m.text("""Units m, kg, s. The column is twice as high as wide, as in the experiments of Martin & Moyce (1952). The water is modelled as
more compressible than real water: pressure waves travel at 30 m/s, about ten times the speed of the flow.""")
m.mpm_method("USL-", "uGIMP")
m.transfer("APIC")
m.time_step(1, 0.8, 0.3)
m.archive_time(0.03)
m.global_archive_time(0.005)
m.global_archive("maxx", "water")
m.global_archive("maxy", "water")
m.global_archive("Kinetic Energy")
m.material("water", "TaitLiquid", called="Water", rho=1000, K=9e5, viscosity=1e-3)
m.grid_horiz(80, 0, -1, 2)
m.grid_vert(120, 0, -1)
m.grid_rect(0, 2, 0, 3)
m.body("water", tribo.rect(0, 0.5, 0, 1))
m.gravity(0, -9.81)

if __name__ == "__main__":
    m.run()
