# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Builds the module of the Python package liod by CMake, for pip.

LIO_BUILD_DIR names a build folder that CMake configured already, e.g. build: its module is brought
up to date and taken, where everything would otherwise be compiled anew into a folder of pip's.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = pathlib.Path(__file__).resolve().parent


def version():
    text = (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
    return re.search(r"^project\(liod VERSION ([\d.]+)", text, re.MULTILINE).group(1)


class BuildByCmake(build_ext):
    """Lets CMake make the module, and copies it with the configurations beside it."""

    def build_extension(self, ext):
        package = pathlib.Path(self.get_ext_fullpath(ext.name)).resolve().parent
        given = os.environ.get("LIO_BUILD_DIR")
        build = pathlib.Path(given or self.build_temp).resolve()
        if given is None:
            self.configure(build)
        subprocess.run(["cmake", "--build", build, "--target", "lio_python", "--parallel",
                        str(os.cpu_count())], check=True)
        module = next((build / "python/liod").glob("_liod*.so"))
        package.mkdir(parents=True, exist_ok=True)
        shutil.copy(module, package)
        if shutil.which("strip"):
            subprocess.run(["strip", "--strip-unneeded", package / module.name], check=True)
        shutil.copytree(ROOT / "config", package / "config", dirs_exist_ok=True)

    @staticmethod
    def configure(build):
        generator = ["-G", "Ninja"] if shutil.which("ninja") else []
        subprocess.run(["cmake", "-S", ROOT, "-B", build, *generator, "-DCMAKE_BUILD_TYPE=Release",
                        "-DLIO_UNITY=ON", "-DLIO_BUILD_TESTS=OFF",
                        f"-DPython3_EXECUTABLE={sys.executable}"], check=True)


# CMake's folder is build/ already.
SCRATCH = ROOT / "out/pip"
SCRATCH.mkdir(parents=True, exist_ok=True)

setup(version=version(), ext_modules=[Extension("liod._liod", sources=[])],
      cmdclass={"build_ext": BuildByCmake},
      options={"build": {"build_base": str(SCRATCH)}, "egg_info": {"egg_base": str(SCRATCH)}})
