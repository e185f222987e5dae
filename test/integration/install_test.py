#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""The installed tree: its files, what its programs load, that each public header compiles on its
own, and that the examples build against it and find the way of a simulated cart."""
import concurrent.futures
import gzip
import json
import pathlib
import re
import shlex
import subprocess
import tempfile
import unittest

import support

PROGRAMS = {"liod", "lio-run", "lio-replay", "lio-convert", "lio-eval", "lio-log", "lio-sim",
            "lio-spy", "lio-view"}
READ_BAGS = ("lio-convert", "lio-run", "lio-log")
BAG_LIBRARIES = ("libsqlite3", "libbz2", "liblz4", "libzstd")
MAX_ERROR_M = 0.05


def cached(key):
    """A value of the build folder's CMake cache, or ''."""
    text = (support.BUILD / "CMakeCache.txt").read_text(encoding="utf-8")
    found = re.search(rf"^{key}:\w+=(.*)$", text, re.MULTILINE)
    return found.group(1) if found else ""


def command(*words):
    done = subprocess.run([str(word) for word in words], stdin=subprocess.DEVNULL,
                          capture_output=True, text=True, timeout=support.TIMEOUT_S, check=False)
    if done.returncode != 0:
        raise AssertionError(f"{' '.join(done.args)} ended with {done.returncode}:\n"
                             f"{done.stdout}\n{done.stderr}")
    return done.stdout


def needed(program):
    """The libraries that a program itself names, without those that they load in turn."""
    return re.findall(r"\(NEEDED\).*\[(.*)\]", command("readelf", "-d", program))


