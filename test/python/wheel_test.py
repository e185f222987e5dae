#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Tests that `pip install .` makes a package that works on its own, that its types are those of the
stubs, and that the example draws its pictures."""
import ast
import importlib.util
import inspect
import os
import re
import subprocess
import sys
import tempfile
import unittest
import zipfile

import package
import support

liod = package.load()

USE = """
import liod, sys
log, config = sys.argv[1:]
assert (liod.config_directory() / "lidars/vlp16.yaml").is_file()
assert str(liod.config_directory()).startswith(liod.__path__[0]), liod.config_directory()
with liod.Odometry(config) as odometry:
    print(sum(len(odometry.add(event)) for event in liod.read_log(log)))
"""


def command(*words, **environment):
    environment = {**os.environ, **environment}
    environment.pop("LIO_CONFIG_DIR", None)
    done = subprocess.run([str(word) for word in words], stdin=subprocess.DEVNULL,
                          capture_output=True, text=True, timeout=support.TIMEOUT_S, check=False,
                          env=environment, cwd=support.WORK)
    if done.returncode != 0:
        raise AssertionError(f"{done.args} ended with {done.returncode}:\n{done.stdout}\n"
                             f"{done.stderr}")
    return done.stdout


class Wheel(package.Case):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        for module in ("pip", "setuptools", "wheel"):
            if importlib.util.find_spec(module) is None:
                raise unittest.SkipTest(f"there is no python3-{module}")
        cls.folder = tempfile.TemporaryDirectory(dir=support.WORK, prefix="wheel-")
        # The build folder's module is taken: to compile it all anew would take minutes.
        command("/usr/bin/python3", "-m", "pip", "wheel", "--no-build-isolation", "--no-index",
                "--no-deps", "--wheel-dir", cls.folder.name, support.SOURCE,
                LIO_BUILD_DIR=str(support.BUILD))
        cls.wheel = next(support.pathlib.Path(cls.folder.name).glob("*.whl"))

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_the_wheel_names_the_python_that_it_is_for(self):
        major, minor = sys.version_info[:2]
        self.assertRegex(self.wheel.name,
                         rf"^liod-{re.escape(liod.__version__)}-cp{major}{minor}-.*linux.*\.whl$")

    def test_the_wheel_holds_the_package_its_types_and_its_data(self):
        names = set(zipfile.ZipFile(self.wheel).namelist())
        for name in ("__init__.py", "py.typed", "_liod.pyi", "config/lidars/vlp16.yaml",
                     "config/default.yaml"):
            self.assertIn(f"liod/{name}", names)
        self.assertEqual(sum(name.endswith(".so") for name in names), 1)
        self.assertTrue(any(name.endswith("LICENSE") for name in names), names)

    def test_the_wheel_works_where_it_is_installed(self):
        target = support.pathlib.Path(self.folder.name) / "site"
        command("/usr/bin/python3", "-m", "pip", "install", "--no-index", "--no-deps", "--target",
                target, self.wheel)
        text = command("/usr/bin/python3", "-c", USE, self.log, self.config,
                       PYTHONPATH=str(target))
        self.assertGreater(int(text), 40)


class Types(unittest.TestCase):
    @staticmethod
    def names_in(node):
        """The public members that the stub of a class has."""
        names = {part.name for part in node.body if isinstance(part, ast.FunctionDef)}
        names |= {part.target.id for part in node.body if isinstance(part, ast.AnnAssign)}
        return {name for name in names if not name.startswith("_")}

    def test_the_stubs_have_what_the_module_has(self):
        from liod import _liod
        stubs = ast.parse((package.FOLDER / "liod/_liod.pyi").read_text(encoding="utf-8"))
        classes = {node.name: self.names_in(node) for node in stubs.body
                   if isinstance(node, ast.ClassDef)}
        for name, shown in inspect.getmembers(_liod, inspect.isclass):
            members = {member for member in vars(shown) if not member.startswith("_")}
            self.assertEqual(members, classes.pop(name), name)
        self.assertEqual(classes, {})
        for name in liod.__all__:
            self.assertTrue(hasattr(liod, name), name)

    def test_mypy_finds_no_fault(self):
        if importlib.util.find_spec("mypy") is None:
            self.skipTest("there is no mypy")
        use = support.WORK / "use_types.py"
        support.WORK.mkdir(parents=True, exist_ok=True)
        use.write_text("import liod\n"
                       "for event in liod.read_log('drive.lcm'):\n"
                       "    if isinstance(event, liod.Scan):\n"
                       "        reveal_type(event.points)\n"
                       "    for estimate in liod.Odometry().add(event):\n"
                       "        reveal_type(estimate.position)\n"
                       "reveal_type(liod.evaluate('a', 'b').figures)\n")
        text = command("/usr/bin/python3", "-m", "mypy", "--strict", "--cache-dir", os.devnull,
                       "-p", "liod", MYPYPATH=str(package.FOLDER))
        self.assertIn("no issues", text)
        text = command("/usr/bin/python3", "-m", "mypy", "--strict", "--cache-dir", os.devnull,
                       use, MYPYPATH=str(package.FOLDER))
        for revealed in ("_32Bit", "_64Bit", "dict[builtins.str, Any]"):
            self.assertIn(revealed, text)


class Example(package.Case):
    def test_the_notebook_draws_its_pictures(self):
        if importlib.util.find_spec("matplotlib") is None:
            self.skipTest("there is no python3-matplotlib")
        with tempfile.TemporaryDirectory(dir=support.WORK) as folder:
            text = command("/usr/bin/python3", support.SOURCE / "examples/notebook.py", "--drive",
                           self.drive, "--out", folder, PYTHONPATH=str(package.FOLDER))
            self.assertIn("position error", text)
            for name in ("python_path.png", "python_error.png", "python_covariance.png"):
                picture = support.pathlib.Path(folder) / name
                self.assertGreater(picture.stat().st_size, 10_000, name)


if __name__ == "__main__":
    support.main()
