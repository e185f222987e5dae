#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Tests tools/golden.sh without replaying anything: it passes only where something was compared."""
import contextlib
import io
import os
import pathlib
import subprocess
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools" / "golden"))
import golden  # noqa: E402

ROW = dict.fromkeys(golden.COLUMNS, "0")


def exit_code(*verdicts):
    with contextlib.redirect_stderr(io.StringIO()) as said:
        return golden.exit_code(list(verdicts)), said.getvalue()


class Golden(unittest.TestCase):
    def test_a_case_is_the_same_or_differs_or_has_another_log(self):
        self.assertIs(golden.verdict(ROW, ROW)[1], True)
        text, verdict = golden.verdict(ROW, ROW | {"covariance": "1"})
        self.assertIs(verdict, False)
        self.assertIn("covariance", text)
        self.assertIs(golden.verdict(ROW, ROW | {"log": "1", "covariance": "1"})[1], None)
        self.assertIs(golden.verdict(ROW, None)[1], False)

    def test_it_passes_only_where_something_was_compared(self):
        self.assertEqual(exit_code(True, None), (0, ""))
        self.assertEqual(exit_code(True, False, None), (1, ""))
        for verdicts in ((), (None, None)):
            code, said = exit_code(*verdicts)
            self.assertEqual(code, 3)
            self.assertIn("nothing was compared", said)

    def test_recorded_logs_that_are_not_there_prove_nothing(self):
        case = next(case.name for case in golden.CASES if case.real)
        done = subprocess.run([ROOT / "tools" / "golden.sh", case], check=False,
                              capture_output=True, text=True,
                              env=dict(os.environ, LIO_DATA="/no/such/folder"))
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn("/no/such/folder", done.stdout)


if __name__ == "__main__":
    unittest.main()
