"""The model of two_rings.fmcmd, built in Python.

Written by `tribo convert two_rings.fmcmd -o two_rings.py`: the commands in the order in which they run, with values
in place of variables.
"""

import tribo

m = tribo.Model("plane strain", title="Contact of two rings", units=("mm", "g", "ms"), name="two_rings")
with m.header():
    m.text("""Units mm, g, ms (MPa). Two hollow rubber rings meet head on without friction, so that two thin bodies with large deformations are in contact. The contact impulses on the two rings are equal and opposite, so that their momenta remain equal and opposite. A part of the kinetic energy becomes vibration of the rings.""")
m.mpm_method("USL+", "B2SPLINE")
m.transfer("APIC")
m.time_step(1, 8, 0.4)
m.archive_time(0.5)
m.global_archive_time(0.05)
m.global_archive("velx", "left")
m.global_archive("velx", "right")
m.global_archive("contactx", "right")
m.global_archive("Kinetic Energy")
m.global_archive("Strain Energy")
m.multimaterial_mpm()
m.material("left", "NeoHookean", called="Left", rho=1e-3, E=10, nu=0.4)
m.material("right", "NeoHookean", called="Right", rho=1e-3, E=10, nu=0.4)
m.grid_horiz(128)
m.grid_vert(64)
m.grid_rect(-80, 80, -40, 40)
m.body("left", tribo.oval(-41.25, -1.25, -20, 20) - tribo.oval(-36.25, -6.25, -15, 15), velocity=(10, 0))
m.body("right", tribo.oval(1.25, 41.25, -20, 20) - tribo.oval(6.25, 36.25, -15, 15), velocity=(-10, 0))

if __name__ == "__main__":
    m.run()
