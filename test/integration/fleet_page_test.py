#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Checks the paired tests of tools/fleet by known numbers, and its page in Chromium: a page of 1000
runs opens, sorts, filters and draws, without an error or an outside host."""
import pathlib
import random
import sys
import tempfile
import time
import unittest

import browser
import support

sys.path.insert(0, str(support.SOURCE / "tools/fleet"))
try:
    import page as fleet_page
    import paired
    import rows as fleet_rows
    MISSING = ""
except ModuleNotFoundError as error:
    MISSING = f"Debian's python3-{error.name} is not installed"

# Darwin's fifteen pairs of maize, as Fisher (1935) and many textbooks have them; in 1/8 inch.
MAIZE = (49, -67, 8, 16, 6, 23, 28, 41, 14, 29, 56, 24, 75, 60, -48)
MAIZE_WILCOXON_P = 0.04125976562  # exact, two-sided, signed-rank sum 24
MAIZE_SIGN_P = 2 * (1 + 15 + 105) / 2 ** 15


def row(system, drive, **figures):
    known = {"drive": drive, "group": drive.split("-")[0], "seed": 1, "system": system,
             "kind": "liod"}
    return known | fleet_rows.empty_row("done", "") | {"trust": "yes"} | figures


def maize_table():
    """The baseline is at 100 everywhere, so that the differences are those of the maize."""
    return [made for index, difference in enumerate(MAIZE)
            for made in (row("base", f"d-{index}", ape_m=100.0),
                         row("other", f"d-{index}", ape_m=100.0 + difference))]


def large_table(num_runs):
    """Runs of four systems; the second errs 20 % less, the third has no figure in each tenth."""
    chance, table = random.Random(1), []
    scales = {"ndt": 1.0, "fine": 0.8, "loam": 1.3, "kiss-icp": 1.6}
    for index in range(num_runs // len(scales)):
        scenario = ("street", "loop", "suburb", "office", "mine")[index % 5]
        hard = chance.lognormvariate(-2, 0.8)
        for system, scale in scales.items():
            ape_m = scale * hard * chance.lognormvariate(0, 0.3)
            made = row(system, f"{scenario}-{index}", ape_m=ape_m, ape_max_m=2 * ape_m,
                       drift_percent=ape_m, end_percent=ape_m / 2, end_m=3 * ape_m,
                       coverage_ratio=0.99, path_m=300.0, duration_s=60.0,
                       nees_pose=chance.lognormvariate(0, 0.3), scan_median_ms=3 * scale,
                       run_cpu_s=4.5, rss_peak_mb=90.0)
            made["trust"] = chance.choice(("yes", "yes", "yes", "doubtful", "no"))
            if system == "loam" and index % 10 == 0:
                made |= fleet_rows.empty_row("failed", "</script> an odd message & more")
            table.append({column: made.get(column) for column in fleet_rows.COLUMNS})
    return table, list(scales)


@unittest.skipIf(MISSING, MISSING)
class Paired(unittest.TestCase):
    def test_darwins_maize(self):
        found = paired.compare(maize_table(), "other", "base", "ape_m")
        self.assertEqual((found["num_pairs"], found["num_better"], found["num_worse"]), (15, 2, 13))
        self.assertAlmostEqual(found["wilcoxon_p"], MAIZE_WILCOXON_P, 9)
        self.assertAlmostEqual(found["sign_p"], MAIZE_SIGN_P, 12)
        self.assertEqual(found["median_difference"], 24)
        # The ranks of -67 and -48 are 14 and 10, and all ranks add up to 120.
        self.assertEqual(found["signed_rank_sum"], 120 - 2 * (14 + 10))
        self.assertAlmostEqual(found["median_ratio"], 1.24)

    def test_all_pairs_one_way_give_the_smallest_p(self):
        self.assertAlmostEqual(paired.wilcoxon_p([1, 2, 3, 4, 5, 6]), 2 / 64)
        self.assertAlmostEqual(paired.sign_p(6, 0), 2 / 64)

    def test_equal_pairs_show_no_difference(self):
        self.assertEqual(paired.wilcoxon_p([0, 0, 0]), 1.0)
        self.assertEqual(paired.sign_p(0, 0), 1.0)

    def test_holm_corrects_step_by_step(self):
        for found, expected in zip(paired.holm([0.01, 0.04, 0.03]), (0.03, 0.06, 0.06)):
            self.assertAlmostEqual(found, expected)

    def test_nees_is_compared_by_its_distance_from_one(self):
        self.assertAlmostEqual(paired.cost("nees_pose", 0.5), paired.cost("nees_pose", 2.0))
        self.assertIsNone(paired.cost("nees_pose", None))

    def test_drives_that_one_system_lacks_are_no_pairs(self):
        table = maize_table() + [row("other", "alone", ape_m=1.0), row("base", "none")]
        self.assertEqual(paired.compare(table, "other", "base", "ape_m")["num_pairs"], 15)


@unittest.skipIf(MISSING or not browser.BROWSER, MISSING or "chromium is not installed")
class Page(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        table, systems = large_table(1000)
        cls.text = fleet_page.html(table, paired.summarize(table, systems, "ndt"), "ndt")
        with tempfile.NamedTemporaryFile("w", suffix=".html", delete=False) as file:
            file.write(cls.text)
        cls.file = pathlib.Path(file.name)
        cls.addClassCleanup(cls.file.unlink)
        opened = browser.open_browser()
        cls.chromium = opened.__enter__()
        cls.addClassCleanup(opened.__exit__, None, None, None)

    def open(self):
        page = self.chromium.open(f"file://{self.file}", height=2200)
        page.wait_for("document.documentElement.dataset.drawn === 'yes'")
        return page

    def opening_s(self):
        start_s = time.monotonic()
        page = self.open()
        # Two frames later the page has been painted.
        page.run("new Promise(f => requestAnimationFrame(() => requestAnimationFrame(f)))")
        self.assertEqual(page.run("document.getElementById('shown').textContent"),
                         "1000 of 1000 runs")
        self.assertEqual(page.faults, [])
        return time.monotonic() - start_s

    def test_1000_runs_open(self):
        """How long that takes is told and not judged: it is the machine's affair."""
        took_s = [self.opening_s() for _ in range(4)]
        print("opened and painted in", *(f"{value:.2f}" for value in took_s), "s;",
              f"{len(self.text) / 1e6:.2f} MB")

    def test_scrolling_shows_all_rows(self):
        page = self.open()
        count = "document.querySelectorAll('#runs tbody tr').length"
        self.assertEqual(page.run(count), 100)
        for _ in range(12):
            page.run("(() => { const b = document.getElementById('runs').parentNode;"
                     " b.scrollTop = b.scrollHeight; b.onscroll(); })()")
        self.assertEqual(page.run(count), 1000)

    def cells(self, page, column):
        page.run("addRuns(1000)")
        index = page.run(f"listed.indexOf('{column}')")
        return page.run("[...document.querySelectorAll('#runs tbody tr')]"
                        f".map(row => row.cells[{index}].textContent)")

    def test_a_click_sorts_and_a_second_one_turns_the_order(self):
        page = self.open()
        for sign in (1, -1):
            page.run("document.querySelector('th[data-column=ape_m]').click()")
            values = [float(cell) for cell in self.cells(page, "ape_m") if cell]
            self.assertEqual(values, sorted(values, reverse=sign < 0))
            self.assertEqual(self.cells(page, "ape_m")[-25:], [""] * 25, "no figure comes last")
        self.assertEqual(page.faults, [])

    def test_the_filter_keeps_the_rows_with_all_its_words(self):
        page = self.open()
        page.run("(() => { const f = document.getElementById('filter'); f.value = 'failed loam';"
                 " f.dispatchEvent(new Event('input')); })()")
        self.assertEqual(self.cells(page, "status"), ["failed"] * 25)

    def test_another_figure_is_drawn_and_its_medians_are_shown(self):
        page = self.open()
        page.run("(() => { const s = document.getElementById('figure'); s.value = 'nees_pose';"
                 " s.dispatchEvent(new Event('change')); })()")
        self.assertIn("NEES", page.run("document.getElementById('drives').textContent"))
        self.assertEqual(page.run("document.querySelectorAll('#plot canvas').length"), 1)
        ink = page.run("(() => { const c = document.querySelector('#plot canvas'); const d ="
                       " c.getContext('2d').getImageData(0, 0, c.width, c.height).data; let n = 0;"
                       " for (let i = 3; i < d.length; i += 4) n += d[i] > 0; return n; })()")
        self.assertGreater(ink, 5000)

    def test_verdicts_follow_the_tests(self):
        page = self.open()
        verdicts = page.run("Object.fromEntries([...document.querySelectorAll('#paired tr')]"
                            ".filter(row => row.cells[1].textContent === 'APE m')"
                            ".map(row => [row.cells[0].textContent, row.cells[10].textContent]))")
        self.assertEqual(verdicts, {"fine": "better", "loam": "worse", "kiss-icp": "worse"})

    def test_no_outside_host_is_named(self):
        for word in ("<script src", "<link rel=\"stylesheet\"", "@import", "fetch("):
            self.assertNotIn(word, self.text)


if __name__ == "__main__":
    support.main()
