"""The model of rockfall_barrier.fmcmd, built in Python.

Written by `tribo convert rockfall_barrier.fmcmd -o rockfall_barrier.py`: the commands in the order in which they run, with values
in place of variables.
"""

import tribo

m = tribo.Model("plane strain", title="A rockfall barrier", units=("m", "kg", "s"), name="rockfall_barrier")
with m.header():
    m.text("""Units m, kg, s. A boulder bounces and rolls down a rigid slope and is caught by a ductile wall, which stands in a slot of the floor and is held at its foot. Boulder, slope and floor are rigid blocks and interact by a joint law. The wall is an elastic-plastic body in the grid and interacts with the boulder by contact. The plastic work in the wall and the impact itself take most of the energy of the boulder.""")
m.mpm_method("USL-", "B2SPLINE")
m.transfer("APIC")
m.cfl_factor(0.4)
m.maximum_time(1.4)
m.archive_time(0.06)
m.global_archive_time(0.01)
m.global_archive("dispx", block="boulder")
m.global_archive("velx", block="boulder")
m.global_archive("contactx", "material", "wall", "with", "stone")
m.global_archive("Plastic Energy")
m.multimaterial_mpm()
m.contact_mm("friction")
m.material("wall", "IsoPlasticity", properties={"rho": 2000, "E": 2e8, "nu": 0.3, "yield": 4000000, "Khard": 2e6})
m.material("stone", "RigidContact")
m.material("ground", "RigidContact")
m.material("back", "RigidContact")
m.material("friction", "CoulombFriction", coeff=0.4)
m.material("rock", "SpringNetwork", kn=2e7, ks=2e7, fric=0.5, dp_nratio=0.3, dp_sratio=0.3, dp_mode=3)
m.grid_horiz(140)
m.grid_vert(56)
m.grid_rect(1, 15, -1.2, 4.4)
m.body("wall", tribo.rect(10.6, 11, -0.6, 2))
with m.blocks(lawname="rock", touchname="rock"):
    m.polygon_block(name="boulder", matname="stone", rho=2600, vx=4.2875, vy=-2.5725, spinz=-8)
    m.points((4.7452, 2.9937), (4.5385, 3.2661), (4.205, 3.342), (3.9007, 3.1857), (3.7681, 2.8704), (3.8692, 2.5437),
             (4.1567, 2.3583), (4.496, 2.4011), (4.7284, 2.652))
    m.polygon_block(name="slope", matname="ground", rho=2600)
    m.points((1.4, -0.6), (8, -0.6), (8, 0), (1.4, 3.96))
    m.box_block(name="floor", matname="ground", rho=2600, xmin=8, xmax=10.6, ymin=-0.6, ymax=0)
    m.box_block(name="floor", matname="back", rho=2600, xmin=11, xmax=14.6, ymin=-0.6, ymax=0)
    m.hold(vx=0, vy=0, spinz=0)
    m.rect(1, 4, -1, 2)
    m.rect(8, 14, -0.5, -0.1)
m.gravity(0, -9.81)
with m.grid_bc():
    m.rect(10.5, 11.1, -0.75, -0.45)
    m.velocity("x", "constant", 0)
    m.velocity("y", "constant", 0)

if __name__ == "__main__":
    m.run()
