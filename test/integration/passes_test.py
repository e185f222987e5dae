#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Tests that a second pass over a log begins with what the first has found of the sensors: a lidar
that stamps its sweeps 60 ms too late, a mounting that is off by 5 deg or that nobody has told, and
beams that err."""
import json
import shutil
import subprocess
import unittest

import support

FAULTS = {"clock_offset": "clock_offset:offset=0.06", "extrinsic_rotation":
          "wrong_extrinsic:yaw_deg=5"}

# A disk of so many bytes, a replay into it, and a copy of what it left.
SMALL_DISK = """
mount -t tmpfs -o size="$SIZE" none "$DISK" || exit 77
"$REPLAY" --config "$DRIVE/config.yaml" "$DRIVE/log.lcm" --out "$DISK/run" --passes 2
code=$?
cp -r "$DISK/run" "$OUT"
exit $code
"""
EXIT_WRITE_FAILED, NO_DISK = 74, 77


def read(path):
    return json.loads(path.read_text(encoding="utf-8"))


class Passes(unittest.TestCase):
    def passes(self, kind, program="lio-replay"):
        """The folders of a replay of one pass and one of two over a drive with the fault."""
        drive = support.simulated("campus", "--duration", "40", "--lidar", "vlp16", "--fault",
                                  FAULTS[kind])
        folders = []
        for num in (1, 2):
            folders.append(support.WORK / f"passes-{kind}-{program}-{num}")
            rig = "--config" if program == "lio-replay" else "--rig"
            support.run_well(program, rig, drive / "config.yaml", drive / "log.lcm", "--out",
                             folders[-1], "--overwrite", "--passes", num)
            self.assertEqual(read(folders[-1] / "stats.json")["num_passes"], num)
            self.assertFalse((folders[-1] / ".pass_2").exists())
        return drive, folders

    def error_m(self, drive, folder, path):
        file = folder / "eval_of_passes.json"
        support.run_well("lio-eval", drive / "truth.tum", folder / path, "--json", file)
        return read(file)["ape"]["position_m"]["rmse"]

    def check_mended(self, kind, program):
        drive, (one, two) = self.passes(kind, program)
        before, after = read(one / "verdict.json"), read(two / "verdict.json")
        self.assertEqual(before["trust"], "doubtful")
        self.assertEqual(before["causes"][0]["kind"], kind)
        self.assertNotIn("mended", before)
        self.assertEqual(after["trust"], "yes")
        self.assertEqual(after["mended"][0], before["causes"][0])
        errors = [self.error_m(drive, folder, "") for folder in (one, two)]
        published = [self.error_m(drive, folder, "trajectory.tum") for folder in (one, two)]
        print(f"{kind}: APE {errors[0]:.4f} m with one pass, {errors[1]:.4f} m with two; as "
              f"published {published[0]:.4f}, {published[1]:.4f}")
        self.assertLess(errors[1], 0.8 * errors[0])
        self.assertLess(published[1], 0.5 * published[0])
        return one, two

    def test_a_clock_offset_is_known_from_the_first_row_on(self):
        one, two = self.check_mended("clock_offset", "lio-replay")
        beams = [(folder / "beams.yaml").read_text(encoding="utf-8") for folder in (one, two)]
        self.assertEqual(*beams, "the second pass learns nothing twice")

    def test_a_wrong_mounting_is_known_from_the_first_row_on(self):
        _, two = self.check_mended("extrinsic_rotation", "lio-run")
        self.assertTrue((two / "report.html").exists() and (two / "map.pcd").exists())

    def test_a_disk_that_holds_one_pass_alone_keeps_it_whole(self):
        if not support.may_unshare("-rm"):
            self.skipTest("no right to make a mount namespace")
        drive, (one, _) = self.passes("clock_offset")
        num_bytes = sum(file.stat().st_size for file in one.iterdir())
        disk, out = support.WORK / "passes-disk", support.WORK / "passes-from-disk"
        shutil.rmtree(out, ignore_errors=True)
        disk.mkdir(exist_ok=True)
        words = [f"{name}={value}" for name, value in
                 {"SIZE": int(1.5 * num_bytes), "DISK": disk, "DRIVE": drive, "OUT": out,
                  "REPLAY": support.BUILD / "bin/lio-replay"}.items()]
        done = subprocess.run(["unshare", "-rm", "env", *words, "bash", "-c", SMALL_DISK],
                              stdin=subprocess.DEVNULL, capture_output=True, text=True,
                              timeout=support.TIMEOUT_S, check=False)
        if done.returncode == NO_DISK:
            self.skipTest(f"a file system of its own is not permitted here: {done.stderr}")
        self.assertEqual(done.returncode, EXIT_WRITE_FAILED, done.stderr)
        self.assertIn("the second pass could not be written", done.stderr)
        self.assertFalse((out / ".pass_2").exists())
        for name in ("trajectory.tum", "covariance.csv", "states.csv", "verdict.json"):
            self.assertEqual((out / name).read_bytes(), (one / name).read_bytes(), name)

    # The axes of its messages are turned by quarters, and the lidar sits 12 cm above it, 6 deg off.
    def test_a_log_without_any_rig_is_trusted_after_one_command(self):
        drive = support.simulated("campus", "--duration", "40", "--lidar", "vlp16", "--imu-variant",
                                  "turned")
        bare, out = support.WORK / "passes-bare", support.WORK / "passes-without-rig"
        shutil.rmtree(bare, ignore_errors=True)
        bare.mkdir()
        (bare / "log.lcm").symlink_to(drive / "log.lcm")
        shutil.rmtree(out / ".pass_2", ignore_errors=True)
        (out / ".pass_2").mkdir(parents=True)  # as a run leaves it that was killed
        text = support.run_well("lio-run", bare / "log.lcm", "--truth", drive / "truth.tum", "--out",
                                out, "--overwrite")
        verdict = read(out / "verdict.json")
        self.assertEqual(verdict["trust"], "yes", text)
        self.assertIn("extrinsic_rotation", [cause["kind"] for cause in verdict["mended"]])
        self.assertIn("rig_corrected.yaml", text)
        self.assertLess(read(out / "eval.json")["ape"]["position_m"]["rmse"], 0.02)
        self.assertFalse((out / ".pass_2").exists())


if __name__ == "__main__":
    support.main()
