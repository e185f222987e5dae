#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Tests that liod.evaluate gives the figures and the words of lio-eval, from files and arrays."""
import json

import package
import support

liod = package.load()
import numpy as np  # noqa: E402  (the package needs it, too)


def helix(count=300):
    """Stamps and poses of a climbing curve."""
    angle = 0.02 * np.arange(count)
    poses = np.tile(np.eye(4), (count, 1, 1))
    poses[:, 0, 0] = poses[:, 1, 1] = np.cos(angle)
    poses[:, 1, 0] = np.sin(angle)
    poses[:, 0, 1] = -np.sin(angle)
    poses[:, 0, 3], poses[:, 1, 3] = 20 * np.cos(angle), 20 * np.sin(angle)
    poses[:, 2, 3] = 0.1 * np.arange(count)
    return 1_000_000_000_000 + 100_000_000 * np.arange(count), poses


class Evaluate(package.Case):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.truth = cls.drive / "truth.tum"
        cls.run_folder = support.replay(cls.log, "python-scored", "--config", cls.config)

    def test_figures_and_text_are_those_of_lio_eval(self):
        file = support.WORK / "python-eval.json"
        text = support.run_well("lio-eval", self.truth, self.run_folder, "--json", file)
        scored = liod.evaluate(self.truth, self.run_folder)
        self.assertEqual(scored.figures, json.loads(file.read_text()))
        self.assertEqual(str(scored), text)
        for align, offset in (("none", 0.01), ("yaw", "auto")):
            support.run_well("lio-eval", self.truth, self.run_folder, "--json", file, "--align",
                             align, "--time-offset", offset, "--max-gap", "0.5")
            scored = liod.evaluate(self.truth, self.run_folder, align=align, time_offset_s=offset,
                                   max_gap_s=0.5)
            self.assertEqual(scored.figures, json.loads(file.read_text()))

    def test_rows_are_those_of_the_figures(self):
        scored = liod.evaluate(self.truth, self.run_folder / "trajectory.tum")
        error = np.linalg.norm(scored.estimate - scored.truth, axis=1)
        np.testing.assert_allclose(error, scored.position_error_m, atol=1e-12)
        rmse = scored.figures["ape"]["position_m"]["rmse"]
        self.assertAlmostEqual(np.sqrt((error**2).mean()), rmse, places=12)
        self.assertEqual(len(scored.stamps_ns), scored.figures["association"]["num_pairs"])
        self.assertEqual(len(scored.rotation_error_deg), len(scored.stamps_ns))
        self.assertTrue((np.diff(scored.stamps_ns) > 0).all())

    def test_arrays_are_scored_like_files(self):
        stamps, poses = helix()
        moved = poses.copy()
        moved[:, 2, 3] += 2
        scored = liod.evaluate((stamps, poses), (stamps, moved), align="none")
        np.testing.assert_allclose(scored.position_error_m, 2)
        self.assertAlmostEqual(scored.figures["ape"]["vertical_m"]["rmse"], 2)
        aligned = liod.evaluate((stamps, poses), (stamps.tolist(), moved.tolist()))
        self.assertLess(aligned.position_error_m.max(), 1e-9)
        late = liod.evaluate((stamps, poses), (stamps + 50_000_000, poses), time_offset_s="auto")
        self.assertAlmostEqual(late.figures["time_offset_s"], -0.05, delta=1e-3)

    def test_estimates_are_scored_as_they_come(self):
        odometry = liod.Odometry(self.config)
        estimates = [e for event in liod.read_log(self.log) for e in odometry.add(event)]
        estimates += odometry.finish()
        path = [e.stamp_ns for e in estimates], np.stack([e.map_pose for e in estimates])
        by_arrays = liod.evaluate(self.truth, path).figures["ape"]["position_m"]["rmse"]
        by_file = liod.evaluate(self.truth, self.run_folder / "trajectory.tum").figures
        self.assertAlmostEqual(by_arrays, by_file["ape"]["position_m"]["rmse"], places=6)

    def test_wrong_paths_are_named(self):
        stamps, poses = helix(10)
        bent = poses.copy()
        bent[3, 0, 0] = 2
        hole = poses.copy()
        hole[5, 0, 3] = np.nan
        for words, run in ((["run", "(10, 4, 4)"], (stamps, poses[:, :3])),
                           (["run", "(9, 4, 4)"], (stamps[:9], poses)),
                           (["run", "pose 3"], (stamps, bent)),
                           (["run", "pose 5"], (stamps, hole)),
                           (["run", "stamp 1 "], (stamps[::-1], poses)),
                           (["run", "two arrays"], (stamps,))):
            with self.subTest(words):
                self.check_error(ValueError, words, liod.evaluate, self.truth, run)
        self.check_error(TypeError, ["run", "path"], liod.evaluate, self.truth, 12)
        self.check_error(TypeError, ["truth", "integers"], liod.evaluate,
                         (stamps.astype(float), poses), self.truth)
        for few in ((stamps[:0], poses[:0]), (stamps[:1], poses[:1]), (stamps[:2], poses[:2])):
            with self.assertRaises(liod.InputError):
                liod.evaluate((stamps, poses), few)
            with self.assertRaises(liod.InputError):
                liod.evaluate(few, (stamps, poses), time_offset_s="auto")

    def test_wrong_files_are_named(self):
        self.check_error(liod.InputError, ["/no/such.tum"], liod.evaluate, self.truth,
                         "/no/such.tum")
        self.check_error(liod.InputError, ["/no/such.tum"], liod.evaluate, "/no/such.tum",
                         self.run_folder)
        self.check_error(liod.InputError, [str(self.log)], liod.evaluate, self.truth, self.log)
        bad = support.WORK / "python-bad.tum"
        bad.write_text("1 2 three\n")
        self.check_error(liod.InputError, ["python-bad.tum:1"], liod.evaluate, self.truth, bad)

    def test_wrong_options_are_named(self):
        for words, options in ((["align", "se3"], {"align": "sim3"}),
                               (["max_gap_s"], {"max_gap_s": 0}),
                               (["max_gap_s"], {"max_gap_s": float("nan")}),
                               (["time_offset_s"], {"time_offset_s": float("inf")}),
                               (["time_offset_s", "auto"], {"time_offset_s": "soon"})):
            with self.subTest(options):
                self.check_error(liod.UsageError, words, liod.evaluate, self.truth,
                                 self.run_folder, **options)


if __name__ == "__main__":
    support.main()
