# SPDX-License-Identifier: MIT
"""A headless Chromium that is driven through its remote debugging pipe, with the standard library only."""

import base64
import json
import os
import select
import shutil
import signal
import subprocess
import time


def installed():
    """Whether there is a Chromium."""
    return bool(shutil.which("chromium"))


class Browser:
    """One page of a headless Chromium. `folder` holds its profile and what it downloads."""

    def __init__(self, folder, width=1280, height=900):
        to_browser, from_us = os.pipe()
        to_us, from_browser = os.pipe()
        self._write, self._read, self._buffer, self._number = from_us, to_us, b"", 0
        self.problems = []

        def redirect():  # the pipe has the descriptors 3 and 4
            low, high = os.dup(to_browser), os.dup(from_browser)
            os.dup2(low, 3), os.dup2(high, 4)

        self._process = subprocess.Popen(
            [shutil.which("chromium"), "--headless", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
             "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync",
             f"--user-data-dir={folder}/profile", f"--window-size={width},{height}", "--remote-debugging-pipe", "about:blank"],
            stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, pass_fds=(3, 4), preexec_fn=redirect, start_new_session=True)
        os.close(to_browser), os.close(from_browser)
        self._session = None
        target = next(t for t in self._call("Target.getTargets")["targetInfos"] if t["type"] == "page")
        self._session = self._call("Target.attachToTarget", targetId=target["targetId"], flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log"):
            self._call(domain + ".enable")
        self.resize(width, height)
        downloads = os.path.join(folder, "downloads")
        os.makedirs(downloads, exist_ok=True)
        session, self._session = self._session, None
        self._call("Browser.setDownloadBehavior", behavior="allow", downloadPath=downloads)
        self._session = session

    def __enter__(self):
        return self

    def __exit__(self, *_):
        try:
            self._session = None
            self._call("Browser.close", seconds=5)
            self._process.wait(5)
        except (OSError, TimeoutError, RuntimeError, subprocess.TimeoutExpired):
            os.killpg(self._process.pid, signal.SIGKILL)
            self._process.wait()
        os.close(self._write), os.close(self._read)

    def _message(self, deadline):
        while b"\0" not in self._buffer:
            if not select.select([self._read], [], [], max(0, deadline - time.time()))[0]:
                raise TimeoutError("the browser does not answer")
            more = os.read(self._read, 1 << 20)
            if not more:
                raise ConnectionError("the browser has ended")
            self._buffer += more
        text, self._buffer = self._buffer.split(b"\0", 1)
        return json.loads(text)

    def _call(self, method, seconds=30, **parameters):
        self._number += 1
        message = {"id": self._number, "method": method, "params": parameters}
        if self._session:
            message["sessionId"] = self._session
        os.write(self._write, json.dumps(message).encode() + b"\0")
        deadline = time.time() + seconds
        while True:
            answer = self._message(deadline)
            if answer.get("method") == "Runtime.exceptionThrown":
                self.problems.append(answer["params"]["exceptionDetails"].get("exception", {}).get("description", "exception"))
            if answer.get("method") == "Log.entryAdded" and answer["params"]["entry"]["level"] == "error":
                self.problems.append(answer["params"]["entry"]["text"])
            if answer.get("id") == self._number:
                if "error" in answer:
                    raise RuntimeError(method + ": " + answer["error"]["message"])
                return answer["result"]

    def open(self, address):
        """Goes to an address."""
        self._call("Page.navigate", url=address)

    def leave(self):
        """Leaves the page, which asks its server for news as long as it is shown: before the server ends."""
        self.open("about:blank")

    def resize(self, width, height, phone=False):
        """Sets the size of the window in pixels of CSS."""
        self._call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=phone)

    def run(self, expression):
        """The value of an expression of JavaScript, awaited if it is a promise."""
        result = self._call("Runtime.evaluate", expression=expression, awaitPromise=True, returnByValue=True)
        if "exceptionDetails" in result:
            raise RuntimeError(expression + ": " + result["exceptionDetails"].get("exception", {}).get("description", "exception"))
        return result["result"].get("value")

    def wait(self, expression, seconds=60):
        """Waits until an expression is true; returns whether it became so."""
        deadline = time.time() + seconds
        while time.time() < deadline:
            try:
                if self.run(expression):
                    return True
            except RuntimeError:  # the page is not there yet
                pass
            time.sleep(0.05)
        return False

    def key(self, name, shift=False):
        """Presses a key by its name in JavaScript: ' ', 'ArrowLeft', 'a'."""
        text = name if len(name) == 1 else ""
        for kind in ("keyDown", "keyUp"):
            self._call("Input.dispatchKeyEvent", type=kind, key=name, text=text if kind == "keyDown" else "", modifiers=8 if shift else 0)

    def click(self, x, y):
        """Presses and releases the left button of the mouse at a point of the window."""
        for kind in ("mouseMoved", "mousePressed", "mouseReleased"):
            self._call("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left", clickCount=1)

    def drag(self, x, y, to_x, to_y):
        """Drags from a point of the window to another one."""
        for kind, at, button in (("mouseMoved", (x, y), "none"), ("mousePressed", (x, y), "left"), ("mouseMoved", ((x + to_x) / 2, (y + to_y) / 2), "left"),
                                 ("mouseMoved", (to_x, to_y), "left"), ("mouseReleased", (to_x, to_y), "left")):
            self._call("Input.dispatchMouseEvent", type=kind, x=at[0], y=at[1], button=button, buttons=0 if button == "none" else 1, clickCount=1)

    def picture(self, file=None):
        """The window as bytes of a PNG, also written to a file if one is named."""
        data = base64.b64decode(self._call("Page.captureScreenshot", format="png")["data"])
        if file:
            with open(file, "wb") as out:
                out.write(data)
        return data
