"""The model of unconfined_compression.fmcmd, built in Python.

Written by `tribo convert unconfined_compression.fmcmd -o unconfined_compression.py`: the commands in the order in which they run, with values
in place of variables.
"""

import tribo

m = tribo.Model("plane stress", title="Unconfined compression of bonded blocks", units=("m", "kg", "s"),
                name="unconfined_compression")
with m.header():
    m.text("""Units m, kg, s. 600 Voronoi cells are compressed between smooth platens, in plane stress. Bonds fail in tension (red) and in shear (blue). Faces whose bonds are broken slide with friction.""")
m.time_step(1e-4, 1)
m.archive_time(0.05)
m.global_archive_time(0.001)
m.global_archive("forcey", platen="top")
m.global_archive("dispy", platen="top")
m.global_archive("broken in tension")
m.global_archive("broken in shear")
m.material("bond", "SpringNetwork", properties={"compute-stiffness": "emod 5e+10 poisson 0.2", "sn_ten": 8000000,
           "sn_coh": 25000000, "sn_fa": 35, "sn_mcf": 0.5, "bond": "gap 1e-6"})
m.material("broken", "SpringNetwork", kn=2e13, ks=2e13, fric=0.7)
with m.blocks(lawname="bond", touchname="broken", damping=0.7, quasistatic="yes"):
    m.voronoi(xmin=0, xmax=0.05, ymin=0, ymax=0.1, random=600, seed=3, rho=2500)
    m.platen(name="bottom")
    m.line(0, 0.05, 0, 0, 1e-06)
    m.platen(name="top", vy=-0.0003)
    m.line(0, 0.05, 0.1, 0.1, 1e-06)

if __name__ == "__main__":
    m.run()
