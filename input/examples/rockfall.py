"""The model of rockfall.fmcmd, built in Python.

Written by `tribo convert rockfall.fmcmd -o rockfall.py`: the commands in the order in which they run, with values
in place of variables.
"""

import tribo

m = tribo.Model("plane strain", title="Rockfall", units=("m", "kg", "s"), name="rockfall")
with m.header():
    m.text("""Units m, kg, s. Boulders roll and bounce down a hard slope onto soft soil, which yields under them (Mohr-Coulomb).""")
m.mpm_method("USL-", "B2SPLINE")
m.transfer("APIC")
m.cfl_factor(0.4)
m.maximum_time(5)
m.archive_time(0.05)
m.global_archive_time(0.01)
m.global_archive("dispx", block="hexagon")
m.global_archive("dispy", block="hexagon")
m.global_archive("turnz", block="hexagon")
m.global_archive("velx", block="hexagon")
m.multimaterial_mpm()
m.contact_mm("friction")
m.material("soil", "MohrCoulomb", rho=1800, E=2e7, nu=0.3, cohesion=1.5e4, friction=30, dilation=0)
m.material("boulder", "RigidContact")
m.material("friction", "CoulombFriction", coeff=0.5)
m.material("rock", "SpringNetwork", kn=1e7, ks=1e7, fric=0.6, dp_nratio=0.3, dp_sratio=0.3, dp_mode=3)
m.grid_horiz(135)
m.grid_vert(78)
m.grid_rect(-1, 26, -2.6, 13)
m.body("soil", tribo.polygon((0, -2), (25, -2), (25, 0), (12, 0), (0, 8)))
with m.blocks(lawname="rock", touchname="rock", damping=0):
    m.polygon_block(name="hexagon", matname="boulder", rho=2600, vx=2)
    m.points((1, 9.4), (1.7, 9.1), (2.3, 9.6), (2.2, 10.3), (1.5, 10.6), (0.9, 10.1))
    m.box_block(name="box", matname="boulder", angle=0, xmin=3.4, xmax=4.6, ymin=8.2, ymax=9.2, rho=2600, vx=1)
    m.polygon_block(name="octagon", matname="boulder", rho=2600)
    m.points((6.5081, 6.9105), (6.2105, 7.2081), (5.7895, 7.2081), (5.4919, 6.9105), (5.4919, 6.4895),
             (5.7895, 6.1919), (6.2105, 6.1919), (6.5081, 6.4895))
m.gravity(0, -9.81)
with m.grid_bc():
    m.line(-1, 26, -2, -2)
    m.velocity("x", "constant", 0)
    m.velocity("y", "constant", 0)
with m.grid_bc():
    m.line(0, 0, -3, 9)
    m.velocity("x", "constant", 0)
with m.grid_bc():
    m.line(25, 25, -3, 9)
    m.velocity("x", "constant", 0)

if __name__ == "__main__":
    m.run()
