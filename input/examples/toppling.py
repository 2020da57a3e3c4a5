"""The model of toppling.fmcmd, built in Python.

Written by `tribo convert toppling.fmcmd -o toppling.py`: the commands in the order in which they run, with values
in place of variables.
"""

import tribo

m = tribo.Model("plane strain", title="Toppling", units=("m", "kg", "s"), name="toppling")
with m.header():
    m.text("""Units m, kg, s. Columns of rock stand on a floor. The first one is given a push, and each column topples the next one. Blocks that meet during the run form new contacts and slide with friction.""")
m.time_step(1e-3, 3.5)
m.archive_time(0.05)
m.global_archive_time(0.01)
m.global_archive("turnz", block="last")
m.global_archive("kinetic energy")
m.material("rub", "SpringNetwork", kn=5e7, ks=5e7, fric=0.6, dp_nratio=0.2, dp_sratio=0.2, dp_mode=3)
with m.blocks(lawname="rub", touchname="rub", points="corners", damping=0.02):
    m.box_block(name="floor", xmin=-1, xmax=7, ymin=-0.4, ymax=0, rho=2500)
    m.box_block(name="first", xmin=0, xmax=0.2, ymin=0, ymax=1.2, rho=2500, spinz=-3.5)
    m.box_block(xmin=0.7, xmax=0.9, ymin=0, ymax=1.2, rho=2500)
    m.box_block(xmin=1.4, xmax=1.6, ymin=0, ymax=1.2, rho=2500)
    m.box_block(xmin=2.1, xmax=2.3, ymin=0, ymax=1.2, rho=2500)
    m.box_block(xmin=2.8, xmax=3, ymin=0, ymax=1.2, rho=2500)
    m.box_block(xmin=3.5, xmax=3.7, ymin=0, ymax=1.2, rho=2500)
    m.box_block(name="last", xmin=4.2, xmax=4.4, ymin=0, ymax=1.2, rho=2500)
    m.hold(vx=0, vy=0, spinz=0)
    m.rect(-2, 8, -0.5, -0.1)
m.gravity(0, -9.81)

if __name__ == "__main__":
    m.run()
