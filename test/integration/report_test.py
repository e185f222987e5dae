#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Opens report.html in a browser without a screen: its script must run without an error, every plot
must have been drawn, and cursors and zoom must be linked. It is skipped where Chromium is missing."""
import re
import shutil
import subprocess
import tempfile
import unittest

import support

BROWSER = shutil.which("chromium") or shutil.which("chromium-browser")


def browse(page):
    """Returns what the page says of itself (#check), and the console's messages."""
    with tempfile.TemporaryDirectory() as profile:
        done = subprocess.run(
            [BROWSER, "--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
             f"--user-data-dir={profile}", "--host-resolver-rules=MAP * ~NOTFOUND",
             "--enable-logging=stderr", "--window-size=1400,2700", "--virtual-time-budget=8000",
             "--dump-dom", f"file://{page}#check"],
            stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=support.TIMEOUT_S,
            check=True)
    document = re.search(r"<html[^>]*>", done.stdout).group()
    said = dict(re.findall(r'data-(\w+)="(\w+)"', document))
    return said, [line for line in done.stderr.splitlines() if "CONSOLE" in line]


@unittest.skipUnless(BROWSER, "chromium is not installed")
class Report(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.drive = support.simulated("street", "--duration", "12", "--lidar", "vlp16")

    def run_drive(self, name, *words, exit_code=0):
        out = support.WORK / name
        done = support.run("lio-run", self.drive, "--out", out, "--overwrite", *words)
        self.assertEqual(done.returncode, exit_code, done.stderr)
        return out

    def check(self, page, num_plots):
        said, console = browse(page)
        self.assertEqual(console, [])
        self.assertEqual(said.get("checked"), "yes", said)
        self.assertEqual(int(said["plots"]), num_plots, said)
        self.assertEqual(said["drawn"], said["plots"], said)
        return said

    def test_a_run_with_truth_draws_all_its_plots_and_links_them(self):
        # Path, four of errors, height, velocity, two of biases, clock offset, status, trust, NIS,
        # points, times.
        said = self.check(self.run_drive("report-truth") / "report.html", 15)
        self.assertEqual(int(said["pointed"]), 14, "cursors follow the pointer on the path")
        self.assertEqual(int(said["zoomed"]), 14, "a zoom of one plot is that of all")
        self.assertEqual(said["here"], "block")

    def test_lidar_only_has_no_plots_of_biases(self):
        out = self.run_drive("report-lidar", "--set", "pipeline.use_imu=false")
        self.check(out / "report.html", 12)

    def test_two_runs_on_one_page_are_drawn_and_linked(self):
        runs = [self.run_drive("report-both"),
                self.run_drive("report-alone", "--set", "pipeline.use_imu=false")]
        out = support.WORK / "report-compared"
        done = support.run("lio-run", *runs, "--out", out, "--overwrite")
        self.assertEqual(done.returncode, 0, done.stderr)
        # Path, six of errors, height, three each of velocity and two biases, clock offset, status,
        # trust, NIS, points, times.
        said = self.check(out / "report.html", 23)
        self.assertEqual(int(said["pointed"]), 22, "cursors follow the pointer on the paths")
        self.assertEqual(int(said["zoomed"]), 22, "a zoom of one plot is that of all")

    def test_lio_replay_and_liod_leave_the_same_page_when_they_end(self):
        log, config = self.drive / "log.lcm", self.drive / "config.yaml"
        out = support.WORK / "report-replay"
        done = support.run("lio-replay", "--config", config, log, "--out", out, "--overwrite",
                           "--report")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.check(out / "report.html", 11)
        live = support.WORK / "report-live"
        done = support.run("liod", "--config", config, "--out", live, "--overwrite", "--lcm-url",
                           f"file://{log}?speed=0")
        self.assertIn(done.returncode, (0, 6), done.stderr)
        said, console = browse(live / "report.html")
        self.assertEqual(console, [])
        self.assertEqual(said.get("drawn"), said["plots"], said)

    def test_a_run_without_a_pose_is_a_page_too(self):
        out = self.run_drive("report-none", "--duration", "1", exit_code=6)
        said, console = browse(out / "report.html")
        self.assertEqual(console, [])
        self.assertEqual(said.get("checked"), "yes", said)


class ThirdParty(unittest.TestCase):
    def test_vendored_files_have_the_sums_that_their_readme_names(self):
        folder = support.SOURCE / "third_party"
        sums = re.findall(r"^    ([0-9a-f]{64}  \S+)$", (folder / "README.md").read_text(),
                          re.MULTILINE)
        self.assertEqual(len(sums), len([file for file in folder.glob("*/*")]))
        subprocess.run(["sha256sum", "--check", "--quiet"], input="\n".join(sums), text=True,
                       cwd=folder, check=True)


if __name__ == "__main__":
    support.main()
