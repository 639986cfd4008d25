"""The page of every design in a real browser: `make page`.

    python tests/stress/page_in_browser.py FOLDER [DESIGN ...]

The slider turns the wheel to the core's angle, nothing is said on the console, a wheel of six
slots has 55 frames a second or more, and FOLDER gets pictures as on a desk and on a phone, light
and dark.
"""

import base64
import itertools
import json
import math
import shutil
import subprocess
import sys
import tempfile
import time
import urllib.request
from pathlib import Path

import numpy as np
import websocket
from test_page import ANGLE, DESIGNS, design_of, text_of, wheel_by_core

FRAMES = 55.0  # a second
SIX = "press-straight"
SIZES = {"desk": (1280, 1000, "light"), "phone": (390, 844, "dark")}
PLACES = 60


class Browser:
    """A Chromium without a window, and its one page."""

    def __init__(self, folder):
        program = shutil.which("chromium") or shutil.which("google-chrome")
        if program is None:
            raise SystemExit("no Chromium here: install it, as with `apt-get install chromium`")
        options = ("--headless", "--no-sandbox", "--disable-gpu", "--remote-debugging-port=0")
        origins = "--remote-allow-origins=*"
        self.process = subprocess.Popen(
            [program, *options, origins, f"--user-data-dir={folder}", "about:blank"],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        port = self._port(Path(folder, "DevToolsActivePort"))
        with urllib.request.urlopen(f"http://127.0.0.1:{port}/json") as answer:
            tab = next(one for one in json.load(answer) if one["type"] == "page")
        self.socket = websocket.create_connection(tab["webSocketDebuggerUrl"], timeout=60)
        self.numbers, self.said = itertools.count(1), []
        for name in ("Page", "Runtime", "Log"):
            self.ask(f"{name}.enable")

    def _port(self, file):
        for _ in range(300):
            if file.exists() and file.read_text().strip():
                return int(file.read_text().split()[0])
            time.sleep(0.1)
        raise SystemExit("Chromium did not start")

    def ask(self, method, **given):
        number = next(self.numbers)
        self.socket.send(json.dumps({"id": number, "method": method, "params": given}))
        while True:
            heard = json.loads(self.socket.recv())
            if heard.get("method") in ("Runtime.consoleAPICalled", "Runtime.exceptionThrown"):
                self.said.append(heard["params"])
            if heard.get("method") == "Log.entryAdded":
                self.said.append(heard["params"]["entry"])
            if heard.get("id") == number:
                assert "error" not in heard, heard["error"]
                return heard["result"]

    def run(self, script, wait=False):
        found = self.ask(
            "Runtime.evaluate", expression=script, returnByValue=True, awaitPromise=wait
        )
        assert "exceptionDetails" not in found, found
        return found["result"].get("value")

    def look(self, wide, high, scheme):
        phone = wide < 600
        self.ask(
            "Emulation.setDeviceMetricsOverride",
            width=wide, height=high, deviceScaleFactor=1, mobile=phone,
        )  # fmt: skip
        features = [
            {"name": "prefers-color-scheme", "value": scheme},
            {"name": "prefers-reduced-motion", "value": "no-preference"},
        ]
        self.ask("Emulation.setEmulatedMedia", features=features)

    def go(self, url):
        self.ask("Page.navigate", url=url)
        for _ in range(100):
            if self.run("document.readyState") == "complete" and self.run("!!window.document.body"):
                return
            time.sleep(0.05)
        raise SystemExit(f"{url}: not loaded")

    def picture(self, file):
        shot = self.ask("Page.captureScreenshot", format="png", captureBeyondViewport=True)
        file.write_bytes(base64.b64decode(shot["data"]))


PUT = """
(t => { const input = document.getElementById("input");
  input.value = t; input.dispatchEvent(new Event("input"));
  const turned = document.getElementById("wheel").getAttribute("transform");
  return [Number(input.value), Number(/rotate\\(([^)]*)\\)/.exec(turned)[1])]; })
"""
COUNT = """
new Promise(done => { let n = 0, start = performance.now();
  const tick = now => { n++; now - start < 2000 ? requestAnimationFrame(tick)
    : done(1000 * n / (now - start)); };
  requestAnimationFrame(tick); })
"""


def look_at(browser, name, folder):
    """What is wrong with the page of a design."""
    file = (folder / f"{name}.html").resolve()
    file.write_text(text_of(name))
    wrong, rate = [], None
    for size, (wide, high, scheme) in SIZES.items():
        browser.said.clear()
        browser.look(wide, high, scheme)
        browser.go(file.as_uri())
        turn = browser.run("Number(document.getElementById('input').max)")
        at = np.linspace(0.0, turn, PLACES)
        if size == "desk":
            rate = browser.run(COUNT, wait=True)
            put = [browser.run(f"{PUT}({t})") for t in at.tolist()]
            seen, turned = np.array(put).T
            expected = -np.degrees(wheel_by_core(design_of(name), seen)[0])
            off = np.abs(turned - expected).max() * math.pi / 180.0
            if off > ANGLE or np.abs(seen - at).max() > 1e-9 * turn:
                wrong.append(f"the wheel is {off:.2g} rad off")
            if name == SIX and rate < FRAMES:
                wrong.append(f"{rate:.0f} frames a second")
        browser.run(f"{PUT}({0.13 * turn})")
        if browser.run("document.documentElement.scrollWidth > innerWidth"):
            wrong.append(f"wider than a {size}")
        browser.picture(folder / f"{name}-{size}.png")
        wrong += [f"says {said}" for said in browser.said]
    return wrong, rate


def main(folder, *names):
    failed = 0
    with tempfile.TemporaryDirectory() as home:
        browser = Browser(home)
        try:
            for name in names or DESIGNS:
                wrong, rate = look_at(browser, name, Path(folder))
                failed += bool(wrong)
                print(f"{name}: {rate:.0f} frames a second; {'; '.join(wrong) or 'fine'}")
        finally:
            browser.process.terminate()
            browser.process.wait()
    sys.exit(failed > 0)


if __name__ == "__main__":
    main(*sys.argv[1:])
