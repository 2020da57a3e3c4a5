"""The model of dcb.fmcmd, built in Python.

Written by `tribo convert dcb.fmcmd -o dcb.py`: the commands in the order in which they run, with values
in place of variables.
"""

import tribo

m = tribo.Model("plane strain", title="A double cantilever beam", units=("mm", "g", "ms"), name="dcb")
with m.header():
    m.text("""Units mm, g, ms (MPa). The faces of the crack are free along the notch. Beyond the notch they carry a cohesive zone with a cubic traction law. The loads act at x = 0, where the two beams are pulled apart with a constant acceleration.""")
m.mpm_method("USL-", "B2SPLINE")
m.transfer("APIC")
m.time_step(1, 2, 0.5)
m.archive_time(0.5)
m.global_archive_time(0.02)
m.global_archive("reactiony", -1)
m.global_archive("Decohesion")
m.material("arm", "Isotropic", rho=1.2e-3, E=3000, nu=0.3)
m.material("glue", "CubicTraction", sigmaI=0.66, JIc=0.091, sigmaII=0.66, JIIc=0.091)
m.grid_horiz(70)
m.grid_vert(22)
m.grid_rect(-6, 64, -11, 11)
m.body("arm", tribo.rect(-2, 54, -6, 6))
m.new_crack(-3, 0)
m.grow_crack_line(18, 0)
m.grow_crack_line(55, 0, 74, "free", "glue")
with m.grid_bc():
    m.line(0, 0, 2.6, 9)
    m.boundary_id(-1)
    m.velocity("y", "linear", 0.35)
with m.grid_bc():
    m.line(0, 0, -9, -2.6)
    m.boundary_id(-2)
    m.velocity("y", "linear", -0.35)

if __name__ == "__main__":
    m.run()
