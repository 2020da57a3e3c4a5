#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""The page of `tribo watch` and `tribo view`: its answers, and what it does in headless Chromium. Usage: test_page.py TRIBO SOURCE_DIR"""

import contextlib
import json
import os
import re
import signal
import struct
import subprocess
import sys
import tempfile
import time
import urllib.error
import urllib.parse
import urllib.request

import browser
import checks

tribo, source = sys.argv[1:3]
check = checks.Checks()


@contextlib.contextmanager
def served(*arguments):
    """The address of a page, as long as it is wanted."""
    server = subprocess.Popen([tribo, *arguments], stdout=subprocess.PIPE, text=True)
    try:
        yield server.stdout.readline().split()[1]
        server.send_signal(signal.SIGINT)
        check(server.wait(20) == 0, "Ctrl-C ends the page")
    finally:
        server.kill()


def get(address):
    with urllib.request.urlopen(address, timeout=30) as answer:
        return answer.read()


def fails(address):
    try:
        get(address)
        return False
    except urllib.error.HTTPError as error:
        return error.code == 400 and len(error.read()) > 10


def frame(address, k, **wanted):
    """The head of a frame, and its parts as tuples."""
    data = get(f"{address}frame/{k}?" + urllib.parse.urlencode(wanted))
    end = data.index(b"\n")
    head, parts, at = json.loads(data[:end]), {}, end + 1
    for part in head["parts"]:
        parts[part["name"]] = struct.unpack_from(f"<{part['length']}{'I' if part['kind'] == 'u' else 'f'}", data, at)
        at += 4 * part["length"]
    return head, parts


ball = """<?xml version='1.0'?>
<JANFEAInput version='3'>
  <Header><Description>A ball on a plate</Description><Analysis>12</Analysis><ConsistentUnits length='mm' mass='g' time='ms'/></Header>
  <MPMHeader><TimeFactor>0.4</TimeFactor><MaxTime>0.02</MaxTime><ArchiveTime>0.01</ArchiveTime><MultiMaterialMode/>
    <GlobalArchive type='vely' matname='ball'/></MPMHeader>
  <Mesh><Grid xmin='-6' xmax='6' ymin='-4' ymax='10' zmin='-6' zmax='6'><Horiz cellsize='0.5'/><Vert cellsize='0.5' symmin='-3'/><Depth cellsize='0.5'/></Grid></Mesh>
  <MaterialPoints>
    <Body matname='plate'><Box xmin='-4' xmax='4' ymin='-3' ymax='0' zmin='-4' zmax='4'/></Body>
    <Body matname='ball'><vel0Y>-10</vel0Y><Sphere xmin='-1' xmax='1' ymin='0.5' ymax='2.5' zmin='-1' zmax='1'/></Body>
    <Body matname='ball'><Sphere xmin='1.5' xmax='3.5' ymin='0.5' ymax='2.5' zmin='-1' zmax='1'/></Body>
  </MaterialPoints>
  <Material Type='LinearElastic' Name='plate'><rho>1e-3</rho><E>20</E><nu>0.3</nu></Material>
  <Material Type='LinearElastic' Name='ball'><rho>2e-3</rho><E>40</E><nu>0.3</nu></Material>
</JANFEAInput>
"""

plate = """<?xml version='1.0'?>
<!DOCTYPE JANFEAInput [<!ENTITY load "5">]>
<JANFEAInput version='3'>
  <Header><Description>A plate with a crack</Description><Analysis>10</Analysis><ConsistentUnits length='mm' mass='g' time='ms'/></Header>
  <MPMHeader><MaxTime>1</MaxTime><ArchiveTime>1</ArchiveTime></MPMHeader>
  <Mesh><Grid xmin='0' xmax='20' ymin='-2' ymax='12'><Horiz cellsize='1' symmin='0'/><Vert cellsize='1'/></Grid></Mesh>
  <MaterialPoints><Body matname='steel'><Rect xmin='0' xmax='16' ymin='0' ymax='10'/></Body></MaterialPoints>
  <CrackList><Line xmin='4' ymin='5' xmax='9' ymax='5'/></CrackList>
  <Material Type='LinearElastic' Name='steel'><rho>1e-3</rho><E>100</E><nu>0.3</nu></Material>
  <Gravity><GridBodyYForce>-1e-2</GridBodyYForce></Gravity>
  <GridBCs><BCLine x1='0' y1='0' x2='16' y2='0'><DisBC dir='2' disp='0'/></BCLine></GridBCs>
  <ParticleBCs><LdRect xmin='0' xmax='16' ymin='9.5' ymax='10'><TractionBC dir='11' face='3' stress='-&load;'/></LdRect></ParticleBCs>
</JANFEAInput>
"""


