"""The model of fibre_pull_out.fmcmd, built in Python.

Written by `tribo convert fibre_pull_out.fmcmd -o fibre_pull_out.py`: the commands in the order in which they run, with values
in place of variables.
"""

import tribo

m = tribo.Model("axisymmetric", title="Pull-out of a fibre", units=("mm", "g", "ms"), name="fibre_pull_out")
with m.header():
    m.text("""Units mm, g, ms (MPa). In theory the displacement of the loaded end, divided by the stress there, is coth(b l)/(b E) with b = sqrt(2 Dt/(E r)), where r, l and E are the radius, the length and the modulus of the fibre, and Dt is the shear stiffness of the interface.""")
m.mpm_method("USL-", "B2SPLINE")
m.transfer("FMPM", 2)
m.time_step(1, 0.12, 0.4)
m.archive_time(0.015)
m.global_archive_time(0.005)
m.p_damping(150)
m.global_archive("contactZ", "fibre")
m.global_archive("Interface Energy")
m.global_archive("Strain Energy")
m.multimaterial_mpm()
m.contact_mm("bond")
m.material("socket", "RigidContact", called="Socket")
m.material("fibre", "LinearElastic", called="Fibre", rho=1, E=70000, nu=0)
m.material("bond", "LinearInterface", called="Bond", Dnt=0, Dnc=0, Dt=10000)
m.grid_horiz(9, 0, -1)
m.grid_vert(132)
m.grid_rect(0, 0.15, -0.1, 2.1)
m.body("socket", tribo.rect(0.05, 0.1, 0, 2))
m.body("fibre", tribo.rect(0, 0.05, 0, 2))
with m.particle_bc():
    m.rect(0, 0.05, 1.995, 2)
    m.traction("y", 3, "function", "min(t/0.03,1)*1")

if __name__ == "__main__":
    m.run()
