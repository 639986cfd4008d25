"""The page of `make web` in a headless Chromium: `make web-test`.

    python tests/stress/web_in_browser.py FOLDER

It measures the time to the first answer, and compares verdicts and files with the commands' own.
The page may load nothing but its own files, and works when the server is gone.
"""

import base64
import functools
import http.server
import itertools
import json
import re
import shutil
import subprocess
import sys
import tempfile
import threading
import time
import urllib.request
from pathlib import Path
from typing import ClassVar

import websocket

GENEVA = Path(sys.executable).with_name("geneva")
DESIGNS = ("turret", "internal-z6", "four-bar-z4", "table-law", "spherical-z6")
BAD = {"[wheel]\nz = 6\nnn = 3\n": "spec.toml:3:", "[wheel]\nz = 60 rpm\n": "spec.toml:2:"}
FILES = ("wheel.dxf", "assembly.step", "plate.step", "sheet.pdf", "report.html")
CATCH = """
window.saved = {}; URL.createObjectURL = blob => { window.blob = blob; return "#"; };
HTMLAnchorElement.prototype.click = function () { window.saved[this.download] = window.blob; };
"""
READ = """
(async name => { for (let i = 0; i < 900 && !window.saved[name]; i++)
    await new Promise(done => setTimeout(done, 100));
  const bytes = new Uint8Array(await window.saved[name].arrayBuffer());
  return btoa(bytes.reduce((text, byte) => text + String.fromCharCode(byte), "")); })
"""
PUT = """
(text => { const box = document.getElementById("spec"); box.value = text;
  box.dispatchEvent(new Event("input")); document.body.classList.add("busy"); })
"""
# Chooses a design from the page's list, which also writes the files that its spec names.
CHOOSE = """
(name => { const list = document.getElementById("start"); list.value = name;
  list.dispatchEvent(new Event("change")); document.body.classList.add("busy"); })
"""


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

    def look(self, wide, high):
        size = {"width": wide, "height": high, "deviceScaleFactor": 1, "mobile": wide < 600}
        self.ask("Emulation.setDeviceMetricsOverride", **size)

    def go(self, url):
        self.ask("Page.navigate", url=url)
        for _ in range(100):
            if self.run("document.readyState") == "complete" and self.run("!!window.document.body"):
                return
            time.sleep(0.05)
        raise SystemExit(f"{url}: not loaded")


class Quiet(http.server.SimpleHTTPRequestHandler):
    """A server of files that notes what it is asked for."""

    requested: ClassVar[list[str]] = []

    def do_GET(self):
        self.requested.append(self.path)
        super().do_GET()

    def log_message(self, *_):
        pass


def wait(browser, condition, seconds=60.0):
    start = time.perf_counter()
    while not browser.run(condition):
        if time.perf_counter() - start > seconds:
            raise SystemExit(f"not after {seconds:.0f} s: {condition}")
        time.sleep(0.05)
    return time.perf_counter() - start


def answer(browser, value, action=PUT):
    """The verdict that the page shows for a spec's text, and the seconds it took."""
    browser.run(f"{action}({json.dumps(value)})")
    seconds = wait(browser, "!document.body.classList.contains('busy')")
    return browser.run("document.querySelector('#verdict .head').textContent"), seconds


def spoken(folder, text):
    """The headline of `geneva check` on the same text."""
    (folder / "spec.toml").write_text(text, encoding="utf-8")
    done = subprocess.run(
        [GENEVA, "check", "spec.toml"], cwd=folder, capture_output=True, text=True
    )
    # A mark for passed, warned or failed begins the line.
    return (done.stdout or done.stderr).splitlines()[0].replace("spec.toml: ", "").lstrip("✓!✗ ")


def written(folder, name):
    """The bytes of a file that the commands write."""
    part = name.partition(".")[0]
    words = ["report"] if part == "report" else ["profile", "--part", part]
    subprocess.run([GENEVA, *words, "spec.toml", "-o", name], cwd=folder, capture_output=True)
    return (folder / name).read_bytes()


POINT = re.compile(rb"CARTESIAN_POINT\('',\(([^)]*)\)\)")


def alike(name, first, second):
    """Whether two files are the same bytes; of STEP files, whether they have the same points.

    The browser's mathematical library rounds some sines another way, and equal points are one.
    """
    if not name.endswith(".step"):
        return first == second
    one, other = (
        {tuple(round(float(x), 6) + 0.0 for x in p.split(b",")) for p in POINT.findall(data)}
        for data in (first, second)
    )
    return one == other and len(one) > 100


def main(folder):
    serve = functools.partial(Quiet, directory=folder)
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), serve)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    url = f"http://127.0.0.1:{server.server_port}/"
    wrong = []
    with tempfile.TemporaryDirectory() as profile, tempfile.TemporaryDirectory() as place:
        browser, here = Browser(profile), Path(place)
        browser.look(1280, 900)
        start = time.perf_counter()
        browser.go(url)
        wait(browser, "document.body.dataset.ready === 'true'", 120.0)
        first = time.perf_counter() - start
        print(f"first answer after {first:.1f} s")
        browser.run(CATCH)
        for name in DESIGNS:
            new = subprocess.run(
                [GENEVA, "new", "--from-design", name, "-o", "spec.toml", "--force"], cwd=here
            )
            text = (here / "spec.toml").read_text()
            shown, seconds = answer(browser, f"Designs/{name}", CHOOSE)
            expected = spoken(here, text)
            print(f"{name}: {seconds:.1f} s: {shown}")
            if new.returncode or shown != expected:
                wrong.append(f"{name}: {shown!r}, but check says {expected!r}")
        for text, begin in BAD.items():
            shown, _ = answer(browser, text)
            print(shown)
            if not shown.startswith(begin) or "Traceback" in shown:
                wrong.append(f"{text!r}: {shown!r}")
        text = "[wheel]\nz = 6\n"
        answer(browser, text)
        spoken(here, text)
        for name in (*FILES, "all.zip"):
            start = time.perf_counter()
            browser.run(f"document.querySelector(`[data-file='{name}']`).click()")
            data = base64.b64decode(browser.run(f"{READ}({json.dumps(name)})", wait=True))
            print(f"{name}: {len(data)} bytes in {time.perf_counter() - start:.1f} s")
            if name in FILES and not alike(name, data, written(here, name)):
                wrong.append(f"{name}: not the file that the command writes")
        browser.look(390, 844)
        if browser.run("document.documentElement.scrollWidth > innerWidth"):
            wrong.append("wider than a phone")
        wrong += [f"says {json.dumps(said)[:200]}" for said in browser.said[:5]]
        wait(
            browser,
            "navigator.serviceWorker.controller !== null || !!window.x || "
            "(navigator.serviceWorker.ready.then(() => window.x = 1), false)",
            60.0,
        )
        server.shutdown()
        server.server_close()
        browser.go(url)
        wait(browser, "document.body.dataset.ready === 'true'", 120.0)
        print("opens again without the server")
        browser.process.kill()
        browser.process.wait()
    other = [path for path in Quiet.requested if not Path(folder, path.lstrip("/")).exists()]
    wrong += [f"asked for {path}" for path in other]
    print("\n".join(wrong) or "all as the commands say")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
