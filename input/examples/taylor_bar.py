"""The model of taylor_bar.fmcmd, built in Python.

Written by `tribo convert taylor_bar.fmcmd -o taylor_bar.py`: the commands in the order in which they run, with values
in place of variables.
"""

import tribo

m = tribo.Model("axisymmetric", title="Taylor bar", units=("mm", "g", "ms"), name="taylor_bar")
with m.header():
    m.text("""Units mm, g, ms (MPa). Published results of this benchmark are a final length of 21.4 to 21.5 mm and a radius of 7.0 to 7.1 mm at the foot.""")
m.mpm_method("USAVG+", "B2SPLINE")
m.transfer("FMPM", 2)
m.time_step(1, 0.08, 0.3)
m.archive_time(0.004)
m.global_archive_time(0.0004)
m.global_archive("maxy", "copper")
m.global_archive("maxx", "copper")
m.global_archive("Kinetic Energy")
m.global_archive("Plastic Energy")
m.to_archive("velocity", "displacement", "stress", "von_mises", "history", "material", "id")
m.material("copper", "IsoPlasticity", called="Copper", properties={"rho": 8.93e-3, "E": 117e3, "nu": 0.35,
           "yield": 400, "Khard": 100})
m.grid_horiz(32, 0, -1)
m.grid_vert(112, 0, -1)
m.grid_rect(0, 9.6, 0, 33.6)
m.body("copper", tribo.rect(0, 3.2, 0, 32.4), velocity=(0, -227))

if __name__ == "__main__":
    m.run()