def answers_of_disks(address, last):
    """Hidden materials, sections, thinning, arrows, one particle, histories."""
    head, parts = frame(address, last, field="velocity")
    total = head["total"]
    check(head["count"] == total and head["visible"] == total and parts["indices"] == tuple(range(total)), "all particles are drawn")
    half, _ = frame(address, last, hidden="2")
    check(0 < half["count"] < total and half["total"] == total, "a hidden material")
    right, places = frame(address, last, sections="x>0")
    check(0 < right["count"] < total and min(places["positions"][::3]) >= 0, "a section")
    thin, some = frame(address, last, most=100)
    check(0 < thin["count"] <= 100 and thin["visible"] == total and thin["growth"] > 1, "thinned particles")
    check(abs(some["axes"][0]) > abs(parts["axes"][9 * some["indices"][0]]), "which are larger")
    arrows, vectors = frame(address, last, arrows="velocity", most_arrows=50)
    check(0 < len(vectors["arrow_places"]) <= 150 and arrows["arrow_total"] == total and arrows["arrow_largest"] > 0, "arrows")
    check("displacement" in arrows["vectors"] and arrows["arrow_unit"], "what can be drawn as arrows")
    for wrong in ("arrows=stress", "sections=u<1", "sections=x<a", "hidden=a", "field=velocty"):
        check(fails(f"{address}frame/{last}?{wrong}"), f"'{wrong}' is refused")
    picked = json.loads(get(f"{address}particle/{last}/7"))["picked"]
    fields = {f["name"]: f for f in picked["fields"]}
    number = picked["numbers"][0]
    check(picked["kind"] == "particle" and fields["id"]["values"] == [number] and fields["stress"]["components"][0] == "xx", "the values of a particle")
    check(fields["velocity"]["unit"] and picked["material"], "with units, and its material")
    check(fails(f"{address}particle/{last}/99999999"), "a particle that is not there")
    history = json.loads(get(f"{address}history?kind=particle&number={number}"))
    check(len(history["times"]) == last + 1 and history["fields"]["velocity.x"]["values"][-1] == fields["velocity"]["values"][0], "its history")
    check(fails(f"{address}history?kind=grain&number=1"), "a history of something else")
    spread = json.loads(get(f"{address}range?field=velocity.x"))
    check(spread["range"][0] < 0 < spread["range"][1] and spread["box"][0][0] < spread["box"][1][0], "the range over all times")
    tables = json.loads(get(f"{address}tables"))
    check([c["name"] for c in tables["energy"]["columns"]][:2] == ["kinetic", "elastic"] and tables["energy"]["columns"][1]["unit"], "energies with units")
    check(json.loads(get(f"{address}layers")) == [], "a run has no layers")


def client_of(b, place):
    """The point of the window at which a place is drawn."""
    return b.run(f"""(async () => {{ const {{ page }} = await import('./main.js'), r = page.scene.renderer, c = page.scene.canvas(), box = c.getBoundingClientRect();
      const [x, y] = r.worldToNormalizedDisplay({place[0]}, {place[1]}, {place[2]}, box.width / box.height);
      return [box.left + x * box.width, box.bottom - y * box.height]; }})()""")


def of_page(b, expression):
    return b.run(f"import('./main.js').then(({{ page }}) => {expression})")


def shows(b, k):
    return b.wait(f"document.body.dataset.shown === '{k}'")


