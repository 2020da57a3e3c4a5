"""The model of brick_wall.fmcmd, built in Python.

Written by `tribo convert brick_wall.fmcmd -o brick_wall.py`: the commands in the order in which they run, with values
in place of variables.
"""

import tribo

m = tribo.Model("3d", title="A wall of bricks", units=("m", "kg", "s"), name="brick_wall")
with m.header():
    m.text("""Units m, kg, s. A ball of stone breaks through a dry wall. Neighbouring bricks touch at the corners of their common faces, with friction. Bricks that meet during the run form new contacts.""")
m.time_step(1e-3, 1.2)
m.archive_time(0.04)
m.global_archive_time(0.01)
m.global_archive("dispz", block="ball")
m.global_archive("velz", block="ball")
m.global_archive("kinetic energy")
m.material("rub", "SpringNetwork", kn=5e8, ks=5e8, krot="0 0 0", fric=0.6, dp_nratio=0.2, dp_sratio=0.2, dp_mode=3)
with m.blocks(lawname="rub", touchname="rub", points="corners", damping=0.02):
    m.box_block(name="floor", xmin=-0.8, xmax=2.4, ymin=-0.1, ymax=0, zmin=-1, zmax=3.4, rho=2500)
    m.ball(name="ball", x=0.8, y=0.8, z=-0.5, radius=0.3, rho=2500, vz=8)
    m.box_block(xmin=0, xmax=0.4, ymin=0, ymax=0.2, zmin=0, zmax=0.2, rho=1800)
    m.box_block(xmin=0.4, xmax=0.8, ymin=0, ymax=0.2, zmin=0, zmax=0.2, rho=1800)
    m.box_block(xmin=0.8, xmax=1.2, ymin=0, ymax=0.2, zmin=0, zmax=0.2, rho=1800)
    m.box_block(xmin=1.2, xmax=1.6, ymin=0, ymax=0.2, zmin=0, zmax=0.2, rho=1800)
    m.box_block(xmin=0, xmax=0.2, ymin=0.2, ymax=0.4, zmin=0, zmax=0.2, rho=1800)
    m.box_block(xmin=0.2, xmax=0.6, ymin=0.2, ymax=0.4, zmin=0, zmax=0.2, rho=1800)
    m.box_block(xmin=0.6, xmax=1, ymin=0.2, ymax=0.4, zmin=0, zmax=0.2, rho=1800)
    m.box_block(xmin=1, xmax=1.4, ymin=0.2, ymax=0.4, zmin=0, zmax=0.2, rho=1800)
    m.box_block(xmin=1.4, xmax=1.6, ymin=0.2, ymax=0.4, zmin=0, zmax=0.2, rho=1800)
    m.box_block(xmin=0, xmax=0.4, ymin=0.4, ymax=0.6, zmin=0, zmax=0.2, rho=1800)
    m.box_block(xmin=0.4, xmax=0.8, ymin=0.4, ymax=0.6, zmin=0, zmax=0.2, rho=1800)
    m.box_block(xmin=0.8, xmax=1.2, ymin=0.4, ymax=0.6, zmin=0, zmax=0.2, rho=1800)
    m.box_block(xmin=1.2, xmax=1.6, ymin=0.4, ymax=0.6, zmin=0, zmax=0.2, rho=1800)
    m.box_block(xmin=0, xmax=0.2, ymin=0.6, ymax=0.8, zmin=0, zmax=0.2, rho=1800)
    m.box_block(xmin=0.2, xmax=0.6, ymin=0.6, ymax=0.8, zmin=0, zmax=0.2, rho=1800)
    m.box_block(xmin=0.6, xmax=1, ymin=0.6, ymax=0.8, zmin=0, zmax=0.2, rho=1800)
    m.box_block(xmin=1, xmax=1.4, ymin=0.6, ymax=0.8, zmin=0, zmax=0.2, rho=1800)
    m.box_block(xmin=1.4, xmax=1.6, ymin=0.6, ymax=0.8, zmin=0, zmax=0.2, rho=1800)
    m.box_block(xmin=0, xmax=0.4, ymin=0.8, ymax=1, zmin=0, zmax=0.2, rho=1800)
    m.box_block(xmin=0.4, xmax=0.8, ymin=0.8, ymax=1, zmin=0, zmax=0.2, rho=1800)
    m.box_block(xmin=0.8, xmax=1.2, ymin=0.8, ymax=1, zmin=0, zmax=0.2, rho=1800)
    m.box_block(xmin=1.2, xmax=1.6, ymin=0.8, ymax=1, zmin=0, zmax=0.2, rho=1800)
    m.box_block(xmin=0, xmax=0.2, ymin=1, ymax=1.2, zmin=0, zmax=0.2, rho=1800)
    m.box_block(xmin=0.2, xmax=0.6, ymin=1, ymax=1.2, zmin=0, zmax=0.2, rho=1800)
    m.box_block(xmin=0.6, xmax=1, ymin=1, ymax=1.2, zmin=0, zmax=0.2, rho=1800)
    m.box_block(xmin=1, xmax=1.4, ymin=1, ymax=1.2, zmin=0, zmax=0.2, rho=1800)
    m.box_block(xmin=1.4, xmax=1.6, ymin=1, ymax=1.2, zmin=0, zmax=0.2, rho=1800)
    m.box_block(xmin=0, xmax=0.4, ymin=1.2, ymax=1.4, zmin=0, zmax=0.2, rho=1800)
    m.box_block(xmin=0.4, xmax=0.8, ymin=1.2, ymax=1.4, zmin=0, zmax=0.2, rho=1800)
    m.box_block(xmin=0.8, xmax=1.2, ymin=1.2, ymax=1.4, zmin=0, zmax=0.2, rho=1800)
    m.box_block(xmin=1.2, xmax=1.6, ymin=1.2, ymax=1.4, zmin=0, zmax=0.2, rho=1800)
    m.hold(vx=0, vy=0, vz=0, spinx=0, spiny=0, spinz=0)
    m.box(-2, 4, -0.2, -0.04, -2, 4)
m.gravity(0, -9.81)

if __name__ == "__main__":
    m.run()
