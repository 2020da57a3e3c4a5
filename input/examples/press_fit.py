"""The model of press_fit.fmcmd, built in Python.

Written by `tribo convert press_fit.fmcmd -o press_fit.py`: the commands in the order in which they run, with values
in place of variables.
"""

import tribo

m = tribo.Model("axisymmetric", title="Press fit of a shaft in a hub", units=("mm", "g", "ms"), name="press_fit")
with m.header():
    m.text("""Units mm, g, ms (MPa). The shaft is rigid, and its radius exceeds that of the bore of an elastic hub by the interference d. The hub rests on a smooth ring. The axial force grows with the length in contact. For a ring in plane stress with the inner radius a and the outer radius b, Lame's solution gives the pressure p = E d/a/((b^2+a^2)/(b^2-a^2)+nu), and the axial force is mu p times the area in contact. Forces in axisymmetric models are per radian.""")
m.mpm_method("USL-", "B2SPLINE")
m.transfer("FMPM", 2)
m.time_step(1, 2.6, 0.4)
m.archive_time(0.1)
m.global_archive_time(0.01)
m.p_damping(2)
m.global_archive("contacty", "shaft")
m.global_archive("contactx", "hub")
m.global_archive("Friction Work")
m.global_archive("Strain Energy")
m.multimaterial_mpm()
m.contact_mm("friction")
m.material("shaft", "RigidContact", called="Shaft")
m.material("ring", "RigidContact", called="Ring")
m.material("hub", "LinearElastic", called="Hub", rho=1.2e-3, E=3000, nu=0.35, contact={"ring": "smooth"})
m.material("smooth", "CoulombFriction", called="Smooth", coeff=0)
m.material("friction", "CoulombFriction", called="Friction", coeff=0.2)
m.grid_rect(0, 25, -10, 50)
m.grid_horiz(25, 0, -1)
m.grid_vert(60)
m.body("hub", tribo.rect(10, 20, 0, 16))
m.body("ring", tribo.rect(12, 22, -4, 0))
m.body("shaft", tribo.polygon((0, 16), (9.6, 16), (10.1, 22), (10.1, 48), (0, 48)), velocity=(0, -10))

if __name__ == "__main__":
    m.run()