def drawn(b):
    return int(b.run("document.body.dataset.drawn"))


def change(b, name, value):
    b.run(f"{{ const e = document.getElementById('{name}'); e.value = {value!r}; e.dispatchEvent(new Event('input')); e.dispatchEvent(new Event('change')); }}")


def downloaded(folder, ending, seconds=60):
    """The bytes of a file that the page has saved."""
    deadline = time.time() + seconds
    while time.time() < deadline:
        for name in os.listdir(folder):
            file = os.path.join(folder, name)
            size = os.path.getsize(file) if name.endswith(ending) else 0
            time.sleep(0.2)
            if size > 0 and os.path.exists(file) and os.path.getsize(file) == size:  # it does not grow any more
                return open(file, "rb").read()
        time.sleep(0.05)
    return b""


def play_and_scrub(b, last):
    b.key("Home")
    check(shows(b, 0), "Home: the first time")
    b.key("ArrowRight"), b.key("ArrowRight")
    check(shows(b, 2), "the right arrow, twice")
    b.key("ArrowLeft")
    check(shows(b, 1), "the left arrow")
    change(b, "frame", 3)
    check(shows(b, 3), "scrubbing")
    check(b.run("document.getElementById('number').textContent") == f"4 / {last + 1}", "the number of the time")
    check(re.fullmatch(r"time [\d.e-]+ \w+", b.run("document.getElementById('time').textContent")), "the time with its unit")
    b.key("Home"), shows(b, 0)
    change(b, "speed", "40")
    b.key(" ")
    check(b.run("document.getElementById('play').textContent") == "Pause", "space plays")
    check(b.wait("Number(document.body.dataset.shown) >= 2"), "times go by")
    b.key(" ")
    check(b.run("document.getElementById('play').textContent") == "Play", "space pauses")
    b.key("End")
    check(shows(b, last), "End: the last time")


def colours(b):
    check(of_page(b, "page.scene.furniture.axes.getAxisLabels()")[0] == "x [mm]", "axes with units")
    check(of_page(b, "page.scene.furniture.bar.getAxisLabel()") == "von_mises [Pa]", "the colour bar has the field and its unit")
    spread = "page.scene.furniture.bar.getScalarsToColors().getMappingRange()"
    before = of_page(b, spread)
    b.key("r")
    check(b.wait("document.getElementById('range-mode').value === 'frame'"), "r: the range of each time")
    check(b.wait(f"import('./main.js').then(({{ page }}) => {spread}[1] !== {before[1]})"), "another range")
    change(b, "range-mode", "own"), change(b, "low", "1"), change(b, "high", "5")
    check(b.wait(f"import('./main.js').then(({{ page }}) => String({spread}) === '1,5')"), "a fixed range")
    change(b, "range-mode", "all")
    middle = "(() => { const c = []; page.scene.furniture.bar.getScalarsToColors().getColor((%g + %g) / 2, c); return c.map(x => x.toFixed(2)).join(); })()" % tuple(before)
    one = of_page(b, middle)
    b.key("m")
    check(b.wait("document.getElementById('map').value === 'inferno'") and b.wait(f"import('./main.js').then(({{ page }}) => {middle} !== '{one}')"), "m: another colour map")
    change(b, "field", "material")
    check(b.wait("document.getElementById('legend').textContent.includes('Left disk')"), "the legend names the materials")
    change(b, "field", "von_mises")


