"""The model of pile_in_clay.fmcmd, built in Python.

Written by `tribo convert pile_in_clay.fmcmd -o pile_in_clay.py`: the commands in the order in which they run, with values
in place of variables.
"""

import tribo

m = tribo.Model("axisymmetric", title="A pile pressed into clay", units=("m", "kg", "s"), name="pile_in_clay")
with m.header():
    m.text("""Units m, kg, s. A smooth rigid pile with a point of 60 degrees is pushed down at constant speed into weightless clay with the undrained strength cu (Mohr-Coulomb without friction). According to Teh and Houlsby (1991) the pressure at the point is Nc cu with Nc = 4/3 (1 + ln Ir)(1.25 + Ir/2000) and the rigidity index Ir = G/cu. Forces in axisymmetric models are per radian.""")
m.mpm_method("USL-", "B2SPLINE")
m.transfer("APIC")
m.time_step(1, 0.9, 0.4)
m.archive_time(0.05)
m.global_archive_time(0.005)
m.global_archive("contacty", "pile")
m.global_archive("Plastic Energy")
m.to_archive("velocity", "displacement", "stress", "pressure", "von_mises", "volume_ratio", "material", "id")
m.multimaterial_mpm()
m.material("pile", "RigidContact", called="Pile")
m.material("clay", "MohrCoulomb", called="Clay", rho=1800, E=8700000, nu=0.45, cohesion=30000, friction=0, dilation=0)
m.grid_rect(0, 2.7, -4, 0.6)
m.grid_horiz(54, 0, -1, 2.7)
m.grid_vert(92)
m.grid_edge("ymin", "symmetry", -4)
m.body("pile", tribo.polygon((0, -1.71961524227066), (0.3, -1.2), (0.3, 0.5), (0, 0.5)), velocity=(0, -1))
m.body("clay", tribo.rect(0, 2.7, -4, 0))

if __name__ == "__main__":
    m.run()
