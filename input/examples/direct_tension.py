"""The model of direct_tension.fmcmd, built in Python.

Written by `tribo convert direct_tension.fmcmd -o direct_tension.py`: the commands in the order in which they run, with values
in place of variables.
"""

import tribo

m = tribo.Model("plane stress", title="Direct tension of bonded blocks", units=("m", "kg", "s"),
                name="direct_tension")
with m.header():
    m.text("""Units m, kg, s. A specimen of 150 random blocks is pulled apart quasi-statically between smooth platens. The bonds between the blocks have a tensile strength of 5 MPa.""")
m.time_step(1e-4, 1.2)
m.archive_time(0.1)
m.global_archive_time(0.001)
m.global_archive("forcey", platen="top")
m.global_archive("dispy", platen="top")
m.global_archive("broken in tension")
m.global_archive("broken in shear")
m.material("bond", "SpringNetwork", properties={"compute-stiffness": "emod 5e+10 poisson 0.2", "sn_ten": 5000000,
           "sn_coh": 20e6, "sn_fa": 30, "bond": "gap 1e-6"})
with m.blocks(lawname="bond", damping=0.7, quasistatic="yes"):
    m.voronoi(xmin=0, xmax=0.06, ymin=0, ymax=0.1, random=150, rho=2500)
    m.platen(name="bottom")
    m.line(0, 0.06, 0, 0, 1e-06)
    m.platen(name="top", vy=1e-05)
    m.line(0, 0.06, 0.1, 0.1, 1e-06)

if __name__ == "__main__":
    m.run()