def parts_and_sections(b):
    total = drawn(b)
    b.run("document.querySelectorAll('#parts input')[1].click()")
    check(b.wait(f"Number(document.body.dataset.drawn) < {total}"), "a material is hidden")
    b.run("document.querySelectorAll('#parts input')[1].click()")
    check(b.wait(f"Number(document.body.dataset.drawn) === {total}"), "and shown again")
    b.run("document.querySelector('#parts button').click()")
    check(b.wait(f"Number(document.body.dataset.drawn) < {total} && !document.querySelectorAll('#parts input')[1].checked"), "only one is shown")
    b.run("document.querySelector('#parts button').click()")
    check(b.wait(f"Number(document.body.dataset.drawn) === {total}"), "and all again")
    b.run("document.getElementById('section-x').click()")
    check(b.wait(f"Number(document.body.dataset.drawn) < {total}"), "a section")
    b.run("document.getElementById('section-x').click()")
    b.wait(f"Number(document.body.dataset.drawn) === {total}")
    of_page(b, "{ page.settings.most = 100; page.player.go(page.player.at); }")
    check(b.wait("document.getElementById('note').textContent.includes('thinned')") and drawn(b) <= 100, "thinned, and said")
    of_page(b, "{ page.settings.most = 250000; page.player.go(page.player.at); }")
    b.wait(f"Number(document.body.dataset.drawn) === {total}")
    b.key("v")
    check(b.wait("import('./main.js').then(({ page }) => page.frame.parts.arrow_places.length > 0 && page.scene.arrows.actor.getVisibility())"), "v: arrows")
    check(b.wait("/arrows of [\\d.e]+ /.test(document.getElementById('arrow-note').textContent)"), "the length of the longest with its unit")
    change(b, "arrows", "")


def pick(b):
    place = of_page(b, "Array.from(page.frame.parts.positions.slice(300, 303))")
    b.click(*client_of(b, place))
    check(b.wait("/^Particle \\d+, (Left|Right) disk/.test(document.querySelector('#picked h2')?.textContent)"), "a particle is picked")
    check("stress.xx" in b.run("document.querySelector('#picked table').textContent"), "its fields")
    b.run("[...document.querySelectorAll('#picked tr')].find(r => r.textContent.startsWith('velocity.x')).click()")
    check(b.wait("document.querySelector('#history .uplot') !== null"), "a chart of its history")
    check("velocity" in b.run("document.querySelector('#history .u-title').textContent"), "the chart has a title")
    before = b.run("document.querySelector('#picked table').textContent")
    b.key("Home"), shows(b, 0)
    check(b.wait(f"document.querySelector('#picked table').textContent !== {json.dumps(before)}"), "the values follow the time")
    b.key("Escape")
    check(b.wait("document.querySelector('#picked h2') === null"), "Esc forgets it")


def charts_and_help(b):
    check(b.wait("document.querySelectorAll('#charts .uplot').length >= 3"), "charts of histories and energies")
    check(b.run("document.querySelector('#charts .u-title').textContent.includes('[')"), "with units")
    b.run("document.querySelector('#charts .u-over').scrollIntoView({ block: 'center' })")
    x, y, w, h = b.run("(r => [r.left, r.top, r.width, r.height])(document.querySelector('#charts .u-over').getBoundingClientRect())")
    b.drag(x + 0.3 * w, y + 0.5 * h, x + 0.6 * w, y + 0.5 * h)
    check(b.wait("import('./main.js').then(({ page }) => { const p = page.charts.charts[0].plot, t = p.data[0]; return p.scales.x.max - p.scales.x.min < 0.5 * (t.at(-1) - t[0]); })"), "dragging zooms")
    b.run("window.scrollTo(0, 0)")
    b.key("?")
    check(b.run("document.getElementById('help').open && document.querySelectorAll('#help kbd').length") >= 15, "?: the keys")
    b.key("?")
    check(not b.run("document.getElementById('help').open"), "and away again")


def pictures_and_films(b, folder):
    b.key("Home"), shows(b, 0)
    b.key("s")
    png = downloaded(folder, ".png")
    check(png[:8] == b"\x89PNG\r\n\x1a\n" and len(png) > 5000, "s: a picture is saved")
    b.run("document.getElementById('film').click()")
    check(b.wait("Number(document.body.dataset.shown) >= 4 && document.getElementById('film').textContent === 'Stop'"), "a film is recorded")
    b.run("document.getElementById('film').click()")
    film = downloaded(folder, ".webm")
    check(film[:4] == b"\x1a\x45\xdf\xa3" and len(film) > 5000, f"a film is saved: {len(film)} bytes, {film[:4]}")
    check(b.wait("document.getElementById('film').textContent === 'Film'"), "and the page is as before")


