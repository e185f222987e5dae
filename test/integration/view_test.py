#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Opens the page of lio-view in Chromium: points are drawn, the path is right to a pixel, a lost
server is found again, strangers are kept out, a phone shows it, and the console stays silent."""
import contextlib
import math
import os
import re
import signal
import subprocess
import sys
import unittest

import browser
import support

RADIUS_M, RATE_RADPS = 30.0, 0.1  # as lio_view_log drives
PATH_COLOUR = (0x22, 0xd3, 0xee)
ABOVE_M = 60.0                    # half the height of the page's view from above


def circle_log(seconds=20, points=3000):
    def make(folder):
        subprocess.run([support.BUILD / "bin/lio_view_log", folder / "log.lcm", str(seconds),
                        str(points)], check=True)
    return support.made_once(f"view-{seconds}-{points}", make,
                             support.BUILD / "bin/lio_view_log") / "log.lcm"


def place_at(t_s):
    angle = RATE_RADPS * t_s
    return RADIUS_M * math.sin(angle), RADIUS_M * (1.0 - math.cos(angle))


class Viewer:
    """lio-view as a process; `url` is what it told."""

    def __init__(self, *words, port=0):
        self.process = subprocess.Popen(
            [support.BUILD / "bin/lio-view", "--port", str(port), *map(str, words)],
            stdin=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        self.url = re.search(r"open (\S+)", self.process.stderr.readline()).group(1)
        self.port = int(re.search(r":(\d+)/", self.url).group(1))

    def end(self):
        self.process.send_signal(signal.SIGTERM)
        _, words = self.process.communicate(timeout=30)
        return self.process.returncode, words


@contextlib.contextmanager
def viewer(*words):
    running = Viewer(*words)
    try:
        yield running
    finally:
        if running.process.poll() is None:
            running.end()


@contextlib.contextmanager
def live_page():
    """A page in a browser of its own that shows what a lio-view hears."""
    with viewer() as running, browser.open_browser() as chromium:
        page = chromium.open(running.url)
        page.wait_for("window.lioView && lioView.seen.hello")
        yield page


def is_like(colour, wanted):
    return all(abs(a - b) <= 24 for a, b in zip(colour, wanted))


def stop_at(page, t_s):
    page.wait_for("lioView.seen.timeline && lioView.seen.poses > 0")
    page.run(f"lioView.link.send({{play: false, seek_s: {t_s}}})")
    page.wait_for(f"(t => t.t_s === {t_s} && !t.playing && !t.seeking)(lioView.seen.timeline)"
                  f" && lioView.seen.pose.stamp - 1.7e9 > {t_s - 0.02}")
    settle(page)


def settle(page):
    page.run("new Promise(done => setTimeout(() => requestAnimationFrame(() => requestAnimationFrame(done)), 300))")


@unittest.skipUnless(browser.BROWSER, "chromium is not installed")
class View(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.stack = contextlib.ExitStack()
        cls.chromium = cls.stack.enter_context(browser.open_browser())

    @classmethod
    def tearDownClass(cls):
        cls.stack.close()

    def see(self, url, **size):
        page = self.chromium.open(url, **size)
        page.wait_for("window.lioView && lioView.seen.hello")
        return page

    def test_the_path_is_right_to_a_pixel_and_points_are_drawn(self):
        with viewer("--log", circle_log()) as running:
            page = self.see(running.url)
            stop_at(page, 15)
            for tool in ("map", "scan", "plots", "figures"):
                page.run(f"lioView.setTool('{tool}', false)")
            page.run("lioView.setTool('above', true)")
            settle(page)
            bare = browser.Pixels(page.picture())
            here, scale = place_at(15), 360 / ABOVE_M  # pixels a metre
            for tenth in range(0, 140):
                x, y = place_at(0.1 * tenth)
                column, row = 640 + scale * (x - here[0]), 360 - scale * (y - here[1])
                near = [bare.at(int(column) + i, int(row) + j) for i in (-1, 0, 1) for j in (-1, 0, 1)]
                self.assertTrue(any(is_like(colour, PATH_COLOUR) for colour in near),
                                (tenth, column, row, near))
                said = page.run(f"lioView.stage.pixelOf([{x}, {y}, 1])")
                self.assertLess(math.dist(said, (column, row)), 0.51)
            page.run("lioView.setTool('map', true)")
            settle(page)
            full = browser.Pixels(page.picture())
            changed = sum(1 for y in range(60, 700, 2) for x in range(300, 1270, 2)
                          if full.at(x, y) != bare.at(x, y))
            self.assertGreater(changed, 500, "points of the map are drawn")
            self.assertEqual(page.run("lioView.stage.map.num > 100000"), True)
            self.assertEqual(page.faults, [])

    def test_with_webgl_the_points_are_drawn_as_well(self):
        with viewer("--log", circle_log()) as running:
            page = self.see(running.url + "#webgl")
            stop_at(page, 15)
            self.assertEqual(page.run("lioView.stage.splats"), None)
            for tool, wanted in (("plots", False), ("figures", False), ("above", True), ("map", False)):
                page.run(f"lioView.setTool('{tool}', {str(wanted).lower()})")
            settle(page)
            bare = browser.Pixels(page.picture())
            page.run("lioView.setTool('map', true)")
            settle(page)
            full = browser.Pixels(page.picture())
            changed = sum(1 for y in range(60, 700, 2) for x in range(300, 1270, 2)
                          if full.at(x, y) != bare.at(x, y))
            self.assertGreater(changed, 500)
            self.assertEqual(page.faults, [])

    def test_the_timeline_goes_back_and_on(self):
        with viewer("--log", circle_log()) as running:
            page = self.see(running.url)
            stop_at(page, 15)
            many = page.run("lioView.stage.path.num")
            stop_at(page, 5)
            few = page.run("lioView.stage.path.num")
            self.assertEqual((many, few), (151, 51))
            self.assertIn("0:05.0 / 0:20.0", page.run("document.getElementById('clock').textContent"))
            page.run("document.getElementById('play').click()")
            page.wait_for("lioView.stage.path.num > 60")
            self.assertEqual(page.run("document.getElementById('note').innerHTML.includes('<b>')"), False,
                             "a note is text, never HTML")
            self.assertEqual(page.faults, [])

    def test_plots_have_ink_and_lights_their_colours(self):
        with viewer("--log", circle_log()) as running:
            page = self.see(running.url)
            stop_at(page, 10)
            page.run("new Promise(done => setTimeout(done, 600))")
            inked = page.run("""[...document.querySelectorAll('#plots canvas')].filter(canvas => {
                const {data} = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
                let coloured = 0;
                for (let i = 0; i < data.length; i += 4)
                  if (data[i + 3] > 100 && Math.max(...data.slice(i, i + 3)) - Math.min(...data.slice(i, i + 3)) > 60) ++coloured;
                return coloured > 20;
            }).length""")
            self.assertEqual(inked, 4)
            lights = page.run("[...document.querySelectorAll('#lights li')].map(li => li.dataset.colour)")
            self.assertEqual(lights, ["green"] * 4)
            self.assertEqual(page.faults, [])

    def test_a_lost_server_is_found_again(self):
        first = Viewer("--log", circle_log())
        page = self.see(first.url)
        page.wait_for("lioView.seen.poses > 5")
        code, words = first.end()
        self.assertEqual(code, 0, words)
        page.wait_for("document.getElementById('hint').textContent.includes('Trying again')")
        poses = page.run("lioView.seen.poses")
        second = Viewer("--log", circle_log(), port=first.port)
        try:
            page.wait_for(f"lioView.link.numOpened === 2 && lioView.seen.poses > {poses + 5}")
            self.assertEqual(page.run("document.getElementById('hint').hidden"), True)
            # The browser itself reports the refused connections, which is right.
            self.assertEqual([fault for fault in page.faults
                              if "ERR_CONNECTION_REFUSED" not in fault[1]], [])
        finally:
            second.end()

    def test_without_the_token_nothing_is_shown(self):
        token = "0123456789abcdefghij"
        with viewer("--log", circle_log(), "--bind", "0.0.0.0", "--token", token) as running:
            base = f"http://127.0.0.1:{running.port}/"
            page = self.chromium.open(base)
            page.wait_for("document.getElementById('hint').textContent.includes('token')")
            self.assertEqual(page.run("lioView.seen.frames"), 0)
            page = self.see(f"{base}?token={token}")
            page.wait_for("lioView.seen.poses > 5")
            self.assertEqual(page.faults, [])

    def test_a_phone_shows_it(self):
        with viewer("--log", circle_log()) as running:
            page = self.see(running.url, width=390, height=844, mobile=True)
            stop_at(page, 10)
            self.assertLessEqual(page.run("document.documentElement.scrollWidth"), 390)
            for element in ("panel", "tools", "timeline"):
                left, right = page.run(f"(r => [r.left, r.right])(document.getElementById('{element}').getBoundingClientRect())")
                self.assertGreaterEqual(left, 0, element)
                self.assertLessEqual(right, 390, element)
            self.assertEqual(page.run("document.getElementById('plots').hidden"), True)
            page.run("document.querySelector('[data-tool=plots]').click()")
            self.assertEqual(page.run("document.getElementById('plots').hidden"), False)
            self.assertGreaterEqual(page.run("document.querySelector('#tools button').clientHeight"), 32)
            self.assertEqual(page.faults, [])


ALONE = "ip link set lo up multicast on; ip route add 224.0.0.0/4 dev lo; "


@unittest.skipUnless(browser.BROWSER, "chromium is not installed")
class Live(unittest.TestCase):
    """liod, a player and lio-view on real multicast, in a network of their own."""

    def test_a_drive_is_seen_while_it_happens(self):
        if os.environ.get("LIO_ALONE") != "yes":
            if subprocess.run(["unshare", "-rn", "sh", "-c", ALONE], capture_output=True).returncode != 0:
                self.skipTest("this machine lets nobody make network namespaces")
            done = subprocess.run(
                ["unshare", "-rn", "sh", "-c", ALONE + 'exec "$@"', "sh", "/usr/bin/python3", "-B",
                 __file__, "Live"], env={**os.environ, "LIO_ALONE": "yes"}, capture_output=True, text=True,
                timeout=support.TIMEOUT_S, check=False)
            self.assertEqual(done.returncode, 0, done.stderr)
            return
        drive = support.simulated("street", "--duration", "12", "--lidar", "vlp16")
        with contextlib.ExitStack() as stack:
            liod = subprocess.Popen([support.BUILD / "bin/liod", "--config", drive / "config.yaml"],
                                    stdin=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
            stack.callback(liod.wait)
            stack.callback(liod.terminate)
            while "listening" not in liod.stderr.readline():
                self.assertIsNone(liod.poll())
            running = stack.enter_context(viewer())
            chromium = stack.enter_context(browser.open_browser())
            page = chromium.open(running.url)
            page.wait_for("window.lioView && lioView.seen.hello && lioView.seen.hello.is_live")
            player = subprocess.Popen(["lcm-logplayer", drive / "log.lcm"], stdout=subprocess.DEVNULL)
            stack.callback(player.wait)
            page.wait_for("lioView.seen.poses > 0 && lioView.stage.map.num > 5000"
                          " && lioView.stage.path.num > 50 && lioView.plots.times.length > 50")
            page.wait_for("lioView.seen.status.daemon.state === 1")
            self.assertEqual(page.faults, [])


if __name__ == "__main__":
    if sys.argv[1:] == ["Live"]:
        unittest.main()
    support.main()
