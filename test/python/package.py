# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Finds the package liod of the build folder, and a drive for its tests."""
import importlib
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "integration"))

import support  # noqa: E402  (it stands in the folder of the integration tests)

FOLDER = support.BUILD / "python"


def load():
    """Returns the package; skips where it is not built."""
    if not list((FOLDER / "liod").glob("_liod*.so")):
        print("skipped: the Python package is not built; pybind11-dev, python3-dev and "
              "python3-numpy make it", file=sys.stderr)
        sys.exit(77)
    sys.path.insert(0, str(FOLDER))
    try:
        return importlib.import_module("liod")
    except ModuleNotFoundError as error:
        print(f"skipped: {error}", file=sys.stderr)
        sys.exit(77)


def drive():
    """Returns the folder of a short simulated drive: log.lcm, config.yaml, truth.tum."""
    return support.simulated("street", "--duration", "6", "--lidar", "vlp16")


class Case(unittest.TestCase):
    """A test with the drive at hand."""

    @classmethod
    def setUpClass(cls):
        cls.drive = drive()
        cls.log = cls.drive / "log.lcm"
        cls.config = cls.drive / "config.yaml"

    def check_error(self, error, words, call, *arguments, **named):
        """The call raises exactly this error, in which each of the words stands."""
        with self.assertRaises(error) as caught:
            call(*arguments, **named)
        self.assertIs(type(caught.exception), error)
        for word in words:
            self.assertIn(word, str(caught.exception))
