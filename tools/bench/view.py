#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Measures lio-view in Debian's Chromium without a screen, drawing in software at 1280 x 720: frames a
second with a million points of map and odometry at 100 Hz, and the time from a pose's arrival at
lio-view to the page.

  tools/bench/view.py            needs a build with tests, Chromium, and network namespaces
"""
import argparse
import os
import pathlib
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "test/integration"))
os.environ.setdefault("LIO_BUILD", str(ROOT / "build"))

import browser  # noqa: E402
import view_test  # noqa: E402

SECONDS, POINTS_A_SCAN = 60, 3000  # a million points after 34 s
WINDOW_S = 15


def quantile(values, share):
    return sorted(values)[min(len(values) - 1, int(share * len(values)))]


def measure(page, name, layers=None):
    """Prints a row of the frames drawn in a while; `layers` fixes how many of the map's sixteen are."""
    if layers:
        page.run(f"lioView.stage.isFixed = true, lioView.stage.map.setLayers({layers})")
        time.sleep(2)
    before, begin = page.run("lioView.stage.numDrawn"), time.monotonic()
    skipped = page.run("lioView.seen.pose.leftOut")
    lags, drawn_layers = [], []
    while time.monotonic() - begin < WINDOW_S:
        lags.append(page.run("lioView.seen.lagMs"))
        drawn_layers.append(page.run("lioView.stage.map.numLayers"))
        time.sleep(0.1)
    elapsed = time.monotonic() - begin
    frames = page.run("lioView.stage.numDrawn") - before
    points = page.run("lioView.stage.map.num")
    hertz = page.run("lioView.seen.status.rates_hz.odometry_imu")
    skipped = page.run("lioView.seen.pose.leftOut") - skipped
    print(f"| {name} | {points} | {sum(drawn_layers) / len(drawn_layers):.1f} | {hertz:.0f} | "
          f"{frames / elapsed:.1f} | {quantile(lags, 0.5):.0f} | {quantile(lags, 0.99):.0f} | "
          f"{skipped / elapsed:.0f} |", flush=True)


def measure_all():
    log = view_test.circle_log(SECONDS, POINTS_A_SCAN)
    with view_test.live_page() as page:
        player = subprocess.Popen(["lcm-logplayer", log], stdout=subprocess.DEVNULL)
        print("| view | points | sixteenths drawn | odometry Hz | frames a second | shown after ms, median"
              " | p99 | poses skipped a second |\n|---|---|---|---|---|---|---|---|")
        page.wait_for("lioView.stage.map.num > 1000000", patience_s=SECONDS)
        page.run("lioView.setTool('plots', false)")
        measure(page, "as many points as it can")
        player.terminate()
        player.wait()
        player = subprocess.Popen(["lcm-logplayer", log], stdout=subprocess.DEVNULL)
        # The stamps begin anew, and so does the map.
        page.wait_for("lioView.stage.map.num > 1000000 && lioView.seen.status.runs > 0",
                      patience_s=2 * SECONDS)
        measure(page, "all points", layers=16)
        player.terminate()
        player.wait()
        if page.faults:
            sys.exit(f"the console said {page.faults}")
    print(f"load of the machine: {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores")


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.parse_args()
    if not browser.BROWSER:
        sys.exit("chromium is not installed")
    if os.environ.get("LIO_ALONE") == "yes":
        measure_all()
        return 0
    words = ["unshare", "-rn", "sh", "-c", view_test.ALONE + 'exec "$@"', "sh", sys.executable, "-B", __file__]
    return subprocess.run(words, env={**os.environ, "LIO_ALONE": "yes"}, check=False).returncode


if __name__ == "__main__":
    sys.exit(main())