def phone(b):
    b.resize(390, 844, phone=True)
    check(b.wait("document.querySelector('#view canvas').getBoundingClientRect().width <= 390"), "the picture fits a phone")
    check(b.wait("document.documentElement.scrollWidth <= 390"), "nothing is wider than a phone")
    check(b.run("[...document.querySelectorAll('footer button, #tools button')].every(e => { const r = e.getBoundingClientRect(); return r.left >= 0 && r.right <= 390; })"), "all buttons are there")
    b.resize(1000, 720)


def space(b, address):
    b.open(address)
    check(b.wait("document.body.dataset.shown !== undefined && document.title === 'A ball on a plate'"), "a page of a run in space")
    check(b.wait("document.getElementById('note').textContent.includes('inside are not drawn')"), "what is inside is not drawn")
    check(b.run("[...document.querySelectorAll('#parts label')].map(e => e.querySelector('span:not(.patch)').textContent).join()") == "ball,ball 1,ball 2,plate", "materials and bodies")
    before = drawn(b)
    b.run("document.getElementById('section-z').click()")
    check(b.wait(f"Number(document.body.dataset.drawn) !== {before}") and of_page(b, "page.frame.parts.positions.filter((_, k) => k % 3 === 2).every(z => z <= 0.01)"), "a section in space")
    of_page(b, "(m => { const draw = m.draw; m.speed = 30; m.draw = most => { const n = draw(most); if (n < m.total) m.fewest = Math.min(n, m.fewest ?? n); return n; }; })(page.scene.motion)")
    b.drag(500, 350, 540, 370)
    check(0 < of_page(b, "page.scene.motion.fewest ?? 0") <= 2000 < of_page(b, "page.scene.motion.total"), "fewer particles while the camera moves, if the computer is slow")
    check(b.wait("import('./main.js').then(({ page }) => page.scene.motion.count === page.scene.motion.total)", 10), "then all again")
    views = "page.scene.renderer.getActiveCamera().getDirectionOfProjection().map(x => Math.round(x)).join()"
    b.run("[...document.querySelectorAll('#cameras button')].find(e => e.textContent === 'x, y').click()")
    check(of_page(b, views) in ("0,0,-1", "-0,-0,-1"), "a view along an axis")
    b.click(*client_of(b, (0.05, -1.5, 0)))
    check(b.wait("/^Particle \\d+, plate/.test(document.querySelector('#picked h2')?.textContent)"), "a particle of the section is picked")


def blocks(b, address):
    b.open(address)
    check(b.wait("document.body.dataset.shown !== undefined && document.title.startsWith('Direct tension')"), "a page of blocks")
    check(b.wait("document.getElementById('legend').textContent.includes('bonds torn')"), "torn bonds are named")
    place = of_page(b, "(c => [0, 1, 2].map(d => (Math.min(...c.map(x => x[d])) + Math.max(...c.map(x => x[d]))) / 2))([...Array(page.frame.parts.block_cells[0])].map((_, k) => { const at = 3 * page.frame.parts.block_cells[1 + k]; return [...page.frame.parts.block_corners.slice(at, at + 3)]; }))")
    b.click(*client_of(b, place))
    check(b.wait("/^Block \\d+/.test(document.querySelector('#picked h2')?.textContent)"), "a block is picked")
    check(b.wait("document.querySelectorAll('#picked h2')[1]?.textContent.startsWith('Contact of the blocks')"), "and the contact next to it")
    change(b, "arrows", "contact forces")
    check(b.wait("/arrows of [\\d.e]+ N/.test(document.getElementById('arrow-note').textContent)"), "contact forces as arrows, with their unit")


