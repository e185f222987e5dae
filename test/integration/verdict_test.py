#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Tests the verdict of lio-replay on two short drives with right and wrong configurations: the
short form of tools/bench/verdict.py, whose set-ups it uses."""
import json
import os
import shutil
import sys
import unittest

import support

sys.path.insert(0, str(support.SOURCE / "tools/bench"))
import verdict  # pylint: disable=wrong-import-position

DRIVES = {"walk": ("campus", "--lidar", "vlp16", "--duration", "25"),
          "street": ("street", "--lidar", "vlp16", "--duration", "30")}
WRONG = ("yaw 5 deg", "x 1 m", "inverted", "clock -25 ms", "units: g", "gravity: removed")
CORRECTED = ("yaw 5 deg", "x 1 m", "inverted", "clock -25 ms")  # on the way, by the estimator
KEEP = "filter:\n  estimate_extrinsic: false\n"
EXIT_NO_TRUST, EXIT_CONFIGURATION = 6, 3


class VerdictOfReplay(unittest.TestCase):
    @staticmethod
    def folder(drive):
        folder = support.WORK / f"verdict-{drive}"
        shutil.rmtree(folder, ignore_errors=True)
        shutil.copytree(support.simulated(*DRIVES[drive]), folder, copy_function=os.link)
        return folder

    def judge(self, folder, setup):
        overlay = verdict.SETUPS[setup][0](*verdict.read_extrinsic(folder))
        return verdict.judged(folder, [overlay])

    def test_right_rigs_are_trusted_and_blamed_for_nothing(self):
        for drive in DRIVES:
            with self.subTest(drive):
                found, code = self.judge(self.folder(drive), "right")
                self.assertEqual((found["trust"], code, found["causes"]), ("yes", 0, []))
                self.assertGreater(found["coverage"], 0.95)
                self.assertGreater(found["claimed"]["tilt_std_deg"], 0.0)

    def test_wrong_ones_are_named_with_their_exit_code(self):
        for drive in DRIVES:
            folder = self.folder(drive)
            for setup in WRONG:
                with self.subTest(drive=drive, setup=setup):
                    found, code = self.judge(folder, setup)
                    first = found["causes"][0]
                    if setup in CORRECTED:
                        self.assertEqual((found["trust"], code), ("doubtful", 0))
                    else:
                        self.assertEqual(found["trust"], "no")
                        self.assertIn(code, (EXIT_NO_TRUST, EXIT_CONFIGURATION))
                    self.assertEqual(first["kind"], verdict.SETUPS[setup][1], found)
                    self.assertTrue(first["fix"].startswith("rig:"), first)

    def test_an_extrinsic_that_is_kept_leaves_no_trust(self):
        folder = self.folder("walk")
        overlay = verdict.SETUPS["x 1 m"][0](*verdict.read_extrinsic(folder))
        found, code = verdict.judged(folder, [overlay, KEEP])
        self.assertEqual((found["trust"], code), ("no", EXIT_NO_TRUST))
        self.assertEqual(found["causes"][0]["kind"], "lever_arm")

    def test_the_fix_mends_the_run(self):
        folder = self.folder("walk")
        overlay = verdict.SETUPS["x 1 m"][0](*verdict.read_extrinsic(folder))
        found, _ = verdict.judged(folder, [overlay])
        mended, code = verdict.judged(folder, [overlay, found["causes"][0]["fix"]])
        self.assertEqual((mended["trust"], code), ("yes", 0), json.dumps(mended))


if __name__ == "__main__":
    support.main()