class Install(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        if cached("LIO_SANITIZE"):
            raise unittest.SkipTest("a sanitized library asks its users for the same sanitizers")
        support.WORK.mkdir(parents=True, exist_ok=True)
        cls.folder = tempfile.TemporaryDirectory(dir=support.WORK, prefix="install-")
        cls.work = pathlib.Path(cls.folder.name)
        cls.prefix = cls.work / "prefix"
        command(cached("CMAKE_COMMAND"), "--install", support.BUILD, "--prefix", cls.prefix)
        examples = support.SOURCE / "examples"
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            cls.builds = {name: pool.submit(cls.build, name, examples / name)
                          for name in ("embed", "pcl")}

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    @classmethod
    def public_headers(cls):
        base = cls.prefix / "include"
        return {path.relative_to(base).as_posix() for path in base.rglob("*") if path.is_file()}

    @classmethod
    def build(cls, name, source):
        """Gives the folder that the project was built into."""
        folder = cls.work / f"build-{name}"
        launcher = cached("LIO_CCACHE")
        launcher = "" if launcher.endswith("NOTFOUND") else launcher
        command(cached("CMAKE_COMMAND"), "-S", source, "-B", folder, "-Wno-dev",
                "-G", cached("CMAKE_GENERATOR"), f"-DCMAKE_PREFIX_PATH={cls.prefix}",
                "-DCMAKE_CXX_FLAGS=-O1", "-DCMAKE_EXPORT_COMPILE_COMMANDS=ON",
                f"-DCMAKE_CXX_COMPILER={cached('CMAKE_CXX_COMPILER')}",
                f"-DCMAKE_CXX_COMPILER_LAUNCHER={launcher}")
        command(cached("CMAKE_COMMAND"), "--build", folder, "--parallel", "2")
        return folder

    def test_programs_are_there_and_run(self):
        self.assertEqual({path.name for path in (self.prefix / "bin").iterdir()}, PROGRAMS)
        for name in PROGRAMS:
            self.assertRegex(command(self.prefix / "bin" / name, "--version"), r"\d+\.\d+\.\d+")

    def test_data_and_documents_are_there(self):
        data = self.prefix / "share/liod"
        doc = self.prefix / "share/doc/liod"
        expected = [data / "config/default.yaml", data / "config/lidars/vlp16.yaml",
                    data / "lcmtypes/lio_scan_t.lcm", doc / "LICENSE", doc / "README.md",
                    doc / "docs/messages.md", doc / "examples/embed/main.cpp"]
        if (support.BUILD / "share/liod/lio_types.jar").exists():
            expected.append(data / "lio_types.jar")
        for path in expected:
            self.assertTrue(path.is_file(), path)

    def test_what_a_service_needs_is_there(self):
        for path in ("lib/systemd/system/liod.service", "share/liod/sysctl/60-liod.conf",
                     "share/liod/systemd/realtime.conf"):
            self.assertTrue((self.prefix / path).is_file(), path)
        unit = (self.prefix / "lib/systemd/system/liod.service").read_text(encoding="utf-8")
        self.assertRegex(unit, r"(?m)^ExecStart=/\S+/liod ")
        self.assertIn("net.core.rmem_max",
                      (self.prefix / "share/liod/sysctl/60-liod.conf").read_text(encoding="utf-8"))

    # lio-spy is a script, and has neither.
    def test_manual_pages_and_completions_are_there(self):
        pages = self.prefix / "share/man/man1"
        if cached("LIO_HELP2MAN").endswith("NOTFOUND"):
            self.assertFalse(pages.exists())
        else:
            self.assertEqual({path.name for path in pages.iterdir()},
                             {f"{name}.1.gz" for name in PROGRAMS - {"lio-spy"}})
            page = gzip.decompress((pages / "liod.1.gz").read_bytes()).decode("utf-8")
            self.assertIn("lcm", page)
        completions = self.prefix / "share/bash-completion/completions"
        self.assertEqual({path.name for path in completions.iterdir()}, PROGRAMS - {"lio-spy"})
        self.assertIn("--channel-prefix", (completions / "liod").read_text(encoding="utf-8"))

    def test_headers_are_those_of_the_list(self):
        listed = (support.SOURCE / "cmake/LioInstall.cmake").read_text(encoding="utf-8")
        listed = listed[listed.index("set(LIO_PUBLIC_HEADERS"):]
        listed = set(re.findall(r"lio/[\w/]+\.hpp", listed[:listed.index(")")]))
        self.assertEqual(self.public_headers(), listed)
        self.assertLessEqual(len(listed), 30, "a handful, not the whole tree")

    # The flags are an example's: of our headers only the installed ones are on its search path.
    def test_every_header_compiles_alone(self):
        entries = json.loads((self.builds["pcl"].result() / "compile_commands.json").read_text())
        words = shlex.split(entries[0]["command"])
        self.assertNotIn(str(support.SOURCE / "include"), " ".join(words))
        words = words[:words.index("-o")] + ["-fsyntax-only", "-x", "c++", "-"]

        def compile_alone(header):
            return subprocess.run(words, input=f"#include <{header}>\n", capture_output=True,
                                  text=True, timeout=support.TIMEOUT_S, check=False).stderr
        headers = sorted(self.public_headers())
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            for header, errors in zip(headers, pool.map(compile_alone, headers)):
                self.assertEqual(errors, "", header)

    def test_only_programs_that_read_bags_load_what_bags_need(self):
        loaded = {name: needed(self.prefix / "bin" / name) for name in PROGRAMS - {"lio-spy"}}
        for name, libraries in loaded.items():
            of_bags = {lib.split(".so")[0] for lib in libraries if lib.startswith(BAG_LIBRARIES)}
            self.assertEqual(of_bags, set(BAG_LIBRARIES) if name in READ_BAGS else set(), name)

    def check_poses(self, text):
        rows = re.findall(r"^([\d.]+) s: x (\S+) y (\S+) z (\S+) m \(true x (\S+)\)$", text, re.M)
        self.assertGreater(len(rows), 30)
        for row in rows:
            _, x, y, z, true_x = map(float, row)
            for error in (x - true_x, y, z):
                self.assertLess(abs(error), MAX_ERROR_M, row)
        self.assertGreater(float(rows[-1][4]), 3.0)

    def test_the_example_of_samples_and_sweeps_finds_the_way(self):
        self.check_poses(command(self.builds["embed"].result() / "liod_embed"))

    def test_the_example_of_pcl_clouds_finds_the_way(self):
        text = command(self.builds["pcl"].result() / "liod_pcl")
        self.check_poses(text)
        self.assertGreater(int(re.search(r"map of (\d+) points", text).group(1)), 1000)

    def test_the_examples_load_neither_lcm_nor_yaml(self):
        for name in ("embed", "pcl"):
            libraries = needed(self.builds[name].result() / f"liod_{name}")
            for other in ("liblcm", "libyaml", *BAG_LIBRARIES):
                self.assertFalse([lib for lib in libraries if lib.startswith(other)], name)


if __name__ == "__main__":
    support.main()