def view_of_plate(b):
    before = sorted(os.listdir("."))
    with served("view", "--set", "load=7", "plate.xml") as address:
        layers = {layer["name"]: layer for layer in json.loads(get(address + "layers"))}
        for name in ("edges of the grid", "cells", "symmetry planes", "velocity of nodes prescribed in y", "tractions", "cracks", "gravity"):
            check(name in layers, f"the layer '{name}'")
        check(layers["cracks"]["points"][0][:2] == [4, 5] and layers["velocity of nodes prescribed in y"]["note"] == "17 nodes", "where they are")
        state = json.loads(get(address + "state"))
        check(state["status"] == "model" and not state["folder"].startswith(os.getcwd()) and os.path.isdir(state["folder"]), "a folder of its own")
        if b:
            b.open(address)
            check(b.wait("document.body.dataset.shown === '0' && document.title === 'A plate with a crack'"), "the page of a model")
            check("cracks" in b.run("document.getElementById('layers').textContent") and not b.run("document.querySelector('footer').checkVisibility()"), "its layers, and nothing to play")
            check(of_page(b, "page.settings.field") == "material", "in the colours of its bodies")
            b.run("[...document.querySelectorAll('#layers label')].find(e => e.textContent.includes('cells')).querySelector('input').click()")
            check(of_page(b, "page.scene.layers.list.find(l => l.name === 'cells').actor.getVisibility()"), "a layer is shown")
            b.leave()
    check(not os.path.exists(state["folder"]) and sorted(os.listdir(".")) == before, "nothing remains")


def views():
    server = subprocess.Popen([tribo, "view", source + "/input/examples/two_disks.fmcmd"], stdout=subprocess.PIPE, text=True)
    try:
        folder = json.loads(get(server.stdout.readline().split()[1] + "state"))["folder"]
        server.terminate()
        check(server.wait(20) == 0 and not os.path.exists(folder), "a script; SIGTERM removes the folder, too")
    finally:
        server.kill()
    with served("view", source + "/input/examples/direct_tension.xml") as address:
        head, parts = frame(address, 0)
        check(head["blocks"] > 100 and any(layer["name"] == "platens" for layer in json.loads(get(address + "layers"))), "a model of blocks")
    open("wrong.xml", "w").write(plate.replace("matname='steel'", "matname='steal'"))
    for command in ("check", "view"):
        told = subprocess.run([tribo, command, "wrong.xml"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        check(told.returncode == 3 and told.stdout == "" and "did you mean 'steel'?" in told.stderr, f"{command}: exit 3, and the remedy")
    check(subprocess.run([tribo, "view", "nowhere.xml"], stderr=subprocess.DEVNULL).returncode == 5, "no file: exit 5")


with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:
    os.chdir(folder)
    open("ball.xml", "w").write(ball), open("plate.xml", "w").write(plate)
    for name, file in (("disks", source + "/tests/input/legacy_disks.xml"), ("ball", "ball.xml"), ("blocks", source + "/input/examples/direct_tension.xml")):
        check(subprocess.run([tribo, "run", "--quiet", "-o", name, file]).returncode == 0, f"the run of {name}")
    with contextlib.ExitStack() as stack:
        b = stack.enter_context(browser.Browser(folder, 1000, 720)) if browser.installed() else None
        with served("watch", "disks") as address:
            last = len(json.loads(get(address + "state"))["times"]) - 1
            answers_of_disks(address, last)
            drawing = len(get(address + "vtk.js")) > 1000 and len(get(address + "uplot.js")) > 1000
            if b and not drawing:
                print("The program has no vtk.js or no uPlot: the page itself was not looked at"), b.__exit__(), stack.pop_all()
                b = None
            if b:
                b.open(address)
                check(b.wait("document.body.dataset.shown !== undefined", 60), "the page draws")
                play_and_scrub(b, last), colours(b), parts_and_sections(b), pick(b), charts_and_help(b)
                pictures_and_films(b, os.path.join(folder, "downloads")), phone(b), b.leave()
        if b:
            with served("watch", "ball") as address:
                space(b, address), b.leave()
            with served("watch", "blocks") as address:
                blocks(b, address), b.leave()
        view_of_plate(b), views()
        if b:
            check(not b.problems, "no errors: " + "; ".join(b.problems))
        elif not browser.installed():
            print("Chromium is not installed: the page itself was not looked at")
print(f"{check.passed} passed, 0 failed")
