# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Drives Debian's Chromium without a screen over its DevTools protocol, by pipes: opens pages, runs
scripts in them, takes pictures, and keeps what their consoles say. It needs no other package."""
import base64
import contextlib
import json
import os
import select
import shutil
import struct
import subprocess
import tempfile
import time
import zlib

BROWSER = shutil.which("chromium") or shutil.which("chromium-browser")
FLAGS = ["--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--disable-background-networking",
         "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--hide-scrollbars",
         "--force-device-scale-factor=1", "--no-first-run",
         "--host-resolver-rules=MAP * ~NOTFOUND, EXCLUDE localhost, EXCLUDE 127.0.0.1",
         "--remote-debugging-pipe"]
PATIENCE_S = 60


class Browser:
    """The process; use open_browser()."""

    def __init__(self, process, read_fd, write_fd):
        self.process, self.read_fd, self.write_fd = process, read_fd, write_fd
        self.pending, self.last_id, self.pages = b"", 0, {}

    def _receive(self, deadline):
        while b"\0" not in self.pending:
            ready, _, _ = select.select([self.read_fd], [], [], max(0.0, deadline - time.monotonic()))
            chunk = os.read(self.read_fd, 1 << 20) if ready else b""
            if not chunk:
                raise AssertionError("Chromium does not answer")
            self.pending += chunk
        text, self.pending = self.pending.split(b"\0", 1)
        return json.loads(text)

    def call(self, method, session=None, **parameters):
        self.last_id += 1
        message = {"id": self.last_id, "method": method, "params": parameters}
        if session:
            message["sessionId"] = session
        os.write(self.write_fd, json.dumps(message).encode() + b"\0")
        deadline = time.monotonic() + PATIENCE_S
        while True:
            reply = self._receive(deadline)
            if reply.get("id") == self.last_id:
                if "error" in reply:
                    raise AssertionError(f"{method}: {reply['error']}")
                return reply["result"]
            if "method" in reply and reply.get("sessionId") in self.pages:
                self.pages[reply["sessionId"]].note(reply["method"], reply["params"])

    def open(self, url, width=1280, height=720, mobile=False):
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        session = self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        page = self.pages[session] = Page(self, session)
        for domain in ("Runtime", "Log", "Page"):
            page.call(f"{domain}.enable")
        page.call("Emulation.setDeviceMetricsOverride", width=width, height=height,
                  deviceScaleFactor=1, mobile=mobile)
        page.call("Page.navigate", url=url)
        return page


class Page:
    def __init__(self, browser, session):
        self.browser, self.session, self.faults = browser, session, []

    def note(self, method, event):
        if method == "Runtime.exceptionThrown":
            details = event["exceptionDetails"]
            said = details.get("exception", {}).get("description") or details["text"]
            self.faults.append(("exception", said))
        elif method == "Runtime.consoleAPICalled" and event["type"] in ("error", "warning", "assert"):
            self.faults.append(("console", " ".join(str(a.get("value")) for a in event["args"])))
        elif method == "Log.entryAdded" and event["entry"]["level"] in ("error", "warning"):
            entry = event["entry"]
            self.faults.append((entry["source"], entry["text"]))

    def call(self, method, **parameters):
        return self.browser.call(method, self.session, **parameters)

    def run(self, script):
        """Returns the value of an expression; promises are waited for."""
        result = self.call("Runtime.evaluate", expression=script, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in result:
            raise AssertionError(f"{script}: {result['exceptionDetails']}")
        return result["result"].get("value")

    def wait_for(self, condition, patience_s=PATIENCE_S):
        deadline = time.monotonic() + patience_s
        guarded = f"(() => {{ try {{ return Boolean({condition}); }} catch {{ return false; }} }})()"
        while not self.run(guarded):
            if time.monotonic() > deadline:
                raise AssertionError(f"in {patience_s} s this did not come true: {condition}; "
                                     f"the page said {self.faults}")
            time.sleep(0.05)

    def picture(self):
        return base64.b64decode(self.call("Page.captureScreenshot", format="png")["data"])


@contextlib.contextmanager
def open_browser(*flags):
    """Chromium with a profile of its own, for the time of a with statement."""
    commands, send = os.pipe()
    receive, events = os.pipe()
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
        words = [BROWSER, *FLAGS, *flags, f"--user-data-dir={profile}", "about:blank"]
        # The browser reads commands from 3 and writes to 4.
        process = subprocess.Popen(
            ["bash", "-c", f'exec "$@" 3<&{commands} 4>&{events}', "bash", *words],
            pass_fds=(commands, events), stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL)
        os.close(commands)
        os.close(events)
        try:
            yield Browser(process, receive, send)
        finally:
            process.terminate()
            process.wait(timeout=30)
            os.close(send)
            os.close(receive)


class Pixels:
    """A picture as PNG has it, 8 bits a channel, read without another package."""

    def __init__(self, png):
        self.width, self.height, depth, kind = struct.unpack(">IIBB", png[16:26])
        if depth != 8 or kind not in (2, 6):
            raise ValueError("a PNG of 8 bits with colours is needed")
        self.channels = 3 if kind == 2 else 4
        data, at = b"", 8
        while at < len(png):
            size, name = struct.unpack(">I4s", png[at:at + 8])
            if name == b"IDAT":
                data += png[at + 8:at + 8 + size]
            at += 12 + size
        self.rows = self._unfilter(zlib.decompress(data))

    def _unfilter(self, data):
        stride, step = self.width * self.channels, self.channels
        before, rows = bytearray(stride), []
        for y in range(self.height):
            kind, row = data[y * (stride + 1)], bytearray(data[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
            for i in range(stride if kind else 0):
                left = row[i - step] if i >= step else 0
                corner = before[i - step] if i >= step else 0
                row[i] = (row[i] + self._predict(kind, left, before[i], corner)) & 255
            rows.append(row)
            before = row
        return rows

    @staticmethod
    def _predict(kind, left, above, corner):
        if kind == 1:
            return left
        if kind == 2:
            return above
        if kind == 3:
            return (left + above) // 2
        nearest = left + above - corner
        return min((left, above, corner), key=lambda value: abs(nearest - value))

    def at(self, x, y):
        return tuple(self.rows[y][x * self.channels:x * self.channels + 3])
