# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Helps the integration tests: finds programs and data, runs programs, unpacks data.

The tests are unittest files run by ctest; LIO_BUILD names the build folder. Real data comes from
LIO_DATA, else ../shared/data beside the source tree; without it a test is skipped with a message.
Everything is made once and stays under the build folder.
"""
import contextlib
import csv
import fcntl
import json
import os
import pathlib
import shutil
import subprocess
import sys
import unittest

SOURCE = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(os.environ.get("LIO_BUILD", SOURCE / "build")).resolve()
WORK = BUILD / "integration"
RIGS = SOURCE / "test/integration/rigs"
TIMEOUT_S = 240


def run(program, *words, **kwargs):
    """Runs one of our programs; the result has returncode, stdout and stderr as text."""
    command = [str(BUILD / "bin" / program), *map(str, words)]
    return subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True,
                          timeout=TIMEOUT_S, check=False, **kwargs)


def may_unshare(flags):
    """May this user make namespaces of its own? Not in a chroot, nor in many containers."""
    return subprocess.run(["unshare", flags, "true"], check=False,
                          capture_output=True).returncode == 0


def run_well(program, *words):
    done = run(program, *words)
    if done.returncode != 0:
        raise AssertionError(f"{' '.join(map(str, done.args))} ended with {done.returncode}:\n"
                             f"{done.stderr}")
    return done.stdout


@contextlib.contextmanager
def locked(name):
    """Holds a lock: tests run in parallel, and the first one makes what they share."""
    WORK.mkdir(parents=True, exist_ok=True)
    with open(WORK / f"{name}.lock", "w", encoding="utf-8") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        yield


def made_once(folder, make, program=None):
    """Returns the folder WORK/folder, filled by make(folder) unless an earlier call did so, by
    `program` as it is now."""
    path = WORK / folder
    complete = path / "complete"
    with locked(folder):
        is_old = (program and complete.exists()
                  and complete.stat().st_mtime < program.stat().st_mtime)
        if is_old:
            shutil.rmtree(path)
        if not complete.exists():
            path.mkdir(exist_ok=True)
            make(path)
            complete.touch()
    return path


def data_file(name):
    folder = pathlib.Path(os.environ.get("LIO_DATA", SOURCE.parent / "shared/data"))
    path = folder / name
    if not path.exists():
        raise unittest.SkipTest(f"{path} is not there; set LIO_DATA to the folder that has it")
    return path


def unpacked_bag(name):
    archive = data_file(f"{name}.bag.xz")

    def unpack(folder):
        with open(folder / f"{name}.bag", "wb") as bag:
            subprocess.run(["xz", "-dc", archive], stdout=bag, check=True)
    return made_once(name, unpack) / f"{name}.bag"


def kitti_drive():
    archive = data_file("kitti_raw_0005_first80.tar.xz")
    folder = made_once("kitti", lambda path: subprocess.run(
        ["tar", "-xf", archive, "-C", path], check=True))
    return next(folder.glob("kitti_raw/*/*_sync"))


def simulated(scenario="street", *words):
    """Returns a folder with the files of one run of lio-sim."""
    name = "-".join(["sim", scenario, *(word.strip("-") for word in words)])
    return made_once(name, lambda path: run_well("lio-sim", "--scenario", scenario, *words,
                                                 "--out", path))


def replay(log, out, *words):
    """Runs lio-replay into WORK/out, over an earlier run there, and returns that folder."""
    run_well("lio-replay", *words, log, "--out", WORK / out, "--overwrite")
    return WORK / out


def untimed(folder):
    """Reads registration.csv without its stage times."""
    with open(folder / "registration.csv", newline="", encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    return [{k: v for k, v in row.items() if not k.endswith("_ms")} for row in rows]


def stats(folder):
    return json.loads((folder / "stats.json").read_text())


def evaluate(truth, folder):
    """Returns lio-eval's figures for the path in a results folder: the level one when it is there,
    else, without gravity, trajectory.tum."""
    run_well("lio-eval", truth, folder, "--json", folder / "eval.json")
    return json.loads((folder / "eval.json").read_text())


def main():
    """Runs the tests; ends with 77, which ctest counts as skipped, when every test was skipped."""
    program = unittest.main(exit=False, verbosity=2, argv=sys.argv[:1])
    result = program.result
    if result.wasSuccessful() and result.testsRun and len(result.skipped) == result.testsRun:
        sys.exit(77)
    sys.exit(0 if result.wasSuccessful() else 1)
