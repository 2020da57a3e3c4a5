"""The model of block_on_incline.fmcmd, built in Python.

Written by `tribo convert block_on_incline.fmcmd -o block_on_incline.py`: the commands in the order in which they run, with values
in place of variables.
"""

import tribo

m = tribo.Model("plane strain", title="A block on an incline", units=("m", "kg", "s"), name="block_on_incline")
with m.header():
    m.text("""Units m, kg, s. Until t = 0.3 the block settles with damping. From t = 0.5 on it slides with the acceleration g (sin(angle) - mu cos(angle)).""")
m.mpm_method("USL-", "B2SPLINE")
m.transfer("FMPM", 2)
m.time_step(1, 1, 0.3)
m.archive_time(0.1)
m.global_archive_time(0.005)
m.p_damping("20*(t<0.3)")
m.global_archive("velx", "block")
m.global_archive("dispx", "block")
m.global_archive("contactx", "block")
m.global_archive("contacty", "block")
m.multimaterial_mpm()
m.contact_mm("friction")
m.material("plane", "RigidContact", called="Plane")
m.material("block", "LinearElastic", called="Block", rho=1000, E=1e7, nu=0.3)
m.material("friction", "CoulombFriction", called="Friction", coeff=0.3)
m.grid_horiz(90)
m.grid_vert(18)
m.grid_rect(-1, 3.5, -0.4, 0.5)
m.body("plane", tribo.rect(-0.6, 3, -0.25, 0))
m.body("block", tribo.rect(0, 1, 0, 0.2))
m.entity("along", "4.905*(min(max((t-0.3)/0.2,0),1))^2*(3-2*(min(max((t-0.3)/0.2,0),1)))")
m.entity("press", 8.49570921112534)
m.xml_data("Gravity", """
<GridBodyXForce>&along;</GridBodyXForce>
<GridBodyYForce>-&press;</GridBodyYForce>
""")

if __name__ == "__main__":
    m.run()
