"""The model of rubber_ring.fmcmd, built in Python.

Written by `tribo convert rubber_ring.fmcmd -o rubber_ring.py`: the commands in the order in which they run, with values
in place of variables.
"""

import tribo

m = tribo.Model("plane strain", title="A rubber ring through a slot", units=("mm", "g", "ms"), name="rubber_ring")
with m.header():
    m.text("""Units mm, g, ms (MPa). A rigid stamp pushes the ring down between two rigid jaws with round shoulders. Friction acts at all contacts.""")
m.mpm_method("USL-", "lCPDI")
m.transfer("FMPM", 2)
m.time_step(1, 23, 0.3)
m.archive_time(0.5)
m.global_archive_time(0.1)
m.p_damping(0.2)
m.global_archive("posy", "ring")
m.global_archive("miny", "ring")
m.global_archive("contacty", "stamp")
m.global_archive("Strain Energy")
m.global_archive("Friction Work")
m.multimaterial_mpm()
m.contact_mm("friction")
m.material("ring", "Mooney", called="Ring", rho=1.1e-3, G1=0.4, K=3)
m.material("jaws", "RigidContact", called="Jaws")
m.material("stamp", "RigidContact", called="Stamp", SettingFunction=0, SettingFunction2=-2)
m.material("friction", "CoulombFriction", called="Friction", coeff=0.1)
m.grid_horiz(44)
m.grid_vert(84)
m.grid_rect(-22, 22, -56, 28)
m.body("ring", tribo.oval(-10, 10, 1, 21) - tribo.oval(-7, 7, 4, 18))
m.body("jaws", tribo.oval(-16, -8, -8, 0), tribo.rect(-20, -12, -18, 0), tribo.rect(-12, -8, -18, -4))
m.body("jaws", tribo.oval(8, 16, -8, 0), tribo.rect(12, 20, -18, 0), tribo.rect(8, 12, -18, -4))
m.body("stamp", tribo.rect(-4, 4, 21, 25))

if __name__ == "__main__":
    m.run()
