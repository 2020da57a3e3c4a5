"""The model of plate_anchor.fmcmd, built in Python.

Written by `tribo convert plate_anchor.fmcmd -o plate_anchor.py`: the commands in the order in which they run, with values
in place of variables.
"""

import tribo

m = tribo.Model("plane strain", title="A plate anchor in sand", units=("m", "kg", "s"), name="plate_anchor")
with m.header():
    m.text("""Units m, kg, s. A rigid strip anchor of width B, buried in sand at the depth H = 2 B, is pulled up slowly. It lifts the sand above it as a wedge whose sides are inclined outwards by the friction angle phi (dilation = friction). The force per length is the weight of this wedge, F = g rho B H (1 + H/B tan phi). The model is one half of the anchor and has half of this force.""")
m.mpm_method("USL-", "B2SPLINE")
m.transfer("FMPM", 4)
m.time_step(1, 1.5, 0.4)
m.archive_time(0.1)
m.global_archive_time(0.01)
m.p_damping(5)
m.global_archive("contacty", "anchor")
m.global_archive("Plastic Energy")
m.to_archive("velocity", "displacement", "stress", "pressure", "von_mises", "volume_ratio", "material", "id")
m.multimaterial_mpm()
m.contact_mm("friction")
m.material("anchor", "RigidContact", called="Anchor", SettingFunction=0, SettingFunction2="0.04*min(t/0.2,1)")
m.material("sand", "MohrCoulomb", called="Sand", rho=1700, E=1e7, nu=0.3, cohesion=100, friction=30, dilation=30)
m.material("friction", "CoulombFriction", called="Friction", coeff=0.5)
m.grid_rect(0, 3, -3, 0.5)
m.grid_horiz(30, 0, -1, 3)
m.grid_vert(35)
m.grid_edge("ymin", "symmetry", -3)
m.body("anchor", tribo.rect(0, 0.5, -2.2, -2))
with m.region("sand", 0, 0):
    m.initial_stress("K0", 0.5)
    m.rect(0, 3, -3, 0)
m.gravity(0, -9.81)

if __name__ == "__main__":
    m.run()
