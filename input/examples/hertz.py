"""The model of hertz.fmcmd, built in Python.

Written by `tribo convert hertz.fmcmd -o hertz.py`: the commands in the order in which they run, with values
in place of variables.
"""

import tribo

m = tribo.Model("plane strain", title="Hertz contact of a cylinder", units=("m", "kg", "s"), name="hertz")
with m.header():
    m.text("""Units m, kg, s with E = rho = 1. The model is the right half of the cylinder. The plane moves up until t = 10; then the waves are damped.""")
m.mpm_method("USL-", "B2SPLINE")
m.transfer("FMPM", 2)
m.time_step(10, 25, 0.4)
m.archive_time(2.5)
m.global_archive_time(0.2)
m.p_damping("0.5+1.5*(t>12)")
m.global_archive("contacty", "cylinder")
m.global_archive("Contact Area")
m.xml_data("MPMHeader", """
<MultiMaterialMode Impulses='faces'/>
""")
m.material("plane", "RigidContact", called="Plane", SettingFunction=0,
           SettingFunction2="0.0125*pi/20*sin(pi*t/10)*(t<10)")
m.material("cylinder", "LinearElastic", called="Cylinder", rho=1, E=1, nu=0.3)
m.grid_horiz(60, 0, -1)
m.grid_vert(56, 1, 1)
m.grid_rect(0, 1.2, -0.12, 1)
m.body("plane", tribo.rect(0, 0.6, -0.08, 0))
m.xml_data("MaterialPoints", """
<Body mat='2'>
  <Deform dX='0' dY='0.5*x*x*(1-y)' F11='1' F12='0' F21='x*(1-y)' F22='1-0.5*x*x'/>
  <Rect xmin='0' xmax='1' ymin='0' ymax='1'/>
</Body>
""")

if __name__ == "__main__":
    m.run()
