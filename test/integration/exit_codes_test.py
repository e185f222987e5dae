#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Wrong inputs of each program: the promised exit code, and one line that says what to do."""
import subprocess
import unittest

import support

USAGE, CONFIGURATION, TRANSPORT, INPUT = 2, 3, 4, 5
PROGRAMS = ("liod", "lio-replay", "lio-convert", "lio-eval", "lio-sim")


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

    def test_missing_configuration_file_is_named(self):
        for program, rest in (("lio-replay", ("log.lcm", "--out", self.folder)), ("liod", ())):
            with self.subTest(program):
                done = support.run(program, "--config", "/no/such.yaml", *rest)
                self.assertEqual(done.returncode, CONFIGURATION, done.stderr)
                self.assertIn("/no/such.yaml", done.stderr)

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
        self.check(INPUT, ["empty.lcm"], "lio-replay", *self.config, empty, "--out", self.folder)

    def test_replay_goes_past_damage_says_how_much_and_ends_with_5(self):
        whole = (self.drive / "log.lcm").read_bytes()
        middle = whole.index(b"\xed\xa1\xda\x01", len(whole) // 2)  # where a message begins
        damaged = self.folder / "damaged.lcm"
        damaged.write_bytes(whole[:middle] + b"\x55" * 20000 + whole[middle + 20000:])
        out = self.folder / "damaged-run"
        done = support.run("lio-replay", *self.config, damaged, "--out", out)
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
        self.check(INPUT, ["/no/such.bag"], "lio-convert", "rosbag", "/no/such.bag", out)
        self.check(INPUT, ["/no/such"], "lio-convert", "kitti-raw", "/no/such", out)
        self.check(INPUT, ["/no/such"], "lio-convert", "kitti-odometry", "/no/such", out)

    def test_eval_refuses_missing_and_malformed_trajectories(self):
        truth = self.drive / "truth.tum"
        bad = self.folder / "bad.tum"
        bad.write_text("1 2 three\n")
        self.check(INPUT, ["/no/such.tum"], "lio-eval", truth, "/no/such.tum")
        self.check(INPUT, ["bad.tum"], "lio-eval", truth, bad)

    def test_sim_lists_the_scenarios_when_the_name_is_wrong(self):
        self.check(USAGE, ["street"], "lio-sim", "--scenario", "moon", "--out", self.folder)

    def test_liod_without_a_transport_ends_with_4(self):
        self.check(TRANSPORT, [], "liod", *self.config, "--lcm-url", "nosuch://here", max_lines=2)

    def test_liod_without_a_multicast_route_names_the_command(self):
        command = ["unshare", "-rn", support.BUILD / "bin/liod", *self.config]
        if subprocess.run(["unshare", "-rn", "true"], check=False,
                          capture_output=True).returncode != 0:
            self.skipTest("no right to make a network namespace")
        done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True,
                              timeout=60, check=False)
        self.assertEqual(done.returncode, TRANSPORT, done.stderr)
        self.assertIn("ip route add 224.0.0.0/4 dev lo", done.stderr)


if __name__ == "__main__":
    support.main()
