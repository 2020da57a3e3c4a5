"""The model of blanking.fmcmd, built in Python.

Written by `tribo convert blanking.fmcmd -o blanking.py`: the commands in the order in which they run, with values
in place of variables.
"""

import tribo

m = tribo.Model("axisymmetric", title="A punch through sheet metal", units=("mm", "g", "ms"), name="blanking")
with m.header():
    m.text("""Units mm, g, ms (MPa). A rigid punch pushes a disc out of a metal sheet into the opening of a rigid die. A perfectly plastic sheet yields in shear along the edge of the punch. The force is 2 pi r t yield/sqrt(3), with the radius r of the punch and the thickness t of the sheet. Forces in axisymmetric models are per radian.""")
m.mpm_method("USL-", "B2SPLINE")
m.transfer("APIC")
m.time_step(1, 0.025, 0.4)
m.archive_time(0.00125)
m.global_archive_time(0.000125)
m.global_archive("contacty", "punch")
m.global_archive("contacty", "die")
m.global_archive("Plastic Energy")
m.to_archive("velocity", "displacement", "stress", "von_mises", "history", "volume_ratio", "material", "id")
m.multimaterial_mpm()
m.contact_mm("friction")
m.material("punch", "RigidContact", called="Punch")
m.material("die", "RigidContact", called="Die")
m.material("holder", "RigidContact", called="Holder")
m.material("sheet", "IsoPlasticity", called="Sheet", properties={"rho": 7.8e-3, "E": 200e3, "nu": 0.3, "yield": 300,
           "Khard": 0})
m.material("friction", "CoulombFriction", called="Friction", coeff=0.1)
m.grid_rect(0, 8, -1.5, 4.5)
m.grid_horiz(64, 0, -1)
m.grid_vert(48)
m.body("punch", tribo.rect(0, 5, 2, 3.5), velocity=(0, -20))
m.body("holder", tribo.rect(5.5, 7.5, 2, 3))
m.body("die", tribo.rect(5.125, 7.5, -1, 0))
m.body("sheet", tribo.rect(0, 7, 0, 2))

if __name__ == "__main__":
    m.run()
