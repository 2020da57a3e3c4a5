#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""`tribo report`, `tribo render` and `tribo watch`, the page in headless Chromium. Usage: test_watch.py TRIBO SOURCE_DIR"""

import json
import os
import re
import select
import shutil
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import time
import urllib.error
import urllib.request

import browser
import checks

tribo, source = sys.argv[1:3]
check = checks.Checks()


def get(path, **options):
    with urllib.request.urlopen(urllib.request.Request(address + path, **options), timeout=20) as answer:
        return answer.read()


def code_of(path, **options):
    try:
        get(path, **options)
        return 200
    except urllib.error.HTTPError as error:
        return error.code


with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:
    os.chdir(folder)
    deck = open(source + "/tests/input/legacy_disks.xml").read()
    open("long.xml", "w").write(re.sub(r"<MaxTime units=.ms.>[^<]*", "<MaxTime units='ms'>100000", deck))
    short = subprocess.run([tribo, "run", "--quiet", "-o", "short", source + "/tests/input/legacy_disks.xml"])
    check(short.returncode == 0, "the short run")

    subprocess.run([tribo, "report", "short"], check=True, stdout=subprocess.DEVNULL)
    page = open("short/report.html").read()
    check("http" not in page.replace("http://www.w3.org", ""), "the report asks the network for nothing")
    check(page.count("data:image/png;base64,") == 4, "the report has four pictures")
    check("Energy ledger" in page and "Where the time went" in page and "crc32:" in page, "the report's parts")
    check(subprocess.run([tribo, "report", "nowhere"], stderr=subprocess.DEVNULL).returncode == 5, "no run: exit 5")
    bad = subprocess.run([tribo, "render", "short", "--field", "velocty"], stderr=subprocess.PIPE, text=True)
    check(bad.returncode == 2 and "did you mean 'velocity'" in bad.stderr, "an unknown field: exit 2 and a hint")
    subprocess.run([tribo, "render", "short", "-o", "film", "--width", "400"], check=True, stdout=subprocess.DEVNULL)
    frames = len(re.findall("<DataSet", open("short/run.pvd").read()))
    check(len([f for f in os.listdir("film") if f.endswith(".png")]) == frames, "a picture for every file")
    check(os.path.exists("film/von_mises.mp4") == bool(shutil.which("ffmpeg")), "a film if ffmpeg is there")

    zoomed = [tribo, "render", "short", "-o", "zoomed", "--width", "400", "--time", "0"]
    check(subprocess.run([*zoomed, "--zoom", "3"], stdout=subprocess.DEVNULL).returncode == 0, "a magnified picture")
    bad = subprocess.run([*zoomed, "--window=1e6,2e6,0,1"], stderr=subprocess.PIPE, text=True)
    check(bad.returncode == 2 and "nothing lies in it" in bad.stderr, "a window beside the particles: exit 2")
    before = {f: os.path.getmtime("film/" + f) for f in os.listdir("film")}
    subprocess.run([tribo, "render", "short", "-o", "film", "--field", "velocity.x", "--time", "1e9", "--width", "400"], check=True, stdout=subprocess.DEVNULL)
    check(set(os.listdir("film")) - set(before) == {f"velocity.x_{frames - 1:05d}.png"}, "a picture has the field and the number of its file")
    check(all(os.path.getmtime("film/" + f) == t for f, t in before.items()), "a picture of another field replaces none")
    open("few.xml", "w").write(re.sub(r"<Output\b.*?(/>|</Output>)", "", deck, flags=re.S).replace("</MPMHeader>", "<Output fields='velocity'/></MPMHeader>"))
    check(subprocess.run([tribo, "run", "--quiet", "-o", "few", "few.xml"]).returncode == 0, "a run that writes velocities only")
    subprocess.run([tribo, "render", "few", "--time", "0", "--width", "400"], check=True, stdout=subprocess.DEVNULL)
    check(os.listdir("few/pictures") == ["velocity_00000.png"], "without von_mises another field is drawn")

    again = [tribo, "render", "few", "--time", "0", "1e9", "--width", "300"]
    check(subprocess.run(again, stdout=subprocess.DEVNULL).returncode == 0, "pictures of an earlier call are replaced")
    last = max(os.listdir("few/pictures"))
    open("few/pictures/" + last, "w").write("mine")
    drawn = open("few/pictures/velocity_00000.png", "rb").read()
    refused = subprocess.run(again[:-1] + ["400"], stderr=subprocess.PIPE, text=True)
    check(refused.returncode == 5 and "not made by 'tribo render'" in refused.stderr and last in refused.stderr, "a file that render has not made is in the way")
    check(open("few/pictures/" + last).read() == "mine" and open("few/pictures/velocity_00000.png", "rb").read() == drawn, "nothing was changed")

    blocks = subprocess.run([tribo, "run", "--quiet", "-o", "blocks", source + "/input/examples/direct_tension.xml"])
    check(blocks.returncode == 0, "a run of blocks")
    server = subprocess.Popen([tribo, "watch", "blocks"], stdout=subprocess.PIPE, text=True)
    try:
        address = server.stdout.readline().split()[1]
        frame = get(f"frame/{len(json.loads(get('state'))['times']) - 1}?field=stress.yy")
        head = json.loads(frame[: frame.index(b"\n")])
        length = {part["name"]: part["length"] for part in head["parts"]}
        check(len(frame) - frame.index(b"\n") - 1 == 4 * sum(length.values()), "the length of a frame of blocks")
        check(head["count"] == 0 and head["blocks"] > 10 and length["block_values"] == head["blocks"] and length["torn_cells"] > 0, "blocks and torn bonds")
        check(head["range"][1] > 0 and head["flat"], "the stress of blocks")
    finally:
        server.kill()

    run = subprocess.Popen([tribo, "run", "--quiet", "-o", "long", "long.xml"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    while not os.path.exists("long/run.pvd"):
        check(run.poll() is None, "the long run goes on")
        time.sleep(0.05)
    server = subprocess.Popen([tribo, "watch", "long"], stdout=subprocess.PIPE, text=True)
    try:
        address = server.stdout.readline().split()[1]
        state = json.loads(get("state"))
        check(state["status"] == "running" and state["process"] == run.pid, "the state of a running run")
        frame = get("frame/0?field=velocity.x")
        head = json.loads(frame[: frame.index(b"\n")])
        body = frame[frame.index(b"\n") + 1 :]
        check([part["name"] for part in head["parts"][:4]] == ["positions", "values", "axes", "indices"], "the parts of a frame")
        check(head["domains"] and len(body) == 56 * head["count"] and head["flat"] and "stress.xy" in head["fields"], "a frame")
        speeds = set(struct.unpack(f"<{head['count']}f", body[12 * head["count"] : 16 * head["count"]]))
        check(speeds == {2500.0, -2500.0}, "its values")
        axes = struct.unpack("<9f", body[16 * head["count"] : 16 * head["count"] + 36])
        check(abs(axes[0] * axes[4] - axes[1] * axes[3]) > 0 and not any(axes[6:]), "the half axes of a domain in the plane")
        check(get("picture/0")[:8] == b"\x89PNG\r\n\x1a\n", "a picture")
        check(b"<svg" in get("charts"), "charts")
        check(code_of("frame/999999") == 400 and code_of("frame/0?field=nothing") == 400, "what is not there")
        check(code_of("nowhere") == 404, "an unknown page")
        check(code_of("state", headers={"Host": "example.org"}) == 403, "another machine's name is refused")
        check(code_of("stop", method="POST") == 403, "a form of another page cannot stop the run")
        check(re.fullmatch(r"http://127\.0\.0\.1:\d+/[0-9a-f]{32}/", address), "the address has a random word")
        whole, address = address, address[:-33]
        check(code_of("state") == 404 and code_of("0" * 32 + "/state") == 404, "without this word nothing is told")
        check(code_of("stop", method="POST", headers={"X-Tribo": "1"}) == 404 and run.poll() is None, "nor is the run stopped")
        port, address = int(whole.split(":")[2].split("/")[0]), whole
        with urllib.request.urlopen(address, timeout=20) as answer:
            headers = answer.headers
            check(headers["X-Frame-Options"] == "DENY" and headers["X-Content-Type-Options"] == "nosniff", "headers of the page")
            check("default-src 'none'" in headers["Content-Security-Policy"], "what the page may load")
        with socket.create_connection(("127.0.0.1", port), timeout=20) as slow:
            begin = time.time()
            slow.sendall(b"GET / HTTP/1.1\r\n")
            while time.time() < begin + 15:  # a line now and then
                time.sleep(0.5)
                try:
                    slow.sendall(b"X-More: 1\r\n")
                    if select.select([slow], [], [], 0)[0]:
                        break
                except OSError:
                    break
            check(time.time() < begin + 10, "a slow request is given up")
        with socket.create_connection(("127.0.0.1", port), timeout=20) as large:
            try:
                large.sendall(b"GET / HTTP/1.1\r\n" + b"X-More: 1\r\n" * 100000)
                check(b"200" not in large.recv(100), "a request with too many headers is refused")
            except OSError:
                pass

        if browser.installed():
            with browser.Browser(folder) as b:
                b.open(address)
                check(b.wait("document.body.dataset.shown !== undefined", 60), "the page shows particles")
                check(b.run("document.getElementById('status').textContent") == "running", "the page tells that it runs")
                check(b.run("document.getElementById('follow').checked"), "it follows the run")
                count = "Number(document.getElementById('frame').max)"
                before = b.run(count)
                check(b.wait(f"{count} > {before} && Number(document.body.dataset.shown) > {before}", 60), "it shows the newest time")
                check(b.wait("document.querySelector('#charts svg, #charts .uplot') !== null", 60), "its charts")
                check(not b.problems, "no errors: " + "; ".join(b.problems))
        else:
            print("Chromium is not installed: the page itself was not looked at")

        old = os.path.getmtime("long/checkpoint.bin") if os.path.exists("long/checkpoint.bin") else 0
        check(json.loads(get("checkpoint", method="POST", headers={"X-Tribo": "1"}))["sent"], "a checkpoint is asked for")
        for _ in range(100):
            if os.path.exists("long/checkpoint.bin") and os.path.getmtime("long/checkpoint.bin") > old:
                break
            time.sleep(0.05)
        check(os.path.getmtime("long/checkpoint.bin") > old and run.poll() is None, "a checkpoint, and the run goes on")
        check(json.loads(get("stop", method="POST", headers={"X-Tribo": "1"}))["sent"], "the run is asked to stop")
        check(run.wait(20) == 6, "it stops with a checkpoint")
        check(json.loads(get("state"))["status"] == "stopped", "the state of a stopped run")
        check(not json.loads(get("stop", method="POST", headers={"X-Tribo": "1"}))["sent"], "a run that ended is not asked again")
        server.send_signal(signal.SIGINT)
        check(server.wait(10) == 0, "Ctrl-C ends the page")
    finally:
        server.kill()
        run.kill()
print(f"{check.passed} passed, 0 failed")
