"""The model of tunnel_collapse.fmcmd, built in Python.

Written by `tribo convert tunnel_collapse.fmcmd -o tunnel_collapse.py`: the commands in the order in which they run, with values
in place of variables.
"""

import tribo

m = tribo.Model("plane strain", title="A tunnel that collapses in clay", units=("m", "kg", "s"),
                name="tunnel_collapse")
with m.header():
    m.text("""Units m, kg, s. The clay is at rest under its weight until the tunnel is excavated at 0.5 s. The stability number rho g (C + D/2)/cu, with the cover C, the diameter D and the undrained strength cu, is about twice the value at which tunnels without support collapse (3 for a cover equal to the diameter). Clay therefore flows into the opening, and a trough forms at the surface.""")
m.mpm_method("USL-", "B2SPLINE")
m.transfer("APIC")
m.time_step(1, 4, 0.4)
m.archive_time(0.1)
m.global_archive_time(0.02)
m.damping(2)
m.global_archive("dispy", 0.3, -0.3)
m.global_archive("dispy", 0.3, -5.7)
m.global_archive("Kinetic Energy")
m.global_archive("Plastic Energy")
m.to_archive("velocity", "displacement", "stress", "pressure", "von_mises", "volume_ratio", "material", "id")
m.material("clay", "MohrCoulomb", called="Clay", rho=1800, E=6e6, nu=0.4, cohesion=25000, friction=0, dilation=0)
m.grid_rect(0, 20, -16, 2)
m.grid_horiz(40, 0, -1, 20)
m.grid_vert(36)
m.grid_edge("ymin", "symmetry", -16)
with m.grid_bc():
    m.line(0, 20, -16, -16)
    m.velocity("x", "constant", 0)
with m.region("clay", 0, 0):
    m.initial_stress("K0", 1)
    m.rect(0, 20, -16, 0)
m.gravity(0, -9.81)
with m.stage(0.5, "tunnel"):
    with m.excavate():
        m.oval(-3, 3, -12, -6)

if __name__ == "__main__":
    m.run()
