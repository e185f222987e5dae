#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Tests each program with wrong inputs: it must end with the documented exit code and one line that
says what to do."""
import os
import resource
import shutil
import struct
import subprocess
import unittest

import support

USAGE, CONFIGURATION, TRANSPORT, INPUT, WRITE_FAILED = 2, 3, 4, 5, 74
PROGRAMS = ("liod", "lio-run", "lio-replay", "lio-convert", "lio-eval", "lio-log", "lio-sim",
            "lio-view")


class ExitCodes(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.drive = support.simulated("street", "--duration", "3", "--lidar", "vlp16")
        cls.config = ("--config", cls.drive / "config.yaml")
        cls.folder = support.WORK / "exit-codes"
        cls.folder.mkdir(exist_ok=True)

    def check(self, exit_code, words_expected, program, *words, max_lines=1):
        done = support.run(program, *words)
        self.assertEqual(done.returncode, exit_code, done.stderr)
        lines = done.stderr.strip().splitlines()
        self.assertTrue(1 <= len(lines) <= max_lines, done.stderr)
        for word in words_expected:
            self.assertIn(word, done.stderr)
        return done

    def test_every_program_teaches_and_names_its_version(self):
        for program in PROGRAMS:
            with self.subTest(program):
                help_text = support.run_well(program, "--help")
                self.assertIn("Examples:", help_text)
                self.assertRegex(support.run_well(program, "--version"), r"\d+\.\d+\.\d+")

    def test_unknown_option_is_a_usage_error(self):
        complete = {"liod": (), "lio-sim": (), "lio-replay": ("log.lcm", "--out", "out"),
                    "lio-convert": ("rosbag", "in.bag", "out.lcm"),
                    "lio-eval": ("truth.tum", "estimate.tum")}
        for program, words in complete.items():
            with self.subTest(program):
                self.check(USAGE, ["--no-such-option"], program, *words, "--no-such-option")

    def test_missing_positional_is_a_usage_error(self):
        for program in ("lio-replay", "lio-convert", "lio-eval"):
            with self.subTest(program):
                self.check(USAGE, [], program)

    def test_unusable_configuration_file_is_named_and_nothing_else(self):
        texts = {"list.yaml": "- 1\n- 2\n", "scalar.yaml": "hello\n", "broken.yaml": "a: [1\n"}
        for name, text in texts.items():
            (self.folder / name).write_text(text)
        files = ["/no/such.yaml", self.folder, *(self.folder / name for name in texts)]
        for program, rest in (("lio-replay", ("log.lcm", "--out", self.folder)), ("liod", ())):
            for file in files:
                with self.subTest(program=program, file=file):
                    self.check(CONFIGURATION, [str(file)], program, "--config", file, *rest)

    def test_numbers_beyond_reason_are_refused(self):
        log, truth = self.drive / "log.lcm", self.drive / "truth.tum"
        run = (*self.config, log, "--out", self.folder / "never")
        bag = ("rosbag", "in.bag", "out.lcm")
        sim = ("--scenario", "street", "--out", self.folder / "never")
        cases = [("lio-replay", run, "--start"), ("lio-replay", run, "--duration"),
                 ("lio-replay", run, "--threads"), ("lio-convert", bag, "--start"),
                 ("lio-convert", bag, "--duration"), ("lio-eval", (truth, truth), "--max-gap"),
                 ("lio-convert", ("kitti-raw", "in", "out.lcm"), "--imu-rate"),
                 ("lio-convert", ("kitti-odometry", "in", "out.lcm"), "--vertical-correction"),
                 ("lio-sim", sim, "--duration"), ("lio-sim", sim, "--seed"),
                 ("lio-sim", sim, "--imu-rate"), ("lio-sim", sim, "--threads")]
        for program, words, option in cases:
            for value in ("nan", "inf", "-1e300", "1e999", "x", ""):
                with self.subTest(program=program, option=option, value=value):
                    done = self.check(USAGE, [], program, *words, f"{option}={value}")
                    self.assertLess(len(done.stderr), 300)
        for key in ("rig.gravity_mps2", "ndt.voxel_m", "pipeline.max_queued_scans"):
            for value in ("1e999", ".nan", "-1e300", "99999999999999999999", "[1]", "{a: 1}", ""):
                with self.subTest(key=key, value=value):
                    self.check(CONFIGURATION, [key], "lio-replay", *run, "--set", f"{key}={value}")

    def test_outputs_that_cannot_be_written_are_usage_errors(self):
        file = self.folder / "file"
        file.write_text("")
        truth = self.drive / "truth.tum"
        for program, words in (
                ("lio-replay", (*self.config, self.drive / "log.lcm", "--out", file)),
                ("lio-sim", ("--scenario", "street", "--duration", "1", "--out", file)),
                ("lio-eval", (truth, truth, "--json", self.folder))):
            with self.subTest(program=program):
                self.check(USAGE, [], program, *words)

    def test_a_stdout_that_takes_nothing_ends_every_program_with_74(self):
        truth = self.drive / "truth.tum"
        runs = [*((program, ("--help",)) for program in PROGRAMS), ("lio-sim", ("--list",)),
                ("lio-log", ("info", self.drive / "log.lcm")), ("lio-eval", (truth, truth)),
                ("liod", (*self.config, "--print-options")),
                ("lio-replay", (*self.config, self.drive / "log.lcm", "--out",
                                self.folder / "unheard", "--overwrite"))]
        for program, words in runs:
            with self.subTest(program=program, words=words), open("/dev/full", "w") as full:
                done = subprocess.run([support.BUILD / "bin" / program, *words], stdout=full,
                                      stderr=subprocess.PIPE, text=True, timeout=100, check=False)
                self.assertEqual(done.returncode, WRITE_FAILED, done.stderr)
                self.assertIn("cannot write to the standard output", done.stderr)

    def run_with_small_files(self, max_bytes, program, *words):
        return subprocess.run(
            [support.BUILD / "bin" / program, *words], capture_output=True, text=True, timeout=100,
            preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (max_bytes, max_bytes)),
            check=False)

    def test_files_that_cannot_grow_end_every_program_with_74(self):
        truth, out = self.drive / "truth.tum", self.folder / "small"
        self.check(WRITE_FAILED, ["/dev/full"], "lio-eval", truth, truth, "--json", "/dev/full")
        log, sequence = self.drive / "log.lcm", self.kitti_sequence()
        shutil.rmtree(out, ignore_errors=True)
        out.mkdir()
        for max_bytes, program, words in (
                (9000, "lio-sim", ("--scenario", "hall", "--duration", "1", "--out", out)),
                (9000, "lio-replay", (*self.config, log, "--out", out, "--overwrite")),
                (9000, "lio-run", (self.drive, "--out", out / "run")),
                (9000, "lio-log", ("export", log, "--inputs", "--mcap", out / "log.mcap")),
                (9000, "lio-convert", ("kitti-odometry", sequence, out / "converted.lcm")),
                (400, "lio-eval", (truth, truth, "--json", out / "eval.json"))):
            with self.subTest(program=program):
                done = self.run_with_small_files(max_bytes, program, *words)
                self.assertEqual(done.returncode, WRITE_FAILED, done.stderr)
                self.assertEqual(done.stderr.count("in full: "), 1, done.stderr)
                self.assertIn(str(out), done.stderr)
        # The world of a street goes to a temporary file.
        done = self.run_with_small_files(9000, "lio-sim", "--scenario", "street", "--duration", "1",
                                         "--out", out)
        self.assertEqual(done.returncode, WRITE_FAILED, done.stderr)
        self.assertEqual(done.stderr.count("in full: "), 1, done.stderr)
        self.assertIn("TMPDIR", done.stderr)

    def kitti_sequence(self):
        """A folder of two scans with a few thousand points each."""
        sequence = self.folder / "sequence"
        (sequence / "velodyne").mkdir(parents=True, exist_ok=True)
        (sequence / "times.txt").write_text("0.0\n0.1\n")
        (sequence / "calib.txt").write_text("Tr: 1 0 0 0 0 1 0 0 0 0 1 0\n")
        points = [(10 + i % 7, i % 90 - 45, i % 3, 0.5) for i in range(4000)]
        for number in range(2):
            (sequence / f"velodyne/{number:06}.bin").write_bytes(
                b"".join(struct.pack("<4f", *point) for point in points))
        return sequence

    def test_a_map_that_cannot_be_written_leaves_all_else(self):
        log, out = self.drive / "log.lcm", self.folder / "no-map"
        # liod may drop scans on a busy machine.
        for program, words, min_scans in (("lio-replay", (log,), 20),
                                          ("liod", ("--lcm-url", f"file://{log}?speed=1"), 5)):
            with self.subTest(program=program):
                done = self.run_with_small_files(60_000, program, *self.config, *words, "--out",
                                                 out, "--overwrite", "--map")
                self.assertEqual(done.returncode, WRITE_FAILED, done.stderr)
                self.assertIn("map.pcd in full: File too large", done.stderr)
                self.assertGreater(support.stats(out)["num_scans"], min_scans)
                self.assertIn("trust", (out / "verdict.json").read_text())
                self.assertNotEqual((out / "trajectory.tum").read_text(), "")

    def test_liod_refuses_channels_that_lcm_cannot_name(self):
        self.check(USAGE, ["--channel-prefix"], "liod", *self.config, "--channel-prefix", "X" * 41)

    def test_unknown_key_names_the_nearest_right_one(self):
        self.check(CONFIGURATION, ["voxel_size_m", "voxel_m"], "lio-replay", *self.config, "--set",
                   "ndt.voxel_size_m=1", self.drive / "log.lcm", "--out", self.folder)

    def test_all_faults_of_a_configuration_are_listed_with_their_lines(self):
        bad = self.folder / "bad.yaml"
        bad.write_text("rig:\n  gravity_mps2: many\nno_such: 1\n")
        done = support.run("lio-replay", *self.config, "--config", bad, self.drive / "log.lcm",
                           "--out", self.folder)
        self.assertEqual(done.returncode, CONFIGURATION, done.stderr)
        self.assertIn("bad.yaml:2", done.stderr)
        self.assertIn("bad.yaml:3", done.stderr)

    def test_replay_without_log_or_scans_is_unusable_input(self):
        self.check(INPUT, ["/no/such.lcm"], "lio-replay", *self.config, "/no/such.lcm", "--out",
                   self.folder)
        empty = self.folder / "empty.lcm"
        empty.write_bytes(b"")
        other = self.folder / "other.lcm"
        other.write_bytes(bytes(range(256)) * 100)
        for log in (empty, other, self.folder, self.drive / "truth.tum", "/dev/null"):
            with self.subTest(log=log):
                self.check(INPUT, [str(log)], "lio-replay", *self.config, log, "--out", self.folder,
                           "--overwrite")
        self.check(INPUT, ["--start"], "lio-replay", *self.config, self.drive / "log.lcm",
                   "--out", self.folder, "--overwrite", "--start", "1000")

    def test_replay_goes_past_damage_says_how_much_and_ends_with_5(self):
        whole = (self.drive / "log.lcm").read_bytes()
        middle = whole.index(b"\xed\xa1\xda\x01", len(whole) // 2)  # the begin of a message
        damaged = self.folder / "damaged.lcm"
        damaged.write_bytes(whole[:middle] + b"\x55" * 20000 + whole[middle + 20000:])
        out = self.folder / "damaged-run"
        done = support.run("lio-replay", *self.config, damaged, "--out", out, "--overwrite")
        self.assertEqual(done.returncode, INPUT, done.stderr)
        self.assertIn("bytes", done.stderr)
        stats = support.stats(out)
        self.assertGreater(stats["num_skipped_bytes"], 0)
        self.assertGreater(stats["num_scans"], 20)

    def test_convert_refuses_what_is_no_bag(self):
        other = self.folder / "other.bag"
        other.write_bytes(b"not a bag at all, but long enough to be looked at" * 10)
        out = self.folder / "none.lcm"
        self.check(INPUT, ["other.bag"], "lio-convert", "rosbag", other, out)
        empty = self.folder / "empty"
        empty.mkdir(exist_ok=True)
        for kind in ("rosbag", "kitti-raw", "kitti-odometry"):
            for given in ("/no/such", empty, other, "/dev/null", self.drive / "log.lcm"):
                with self.subTest(kind=kind, given=given):
                    self.check(INPUT, [str(given)], "lio-convert", kind, given, out)

    def test_a_fifo_is_refused_and_not_waited_for(self):
        folder = self.folder / "fifos"
        shutil.rmtree(folder, ignore_errors=True)
        (folder / "velodyne").mkdir(parents=True)
        for name in ("fifo.bag", "fifo.db3", "fifo.lcm", "fifo.pcd", "times.txt"):
            os.mkfifo(folder / name)
        out = self.folder / "none.lcm"
        for words in (("lio-convert", "rosbag", folder / "fifo.bag", out),
                      ("lio-convert", "rosbag", folder / "fifo.db3", out),
                      ("lio-convert", "rosbag", folder, out),
                      ("lio-convert", "kitti-odometry", folder, out),
                      ("lio-log", "info", folder / "fifo.lcm"),
                      ("lio-replay", *self.config, folder / "fifo.lcm", "--out", folder / "run"),
                      ("lio-replay", *self.config, "--initial-map", folder / "fifo.pcd",
                       self.drive / "log.lcm", "--out", folder / "run")):
            with self.subTest(words=words):
                self.check(INPUT, ["regular file"], *words)

    def test_a_link_among_the_files_of_a_run_is_not_written_through(self):
        out, precious = self.folder / "linked", self.folder / "precious"
        shutil.rmtree(out, ignore_errors=True)
        out.mkdir()
        precious.write_text("precious")
        names = ("trajectory.tum", "trajectory_level.rows", "trajectory_level.tum", "states.csv",
                 "map.pcd", "stats.json", "verdict.json", "options.yaml", "notices.tsv")
        for name in names:
            (out / name).symlink_to(precious)
        link = self.folder / "link"
        link.unlink(missing_ok=True)
        link.symlink_to(out)  # a folder may be one
        done = support.run("lio-replay", *self.config, self.drive / "log.lcm", "--out", link,
                           "--overwrite", "--map")
        self.assertIn(done.returncode, (0, 6), done.stderr)
        self.assertEqual(precious.read_text(), "precious")
        for name in names:
            self.assertFalse((out / name).is_symlink(), name)
        self.assertGreater(support.stats(out)["num_scans"], 20)

    def test_convert_never_writes_over_its_input(self):
        precious = self.folder / "precious.bag"
        precious.write_bytes(b"#ROSBAG V2.0\n" + bytes(5000))
        self.check(USAGE, ["precious.bag"], "lio-convert", "rosbag", precious, precious)
        self.assertEqual(precious.stat().st_size, 5013)

    def test_eval_refuses_missing_and_malformed_trajectories(self):
        truth = self.drive / "truth.tum"
        texts = {"bad": "1 2 three\n", "short": "1 0 0 0\n", "none": "# nothing\n", "empty": "",
                 "nan": "1 nan 0 0 0 0 0 1\n2 0 0 0 0 0 0 1\n", "one": "1 0 0 0 0 0 0 1\n",
                 "huge": "1 1e300 0 0 0 0 0 1\n2 0 0 0 0 0 0 1\n",
                 "late": "1e300 0 0 0 0 0 0 1\n2e300 0 0 0 0 0 0 1\n",
                 "back": "2 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1\n",
                 "turn": "1 0 0 0 0 0 0 0\n2 0 0 0 0 0 0 0\n"}
        for name, text in texts.items():
            (self.folder / f"{name}.tum").write_text(text)
        files = [*(self.folder / f"{name}.tum" for name in texts), "/no/such.tum", self.folder,
                 self.drive / "log.lcm"]
        for file in files:
            with self.subTest(file=file):
                self.check(INPUT, [], "lio-eval", truth, file)
                self.check(INPUT, [], "lio-eval", file, truth)

    def test_sim_lists_the_scenarios_when_the_name_is_wrong(self):
        self.check(USAGE, ["street"], "lio-sim", "--scenario", "moon", "--out", self.folder)

    def test_liod_without_a_transport_ends_with_4(self):
        self.check(TRANSPORT, [], "liod", *self.config, "--lcm-url", "nosuch://here", max_lines=2)

    def test_liod_without_a_multicast_route_names_the_command(self):
        command = ["unshare", "-rn", support.BUILD / "bin/liod", *self.config]
        if not support.may_unshare("-rn"):
            self.skipTest("no right to make a network namespace")
        done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True,
                              timeout=60, check=False)
        self.assertEqual(done.returncode, TRANSPORT, done.stderr)
        self.assertIn("ip route add 224.0.0.0/4 dev lo", done.stderr)


if __name__ == "__main__":
    support.main()
