"""The model of brick_arch.fmcmd, built in Python.

Written by `tribo convert brick_arch.fmcmd -o brick_arch.py`: the commands in the order in which they run, with values
in place of variables.
"""

import tribo

m = tribo.Model("plane strain", title="A brick arch that fails under a load", units=("m", "kg", "s"),
                name="brick_arch")
with m.header():
    m.text("""Units m, kg, s. Fifteen rigid bricks form a semicircle on two fixed abutments and are held by their weight and by friction alone. The load on one brick at the left grows to 8000 N at 5 s, and after that by 500 N/s. The arch fails when four joints have opened alternately at the inside and at the outside, so that it is a mechanism of four hinges. Limit analysis (Heyman) gives the load at which this happens.""")
m.time_step(1e-3, 13.5)
m.archive_time(0.25)
m.global_archive_time(0.01)
m.global_archive("dispy", block="loaded")
m.global_archive("dispy", block="key")
m.global_archive("kinetic energy")
m.material("dry", "SpringNetwork", kn=2e9, ks=2e9, krot="0 0 0", fric=0.7, dp_nratio=0.2, dp_sratio=0.2, dp_mode=3)
with m.blocks(lawname="dry", touchname="dry", points="corners", damping=0.3):
    m.box_block(name="abutment", xmin=-2.35, xmax=-1.65, ymin=-0.3, ymax=0, rho=2000)
    m.box_block(name="abutment", xmin=1.65, xmax=2.35, ymin=-0.3, ymax=0, rho=2000)
    m.polygon_block(name="voussoir", rho=2000)
    m.points((-1.85, 2.2656e-16), (-1.80957, 0.384637), (-2.10302, 0.44701), (-2.15, 2.63299e-16))
    m.polygon_block(name="voussoir", rho=2000)
    m.points((-1.80957, 0.384637), (-1.69006, 0.752463), (-1.96412, 0.874484), (-2.10302, 0.44701))
    m.polygon_block(name="voussoir", rho=2000)
    m.points((-1.69006, 0.752463), (-1.49668, 1.0874), (-1.73939, 1.26374), (-1.96412, 0.874484))
    m.polygon_block(name="voussoir", rho=2000)
    m.points((-1.49668, 1.0874), (-1.23789, 1.37482), (-1.43863, 1.59776), (-1.73939, 1.26374))
    m.polygon_block(name="loaded", rho=2000)
    m.points((-1.23789, 1.37482), (-0.925, 1.60215), (-1.075, 1.86195), (-1.43863, 1.59776))
    m.polygon_block(name="voussoir", rho=2000)
    m.points((-0.925, 1.60215), (-0.571681, 1.75945), (-0.664387, 2.04477), (-1.075, 1.86195))
    m.polygon_block(name="voussoir", rho=2000)
    m.points((-0.571681, 1.75945), (-0.193378, 1.83987), (-0.224736, 2.13822), (-0.664387, 2.04477))
    m.polygon_block(name="key", rho=2000)
    m.points((-0.193378, 1.83987), (0.193378, 1.83987), (0.224736, 2.13822), (-0.224736, 2.13822))
    m.polygon_block(name="voussoir", rho=2000)
    m.points((0.193378, 1.83987), (0.571681, 1.75945), (0.664387, 2.04477), (0.224736, 2.13822))
    m.polygon_block(name="voussoir", rho=2000)
    m.points((0.571681, 1.75945), (0.925, 1.60215), (1.075, 1.86195), (0.664387, 2.04477))
    m.polygon_block(name="voussoir", rho=2000)
    m.points((0.925, 1.60215), (1.23789, 1.37482), (1.43863, 1.59776), (1.075, 1.86195))
    m.polygon_block(name="voussoir", rho=2000)
    m.points((1.23789, 1.37482), (1.49668, 1.0874), (1.73939, 1.26374), (1.43863, 1.59776))
    m.polygon_block(name="voussoir", rho=2000)
    m.points((1.49668, 1.0874), (1.69006, 0.752463), (1.96412, 0.874484), (1.73939, 1.26374))
    m.polygon_block(name="voussoir", rho=2000)
    m.points((1.69006, 0.752463), (1.80957, 0.384637), (2.10302, 0.44701), (1.96412, 0.874484))
    m.polygon_block(name="voussoir", rho=2000)
    m.points((1.80957, 0.384637), (1.85, 8.21565e-16), (2.15, 9.54792e-16), (2.10302, 0.44701))
    m.hold(vx=0, vy=0, spinz=0)
    m.rect(-3, 3, -0.4, -0.1)
    m.load(Fy="-min(2000*max(0,t-1),8000+500*max(0,t-5))")
    m.rect(-1.22132, -1.12132, 1.56219, 1.66219)
m.gravity(0, -9.81)

if __name__ == "__main__":
    m.run()
