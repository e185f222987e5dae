#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Tests lio-log doctor on a simulated walk with right and wrong set-ups, and on a real bag. The
set-ups are those of tools/bench/verdict.py."""
import json
import sys
import unittest

import support

sys.path.insert(0, str(support.SOURCE / "tools/bench"))
import verdict  # pylint: disable=wrong-import-position

EXIT_UNUSABLE, EXIT_NO_TRUST, EXIT_CONFIGURATION = 5, 6, 3


class Doctor(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.walk = support.simulated("campus", "--lidar", "vlp16", "--duration", "25")

    def examine(self, setup, *words):
        """The diagnosis, the exit code, and the corrected rig."""
        name = "doctor-" + setup.translate(str.maketrans(" :+", "___"))
        overlay, json_file, rig = (support.WORK / f"{name}{end}"
                                   for end in ("-overlay.yaml", ".json", "-rig.yaml"))
        overlay.write_text(verdict.SETUPS[setup][0](*verdict.read_extrinsic(self.walk)))
        done = support.run("lio-log", "doctor", self.walk / "log.lcm", "--config",
                           self.walk / "config.yaml", "--config", overlay, "--json", json_file,
                           "--write-rig", rig, *words)
        self.assertIn(done.returncode, (0, EXIT_NO_TRUST), done.stderr)
        return json.loads(json_file.read_text()), done, rig

    def replay_with(self, rig):
        out = support.WORK / "doctor-replay"
        done = support.run("lio-replay", "--config", rig, self.walk / "log.lcm", "--out", out,
                           "--overwrite")
        return json.loads((out / "verdict.json").read_text()), done.returncode

    def test_a_right_rig_gives_no_finding(self):
        found, done, rig = self.examine("right")
        self.assertEqual((found["trust"], found["causes"], done.returncode), ("yes", [], 0))
        self.assertEqual((found["treated"], found["with_fixes"]), ([], None))
        self.assertIn("nothing was found to be wrong", done.stdout)
        self.assertEqual(self.replay_with(rig)[0]["trust"], "yes")

    def test_wrong_ones_have_the_right_first_cause_and_a_rig_that_mends_them(self):
        for setup in ("clock -25 ms", "inverted", "units: g", "x 1 m", "yaw 5 deg"):
            with self.subTest(setup):
                found, done, rig = self.examine(setup)
                expected = verdict.SETUPS[setup][1]
                self.assertNotEqual(found["trust"], "yes")
                self.assertEqual(found["causes"][0]["kind"], expected)
                self.assertIn(f"\n1. {expected} (", done.stdout)
                self.assertIn("   fix:\n     rig:\n", done.stdout)
                self.assertEqual(done.returncode,
                                 EXIT_NO_TRUST if found["trust"] == "no" else 0)
                self.assertIn(expected, found["treated"])
                self.assertEqual(found["with_fixes"]["trust"], "yes")
                self.assertIn(f"# Changed for {expected}: ", rig.read_text())
                mended, code = self.replay_with(rig)
                self.assertEqual((mended["trust"], code), ("yes", 0))

    def test_the_verdict_is_that_of_replay(self):
        found, _, _ = self.examine("units: g")
        overlay = support.WORK / "doctor-units__g-overlay.yaml"
        out = support.WORK / "doctor-replay"
        done = support.run("lio-replay", "--config", self.walk / "config.yaml", "--config", overlay,
                           self.walk / "log.lcm", "--out", out, "--overwrite")
        self.assertEqual(done.returncode, EXIT_CONFIGURATION)
        replayed = json.loads((out / "verdict.json").read_text())
        self.assertEqual({key: found[key] for key in replayed}, replayed)
        self.assertTrue(found["refusal"])

    def test_with_one_pass_the_fix_is_not_checked_and_the_rig_says_so(self):
        found, done, rig = self.examine("clock -25 ms", "--passes", "1")
        self.assertEqual((found["treated"], found["with_fixes"]), (["clock_offset"], None))
        self.assertIn("no replay has looked", done.stdout)
        self.assertIn("no replay has looked", rig.read_text())
        self.assertEqual(self.replay_with(rig)[0]["trust"], "yes")

    def test_a_fix_overrides_what_set_says(self):
        found, _, _ = self.examine("right", "--set", "rig.lidar.clock_offset_s=0.025")
        self.assertEqual(found["with_fixes"]["trust"], "yes")

    def test_a_bag_is_converted_and_its_rig_drafted(self):
        bag = support.unpacked_bag("ulhk_sample")
        rig = support.WORK / "doctor-bag-rig.yaml"
        done = support.run("lio-log", "doctor", bag, "--write-rig", rig)
        self.assertIn(done.returncode, (0, EXIT_NO_TRUST), done.stderr)
        self.assertIn("(ROS bag)", done.stdout)
        self.assertIn("is ASSUMED", done.stdout)
        self.assertIn("is ASSUMED", rig.read_text())
        checked = support.run("lio-log", "doctor", bag, "--config", rig, "--print-options")
        self.assertEqual(checked.returncode, 0, checked.stderr)
        self.assertIn("model: hdl32e", rig.read_text())

    def test_wrong_arguments_are_one_line(self):
        config = self.walk / "config.yaml"
        log = self.walk / "log.lcm"
        for words, code, says in ((("/no/such.lcm",), EXIT_UNUSABLE, "/no/such.lcm"),
                                  ((config,), EXIT_UNUSABLE, "is no ROS bag"),
                                  ((), 2, "INPUT"),
                                  ((log, "--passes", "0"), 2, "--passes"),
                                  ((log, "--config", config, "--json", log), 2, "is input"),
                                  ((log, "--set", "rig.lidar.modell=x"), 3, "model?")):
            with self.subTest(words):
                done = support.run("lio-log", "doctor", *words)
                self.assertEqual(done.returncode, code, done.stderr)
                self.assertIn(says, done.stderr)
                self.assertEqual(done.stderr.count("\n"), 1, done.stderr)


if __name__ == "__main__":
    support.main()
