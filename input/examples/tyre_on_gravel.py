"""The model of tyre_on_gravel.fmcmd, built in Python.

Written by `tribo convert tyre_on_gravel.fmcmd -o tyre_on_gravel.py`: the commands in the order in which they run, with values
in place of variables.
"""

import tribo

m = tribo.Model("plane strain", title="A tyre on gravel", units=("m", "kg", "s"), name="tyre_on_gravel")
with m.header():
    m.text("""Units m, kg, s. A rubber tyre on a heavy rim begins to roll without slip on a bed of cohesionless gravel. It sinks in and pushes gravel out of its way, which takes energy. The loss of speed is the rolling resistance. The model shows contact with friction between a soft elastic body and a granular one.""")
m.mpm_method("USL-", "B2SPLINE")
m.transfer("APIC")
m.time_step(1, 0.4, 0.4)
m.archive_time(0.02)
m.global_archive_time(0.004)
m.global_archive("velx", "rim")
m.global_archive("posy", "rim")
m.global_archive("contactx", "gravel")
m.global_archive("contacty", "gravel")
m.global_archive("Friction Work")
m.global_archive("Plastic Energy")
m.to_archive("velocity", "displacement", "stress", "pressure", "von_mises", "volume_ratio", "material", "id")
m.multimaterial_mpm()
m.contact_mm("friction")
m.material("tyre", "NeoHookean", called="Tyre", rho=1100, E=3e6, nu=0.4)
m.material("rim", "NeoHookean", called="Rim", rho=2700, E=1e7, nu=0.3, shareMatField="tyre")
m.material("gravel", "MohrCoulomb", called="Gravel", rho=1600, E=1e7, nu=0.25, cohesion=0, friction=38, dilation=0)
m.material("friction", "CoulombFriction", called="Friction", coeff=0.6)
m.grid_rect(0, 2.88, -0.24, 0.8)
m.grid_horiz(72, 0, -1, 2.88)
m.grid_vert(26)
m.grid_edge("ymin", "symmetry", -0.24)
with m.region("gravel", 0, 0):
    m.initial_stress("K0", 0.4)
    m.rect(0, 2.88, -0.24, 0)
with m.region("rim", 0, 0):
    m.vel0_x("4+12.5*(y-0.32)")
    m.vel0_y("-12.5*(x-0.48)")
    m.oval(0.28, 0.68, 0.12, 0.52)
with m.region("tyre", 0, 0):
    m.vel0_x("4+12.5*(y-0.32)")
    m.vel0_y("-12.5*(x-0.48)")
    m.oval(0.16, 0.8, 0, 0.64)
with m.grid_bc():
    m.line(0, 2.88, -0.24, -0.24)
    m.velocity("x", "constant", 0)
m.gravity(0, -9.81)

if __name__ == "__main__":
    m.run()
