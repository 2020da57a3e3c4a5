"""The model of shear_box.fmcmd, built in Python.

Written by `tribo convert shear_box.fmcmd -o shear_box.py`: the commands in the order in which they run, with values
in place of variables.
"""

import tribo

m = tribo.Model("plane strain", title="Direct shear box of a joint", units=("m", "kg", "s"), name="shear_box")
with m.header():
    m.text("""Units m, kg, s. The two halves of a specimen meet along a joint (Mohr) that weakens with slip. The upper half carries the normal stress s and is held in the direction of the joint. The lower half is rigid and moves. The shear stress rises to the peak strength c + s tan(phi), and falls to the residual strength s tan(phi_r) over the slip slip-dc.""")
m.mpm_method("USL-", "B2SPLINE")
m.transfer("FMPM", 2)
m.time_step(1, 0.06, 0.4)
m.archive_time(0.003)
m.global_archive_time(0.0002)
m.p_damping(500)
m.global_archive("contactx", "lower")
m.global_archive("contacty", "lower")
m.global_archive("Joint Slip Energy")
m.to_archive("velocity", "displacement", "stress", "von_mises", "material", "id")
m.multimaterial_mpm()
m.material("upper", "LinearElastic", called="Upper", rho=2600, E=5e9, nu=0.2, contact={"lower": "joint"})
m.material("lower", "RigidContact", called="Lower", SettingFunction="-0.1*min(max(t-0.01,0)/0.005,1)",
           SettingFunction2=0)
m.material("joint", "Mohr", called="Joint", properties={"stiffness-normal": 2e10, "stiffness-shear": 1e10,
           "cohesion": 200000, "friction": 35, "friction-residual": 25, "slip-dc": 0.002, "tension": 1e5})
m.grid_rect(-0.1, 0.3, -0.1, 0.16)
m.grid_horiz(20)
m.grid_vert(13)
m.body("lower", tribo.rect(-0.04, 0.24, -0.08, 0))
m.body("upper", tribo.rect(0, 0.2, 0, 0.08))
with m.particle_bc():
    m.rect(0, 0.2, 0.07, 0.08)
    m.traction("y", 3, "function", "-1e6*min(t/0.005,1)")
with m.grid_bc():
    m.rect(-0.05, 0.25, 0.02, 0.1)
    m.velocity("x", "constant", 0)

if __name__ == "__main__":
    m.run()
