#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Runs a tiny fleet of simulated drives, a recording and a foreign trajectory through
tools/fleet.sh: killed in its midst and resumed, it must give the table of an undisturbed one."""
import csv
import json
import os
import pathlib
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

import support

FLEET = support.SOURCE / "tools/fleet.sh"
MEASURED = ("_wall_s", "_cpu_s", "_ms", "_mb")
FLEET_FILE = """\
drives:
  - {name: street, sim: --scenario street --duration 5 --lidar vlp16, seeds: 1..2}
configurations:
  - {name: ndt}
  - {name: loam, set: pipeline.method=loam}
peers:
  - {name: foreign, files: "foreign/{drive}.tum"}
baseline: ndt
"""
FAULTY_FILE = """\
drives:
  - {name: a, sim: --scenario strete, seeds: 1..x}
  - {name: a, input: nowhere.bag, sim: --scenario street}
  - {name: c/d, inptu: nowhere.bag}
  - {name: e, sim: --scenario street, scans: f}
configurations:
  - {name: ndt, threads: 0, set: voxel, program: liod, drives: nowhere}
baseline: nothing
extra: 1
"""


def missing_part():
    if not shutil.which("snakemake"):
        return "snakemake is not installed"
    done = subprocess.run(["/usr/bin/python3", "-c", "import scipy"], capture_output=True,
                          check=False)
    return "python3-scipy is not installed" if done.returncode else ""


def words(file, out, *more):
    return [str(word) for word in (FLEET, file, "--out", out, "--jobs", 2, *more)]


def environment():
    return dict(os.environ, LIO_BUILD=str(support.BUILD))


def fleet(file, out, *more):
    done = subprocess.run(words(file, out, *more), stdin=subprocess.DEVNULL, capture_output=True,
                          text=True, timeout=support.TIMEOUT_S, check=False, env=environment())
    return done


def table(out):
    """The rows by system and drive, without what every run measures anew."""
    with open(out / "table.tsv", newline="", encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream, delimiter="\t", quoting=csv.QUOTE_NONE))
    return {(row["system"], row["drive"]): {key: value for key, value in row.items()
                                            if not key.endswith(MEASURED)} for row in rows}


def processes_in(folder):
    """The processes that work in a folder."""
    found = []
    for process in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            if (process / "cwd").resolve() == folder:
                found.append((process / "cmdline").read_text().replace("\0", " "))
        except OSError:
            pass  # it has ended
    return found


def kill_when(file, out, condition):
    """Kills the entry alone, by kill -9, as soon as the condition holds."""
    with subprocess.Popen(words(file, out), stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                          stderr=subprocess.DEVNULL, env=environment()) as process:
        deadline = time.monotonic() + support.TIMEOUT_S
        while process.poll() is None and not condition():
            if time.monotonic() > deadline:
                break
            time.sleep(0.002)
        ended = process.poll() is not None
        process.send_signal(signal.SIGKILL)
    return not ended


def times_of_rows(out):
    return {file: file.stat().st_mtime_ns for file in out.glob("runs/*/*/row.json")}


@unittest.skipIf(missing_part(), missing_part())
class Fleet(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        holder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(holder.cleanup)
        cls.folder = pathlib.Path(holder.name).resolve()
        cls.file = cls.folder / "tiny.yaml"
        cls.file.write_text(FLEET_FILE)
        drive = support.simulated("street", "--duration", "5", "--lidar", "vlp16")
        (cls.folder / "foreign").mkdir()
        shutil.copy(drive / "truth.tum", cls.folder / "foreign/street-1.tum")
        cls.whole = cls.folder / "whole"
        done = fleet(cls.file, cls.whole)
        if done.returncode != 0:
            raise AssertionError(done.stderr)

    def test_1_the_table_has_every_run_with_its_figures(self):
        rows = table(self.whole)
        self.assertEqual(len(rows), 6)
        for system in ("ndt", "loam"):
            for drive in ("street-1", "street-2"):
                row = rows[system, drive]
                self.assertEqual(row["status"], "done", row)
                self.assertLess(float(row["ape_m"]), 0.05)
                self.assertGreater(float(row["nees_pose"]), 0)
                self.assertTrue((self.whole / f"runs/{system}/{drive}/report.html").exists())
        # The foreign trajectory is the truth itself.
        self.assertLess(float(rows["foreign", "street-1"]["ape_m"]), 1e-6)
        self.assertEqual(rows["foreign", "street-2"]["status"], "absent")
        self.assertEqual(list(self.whole.glob("drives/*/log.lcm")), [])

    def test_2_a_rerun_does_nothing(self):
        before = times_of_rows(self.whole)
        page = (self.whole / "index.html").stat().st_mtime_ns
        done = fleet(self.file, self.whole)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("nothing to do", done.stderr)
        self.assertEqual(times_of_rows(self.whole), before)
        self.assertEqual((self.whole / "index.html").stat().st_mtime_ns, page)

    def test_3_killed_twice_and_resumed_it_gives_the_same_table(self):
        out = self.folder / "killed"
        conditions = (lambda: list(out.glob("scratch/drives*/log.lcm")),
                      lambda: times_of_rows(out) and list(out.glob("scratch/runs*/run")))
        for condition in conditions:
            self.assertTrue(kill_when(self.file, out, condition), "it ended before it was killed")
            time.sleep(1)
            self.assertEqual(processes_in(out), [], "a job outlived its fleet")
        self.assertFalse((out / "table.tsv").exists())
        kept = times_of_rows(out)
        self.assertTrue(kept)
        done = fleet(self.file, out)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(table(out), table(self.whole))
        after = times_of_rows(out)
        self.assertEqual({file: after[file] for file in kept}, kept, "a finished run ran again")
        self.assertEqual(list(out.glob("scratch/*")), [])

    def test_4_a_new_configuration_leaves_the_other_runs_alone(self):
        out = self.folder / "grown"
        shutil.copytree(self.whole, out)
        file = self.folder / "grown.yaml"
        fine = "  - {name: fine, set: ndt.voxel_m=0.8}\n"
        file.write_text(FLEET_FILE.replace("peers:", fine + "peers:"))
        before = times_of_rows(out)
        done = fleet(file, out)
        self.assertEqual(done.returncode, 0, done.stderr)
        after = times_of_rows(out)
        self.assertEqual({name: after[name] for name in before}, before)
        self.assertEqual(len(after), len(before) + 2)
        self.assertEqual(len(table(out)), 8)

    def test_4_logs_can_be_asked_for_later(self):
        out, file = self.folder / "kept", self.folder / "kept.yaml"
        shutil.copytree(self.whole, out)
        file.write_text(FLEET_FILE.replace("baseline", "keep: logs\nbaseline"))
        before = times_of_rows(out)
        done = fleet(file, out)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(len(list(out.glob("drives/*/log.lcm"))), 2)
        self.assertEqual(times_of_rows(out), before)

    def test_4_a_configuration_can_run_lio_replay_over_some_drives(self):
        out, file = self.folder / "replayed", self.folder / "replayed.yaml"
        file.write_text("drives:\n"
                        "  - {name: kept, sim: --scenario street --duration 3 --lidar vlp16,\n"
                        "     keep: logs}\n"
                        "  - {name: gone, sim: --scenario street --duration 3 --lidar vlp16}\n"
                        "configurations:\n"
                        "  - {name: ndt, words: --passes 1}\n"
                        "  - {name: late, program: lio-replay, words: --match-lag 9, drives: k*}\n")
        done = fleet(file, out)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual({key: row["status"] for key, row in table(out).items()},
                         {("ndt", "kept-1"): "done", ("ndt", "gone-1"): "done",
                          ("late", "kept-1"): "not scored"})
        self.assertEqual([log.parent.name for log in out.glob("drives/*/log.lcm")], ["kept-1"])
        ours, late = (out / f"runs/{name}/kept-1" for name in ("ndt", "late"))
        self.assertEqual((ours / "trajectory.tum").read_bytes(),
                         (late / "trajectory.tum").read_bytes())
        self.assertFalse((late / "report.html").exists())
        self.assertEqual((ours / "truth.tum").read_bytes(),
                         (out / "drives/kept-1/truth.tum").read_bytes())

    def test_4_a_drive_can_take_the_scans_of_another(self):
        out, file = self.folder / "shared", self.folder / "shared.yaml"
        sim = "sim: --scenario street --duration 2 --lidar vlp16"
        file.write_text("drives:\n"
                        f"  - {{name: cast, {sim} --without stamp-jitter --without clock-drift}}\n"
                        f"  - {{name: field, {sim}, scans: cast}}\n"
                        f"  - {{name: shaken, {sim} --fault shaking:start=1, scans: cast}}\n"
                        "configurations:\n"
                        "  - {name: ndt, drives: field-1 shaken-1}\n"
                        "keep: logs\n")
        done = fleet(file, out)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual([row["status"] for row in table(out).values()], ["done", "done"])
        self.assertIn(" 0.0 M rays", (out / "drives/field-1/prepare.txt").read_text())
        self.assertEqual(sorted(log.parent.name for log in out.glob("drives/*/log.lcm")),
                         ["cast-1", "field-1", "shaken-1"])
        self.assertIn("nothing to do", fleet(file, out).stderr)

    def test_5_runs_that_fail_are_rows(self):
        file = self.folder / "failing.yaml"
        (self.folder / "broken.bag").write_bytes(b"#ROSBAG V2.0\n" + bytes(100))
        file.write_text("drives:\n"
                        "  - {name: broken, input: broken.bag}\n"
                        "  - {name: wrong, sim: --scenario street --lidar nothing}\n")
        out = self.folder / "failing"
        done = fleet(file, out)
        self.assertEqual(done.returncode, 0, done.stderr)
        for row in table(out).values():
            self.assertEqual(row["status"], "failed", row)
            self.assertTrue(row["said"], row)

    def test_6_a_recording_is_run_from_a_tsv_table(self):
        drive = support.simulated("street", "--duration", "5", "--lidar", "vlp16")
        file, out = self.folder / "drives.tsv", self.folder / "tsv"
        file.write_text(f"name\tinput\tseeds\nrecorded\t{drive}\t\n")
        done = fleet(file, out)
        self.assertEqual(done.returncode, 0, done.stderr)
        row = table(out)["default", "recorded"]
        same = table(self.whole)["ndt", "street-1"]
        self.assertEqual(row["ape_m"], same["ape_m"], "the simulated drive has this seed, too")

    def test_6_a_sensor_of_ones_own_is_part_of_its_drive(self):
        file, out, sensor = (self.folder / name for name in ("own.yaml", "own", "my16.yaml"))
        model = (support.SOURCE / "config/lidars/vlp16.yaml").read_text()
        file.write_text("drives:\n"
                        "  - {name: own, sim: --scenario street --duration 5 --lidar my16.yaml}\n")
        figures = []
        for noise_m in ("0.02", "0.05"):
            sensor.write_text(model.replace("model: vlp16", "model: my16")
                              .replace("range_std_m: 0.02", f"range_std_m: {noise_m}"))
            done = fleet(file, out)
            self.assertEqual(done.returncode, 0, done.stderr)
            row = table(out)["default", "own-1"]
            self.assertEqual(row["status"], "done", row["said"])
            figures.append(row["ape_m"])
        self.assertNotEqual(*figures)

    def test_7_all_faults_are_told_at_once_with_their_lines(self):
        file = self.folder / "faulty.yaml"
        file.write_text(FAULTY_FILE)
        done = fleet(file, self.folder / "never")
        self.assertEqual(done.returncode, 3, done.stderr)
        for line, text in ((2, "seeds"), (3, "a is taken by"), (3, "either input"), (4, "c/d"),
                           (4, "did you mean input?"), (5, "f-1 is no simulated drive"),
                           (7, "threads"), (7, "KEY=VALUE"), (7, "liod; known"),
                           (7, "nowhere matches no drive"), (8, "nothing is neither"),
                           (9, "extra: unknown key")):
            self.assertTrue(any(f"faulty.yaml:{line}:" in told and text in told
                                for told in done.stderr.splitlines()), (line, text, done.stderr))
        self.assertFalse((self.folder / "never").exists())

    def test_8_options_that_liod_does_not_know_are_faults(self):
        file = self.folder / "unknown.yaml"
        file.write_text(FLEET_FILE.replace("pipeline.method=loam", "pipeline.metod=loam"))
        done = fleet(file, self.folder / "never")
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn("unknown.yaml:5: configuration loam", done.stderr)
        self.assertIn("did you mean pipeline.method?", done.stderr)
        file.write_text(FLEET_FILE.replace("--scenario street", "--scenario strete"))
        done = fleet(file, self.folder / "never")
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn("unknown.yaml:2: drive street: lio-sim knows no scenario", done.stderr)

    def test_9_the_table_as_json_holds_the_summary(self):
        content = json.loads((self.whole / "table.json").read_text())
        systems = {entry["system"]: entry for entry in content["summary"]}
        self.assertEqual(list(systems), ["ndt", "loam", "foreign"])
        self.assertEqual(systems["loam"]["against_baseline"]["ape_m"]["num_pairs"], 2)
        self.assertEqual(systems["foreign"]["status"], {"done": 1, "absent": 1})


if __name__ == "__main__":
    support.main()
