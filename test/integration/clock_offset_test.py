#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Tests that the offset between the clocks of lidar and IMU is tracked on a walk."""
import re
import unittest

import support

OFFSET_S = 0.02
EXIT_NO_TRUST = 6  # the exit code when the offset is not known


class ClockOffset(unittest.TestCase):
    def test_campus_walk_shows_it_to_two_milliseconds_and_is_tracked_as_without_it(self):
        folder = support.simulated("campus", "--duration", "30", "--fault",
                                   f"clock_offset:offset={OFFSET_S},channel=lidar")

        def error_m(name, *sets):
            words = [word for key_value in sets for word in ("--set", key_value)]
            out = support.WORK / name
            done = support.run("lio-replay", "--config", folder / "config.yaml", *words,
                               folder / "log.lcm", "--out", out, "--overwrite")
            self.assertIn(done.returncode, (0, EXIT_NO_TRUST), done.stderr)
            ape = support.evaluate(folder / "truth.tum", out)["ape"]
            return ape["position_m"]["rmse"], done.stderr

        unknown, _ = error_m("clock-unknown", "filter.estimate_clock_offset=false")
        known, _ = error_m("clock-known", f"rig.lidar.clock_offset_s={-OFFSET_S}",
                           "filter.estimate_clock_offset=false")
        followed, told = error_m("clock-followed")
        found_s = float(re.search(r"rig\.lidar\.clock_offset_s: (-?\d+\.\d+)", told)[1])
        print(f"found {1e3 * found_s:.1f} ms; APE rmse {unknown:.4f} m unknown, {known:.4f} m "
              f"known, {followed:.4f} m followed")
        self.assertAlmostEqual(found_s, -OFFSET_S, delta=2e-3)
        self.assertLess(followed, 0.7 * unknown)
        self.assertLess(followed, 1.5 * known + 0.01)


if __name__ == "__main__":
    support.main()
