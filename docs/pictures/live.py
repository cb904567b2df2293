"""Makes the pictures of the live locomotive for README.md: docs/pictures/live-light.png and live-dark.png.

    python3 docs/pictures/live.py [PATH OF THE COMMAND dashpot]

Needs chromedriver and Chromium. The locomotive runs for some seconds before the picture is taken at a time that differs
from run to run, so no test compares the pictures. Make them again when the page looks different.
"""

import base64
import json
import pathlib
import subprocess
import sys
import tempfile
import time
import urllib.request

HERE = pathlib.Path(__file__).parent
CASE = "curve-r600"
PORT = 9519
WIDTH, HEIGHT = 1280, 790
# Simulated time after which the picture is taken.
RUN_S = 8
# Largest file, bytes: a page of the repository's host shows both pictures at once.
MAX_BYTES = 150_000
# Values of Chromium's setting for the colour scheme that pages ask for.
SCHEMES = {"dark": 0, "light": 1}


def ask(method, path, body=None):
    """Returns the value with which chromedriver answers."""
    data = None if body is None else json.dumps(body).encode()
    request = urllib.request.Request(f"http://127.0.0.1:{PORT}{path}", data, method=method)
    with urllib.request.urlopen(request) as answer:
        return json.load(answer)["value"]


def wait_for(condition, what):
    """Asks until the condition holds, for a minute at most."""
    for _ in range(120):
        try:
            if condition():
                return
        except OSError:
            pass
        time.sleep(0.5)
    sys.exit(f"error: {what} within a minute")


def picture(page, scheme):
    """Runs the page and returns a PNG of its top."""
    arguments = [
        "--headless=new", "--no-sandbox", "--hide-scrollbars", f"--window-size={WIDTH},{HEIGHT}",
        f"--blink-settings=preferredColorScheme={SCHEMES[scheme]}",
    ]
    options = {"goog:chromeOptions": {"args": arguments}}
    session = ask("POST", "/session", {"capabilities": {"alwaysMatch": options}})["sessionId"]
    try:
        def script(text):
            return ask("POST", f"/session/{session}/execute/sync", {"script": text, "args": []})

        ask("POST", f"/session/{session}/url", {"url": page.as_uri()})
        has_run = f"return live.scene && live.histories[0].newest?.time_s > {RUN_S}"
        wait_for(lambda: script(has_run), f"the locomotive did not run for {RUN_S} s")
        return base64.b64decode(ask("GET", f"/session/{session}/screenshot"))
    finally:
        ask("DELETE", f"/session/{session}")


def main():
    command = sys.argv[1:] or ["cargo", "run", "--release", "--"]
    with tempfile.TemporaryDirectory() as folder:
        page = pathlib.Path(folder, "live.html")
        subprocess.run([*command, "live", "--case", CASE, "--page", page], check=True)
        driver = subprocess.Popen(["chromedriver", f"--port={PORT}"], stdout=subprocess.DEVNULL)
        try:
            wait_for(lambda: ask("GET", "/status")["ready"], "chromedriver did not start")
            for scheme in SCHEMES:
                png = picture(page, scheme)
                path = HERE / f"live-{scheme}.png"
                if len(png) > MAX_BYTES:
                    sys.exit(f"error: {path}: {len(png)} bytes, allowed: at most {MAX_BYTES}")
                path.write_bytes(png)
                print(f"wrote {path}, {len(png)} bytes")
        finally:
            driver.terminate()
            driver.wait()


main()
