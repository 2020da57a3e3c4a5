"""The model of water_table.fmcmd, built in Python.

Written by `tribo convert water_table.fmcmd -o water_table.py`: the commands in the order in which they run, with values
in place of variables.
"""

import tribo

m = tribo.Model("plane strain", title="Rising water table", units=("m", "kg", "s"), name="water_table")
with m.header():
    m.text("""Units m, kg, s. The bedding plane dips by 30 degrees towards the face and has a friction angle of 40 degrees. Its pore pressure is the weight of the water above it. From 1 s on the water rises by 3 m/s. The block begins to slide when the friction under the effective stress has fallen to the weight component along the bedding plane.""")
m.mpm_method("USL-", "quadratic")
m.transfer("APIC")
m.time_step(1, 5, 0.4)
m.damping("30*(t<0.9)")
m.archive_time(0.2)
m.global_archive_time(0.02)
m.global_archive("dispx", "block")
m.global_archive("vely", "block")
m.to_archive("velocity", "displacement", "stress", "von_mises", "material", "id")
m.multimaterial_mode()
m.material("rock", "LinearElastic", called="Rock", rho=2600, E=4e8, nu=0.2)
m.material("block", "LinearElastic", called="Block", rho=2600, E=4e8, nu=0.2, contact={"rock": "bedding"})
m.material("bedding", "Mohr", called="Bedding", properties={"stiffness-normal": 4e7, "stiffness-shear": 4e7,
           "friction": 40, "friction-residual": 40, "keep-pressure-when-open": 1,
           "pore-pressure-function": "1e4*max(0,2+min(8,3*max(0,t-1))-y)"})
m.grid_rect(0, 30, -2, 14)
m.grid_horiz(60, 0, -1, 30)
m.grid_vert(32, -2, -1)
m.body("rock", tribo.polygon((0, -2), (30, -2), (30, 13.547), (10, 2), (9, 0), (0, 0)))
m.body("block", tribo.polygon((10, 2), (14, 11.238), (26, 11.238)))
with m.grid_bc():
    m.rect(0, 30, -2.1, -1.9)
    m.velocity("x", "constant", 0)
m.xml_data("Gravity", """
<GridBodyYForce>-10*min(1,t/0.4)</GridBodyYForce>
""")

if __name__ == "__main__":
    m.run()
