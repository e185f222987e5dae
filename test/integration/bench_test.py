#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Runs the measuring scripts of tools/bench that are fleets over drives of a few seconds: each must
give its tables. The figures themselves are the business of other tests."""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import support
from fleet_test import missing_part

BENCH = support.SOURCE / "tools/bench"
sys.path += [str(BENCH), str(support.SOURCE / "tools/fleet")]


def bench(script, *words):
    done = subprocess.run([str(BENCH / script), *map(str, words)], stdin=subprocess.DEVNULL,
                          capture_output=True, text=True, timeout=support.TIMEOUT_S, check=False,
                          env=dict(os.environ, LIO_BUILD=str(support.BUILD)))
    if done.returncode != 0:
        raise AssertionError(done.stderr)
    return done


def tables(text):
    """The Markdown tables of a text, each as rows by their first cell."""
    found = []
    for block in text.split("\n\n"):
        rows = [[cell.strip() for cell in line.strip("|").split("|")]
                for line in block.splitlines() if line.startswith("| ")]
        found.append({row[0]: row[1:] for row in rows})
    return found


class Bench(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        if missing_part():
            raise unittest.SkipTest(missing_part())
        cls.temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.temporary.cleanup)
        cls.folder = pathlib.Path(cls.temporary.name)

    def test_monte_carlo_judges_all_seeds_and_continues(self):
        words = ("--sim", "--lidar vlp16", "--set", "ndt.voxel_m=0.9", "--first", 3, "--out",
                 self.folder / "runs", "street", 2, 3)
        bench("monte_carlo.sh", *words)
        for name in ("consistency", "consistency_world", "consistency_level"):
            judged = json.loads((self.folder / f"runs/{name}.json").read_text())
            self.assertEqual([pathlib.Path(run["name"]).name for run in judged["runs"]],
                             ["street-3", "street-4"])
            self.assertIn("NEES pose", (self.folder / f"runs/{name}.txt").read_text())
            self.assertTrue((self.folder / f"runs/{name}.png").exists())
        options = (self.folder / "runs/runs/liod/street-3/options.yaml").read_text()
        self.assertIn("voxel_m: 0.9", options)
        self.assertIn("nothing to do", bench("monte_carlo.sh", *words).stderr)

    def test_scenarios_have_a_row_in_both_tables(self):
        out = self.folder / "scenarios"
        done = bench("scenarios.sh", "--duration", 3, "--seed", 2, "--jobs", 2, "--out", out,
                     "parked", "hall")
        errors, matches = tables(done.stdout)
        for table in (errors, matches):
            self.assertEqual(list(table), ["drive", "parked", "hall"])
            self.assertEqual({len(row) for row in table.values()}, {len(table["drive"])})
        self.assertEqual(done.stdout, (out / "table.md").read_text())
        self.assertLess(float(errors["parked"][1]), 5)
        self.assertEqual(list(out.glob("drives/*/log.lcm")), [])

    def test_compare_has_each_method_with_and_without_imu(self):
        drive = support.simulated("street", "--duration", "5", "--lidar", "vlp16")
        out = self.folder / "compared"
        done = bench("compare.sh", drive / "log.lcm", drive / "truth.tum", "--duration", 4,
                     "--jobs", 2, "--out", out)
        (table,) = tables(done.stdout)
        self.assertEqual(list(table), ["method", "ndt", "ndt-lidar", "loam", "loam-lidar", "gicp",
                                       "gicp-lidar"])
        self.assertLess(float(table["ndt"][0]), 5)
        self.assertNotEqual(table["ndt"][0], table["ndt-lidar"][0])
        self.assertTrue((out / "paths.png").exists())

    def test_the_fleets_of_longer_measurements_have_no_fault(self):
        import ablation
        import densities
        import fleet_file
        for fleet in (ablation.fleet_of(["street-vlp16"], [1, 2], ["glass", "engine"]),
                      densities.fleet_of(["street-vlp16"], [1, 2])):
            file = self.folder / "fleet.yaml"
            file.write_text(json.dumps(fleet))
            self.assertEqual(fleet_file.read_fleet(file)[1], [])


if __name__ == "__main__":
    support.main()
