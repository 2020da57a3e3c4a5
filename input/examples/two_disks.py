"""The model of two_disks.fmcmd, built in Python.

Written by `tribo convert two_disks.fmcmd -o two_disks.py`: the commands in the order in which they run, with values
in place of variables.
"""

import tribo

m = tribo.Model("plane strain", title="Two rubber disks collide", units=("mm", "g", "ms"), name="two_disks")
with m.header():
    m.text("""Units mm, g, ms (MPa). Each disk has a velocity field of its own and meets the other by contact without friction.""")
m.mpm_method("USL+", "B2SPLINE")
m.transfer("FMPM", 4)
m.time_step(1, 2, 0.3)
m.archive_time(0.05)
m.global_archive_time(0.01)
m.multimaterial_mpm()
m.material("left", "NeoHookean", rho=1.2e-3, E=60, nu=0.33)
m.global_archive("velx", "left")
m.global_archive("contactx", "left")
m.material("right", "NeoHookean", rho=1.2e-3, E=60, nu=0.33)
m.global_archive("velx", "right")
m.global_archive("contactx", "right")
m.global_archive("Kinetic Energy")
m.global_archive("Strain Energy")
m.grid_horiz(120)
m.grid_vert(52)
m.grid_rect(-60, 60, -26, 26)
m.body("left", tribo.oval(-45, -15, -15, 15), velocity=(25, 0))
m.body("right", tribo.oval(15, 45, -15, 15), velocity=(-25, 0))

if __name__ == "__main__":
    m.run()
