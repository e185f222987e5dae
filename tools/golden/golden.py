# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Replays the cases of cases.py and compares hashes of the results with the recorded ones."""
import argparse
import concurrent.futures
import csv
import hashlib
import json
import os
import pathlib
import shlex
import shutil
import subprocess
import sys

from cases import CASES

BUILD = pathlib.Path(os.environ.get("LIO_BUILD", "build"))
DATA = pathlib.Path(os.environ.get("LIO_DATA", "../shared/data"))
RECORD = pathlib.Path("test/golden/hashes.tsv")
WORK = pathlib.Path("out/golden")
# The C library's mathematics is the same on every processor without these.
ENVIRONMENT = dict(os.environ, GLIBC_TUNABLES="glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4")
TRAJECTORIES = ("trajectory.tum", "trajectory_world.tum", "trajectory_imu_rate.tum")
COVARIANCES = ("covariance.csv", "covariance_world.csv")
# These columns are no part of the registration's hash: searches may be cut differently.
COUNT_OF_MATCHES = "matches"
COUNTS_OF_MATCHES = (COUNT_OF_MATCHES, "coarse_matches")
COLUMNS = ("case", "log", "exit", "trajectory", "covariance", "registration", "counters", "matches")


def digest(*parts):
    return hashlib.sha256(b"\0".join(parts)).hexdigest()[:12]


def run(*words):
    return subprocess.run([str(word) for word in words], stdin=subprocess.DEVNULL, check=False,
                          capture_output=True, text=True, env=ENVIRONMENT)


def run_well(*words):
    done = run(*words)
    if done.returncode != 0:
        raise RuntimeError(f"{shlex.join(done.args)} ended with {done.returncode}: {done.stderr}")


def unpack(archive, folder):
    if archive.endswith(".tar.xz"):
        run_well("tar", "-xf", DATA / archive, "-C", folder)
        return next(folder.glob("kitti_raw/*/*_sync"))
    bag = folder / archive.removesuffix(".xz")
    with open(bag, "wb") as stream:
        subprocess.run(["xz", "-dc", DATA / archive], stdout=stream, check=True)
    return bag


def make_log(case, folder):
    if case.sim:
        run_well(BUILD / "bin/lio-sim", *case.sim, "--out", folder)
        return
    source = unpack(case.real, folder)
    kind = "kitti-raw" if source.is_dir() else "rosbag"
    run_well(BUILD / "bin/lio-convert", kind, source, folder / "log.lcm")
    shutil.rmtree(folder / "kitti_raw", ignore_errors=True)
    shutil.copy(case.config, folder / "config.yaml")


def log_folder(case):
    """Made once; the cases that replay it share it."""
    name = digest(repr((case.sim, case.real, case.config)).encode())
    folder = WORK / "logs" / name
    if not (folder / "complete").exists():
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        make_log(case, folder)
        (folder / "complete").write_text(file_digest(folder / "log.lcm"))
    return folder


def file_digest(path):
    with open(path, "rb") as stream:
        return hashlib.file_digest(stream, "sha256").hexdigest()[:12]


def rows_of(path):
    """registration.csv without its times of computing, and the counts of matches."""
    if not path.exists():
        return b"absent", b"absent"
    with open(path, newline="", encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    kept = [[value for key, value in row.items()
             if not key.endswith("_ms") and key not in COUNTS_OF_MATCHES] for row in rows]
    counts = [row.get(COUNT_OF_MATCHES, "-") for row in rows]
    return repr(kept).encode(), repr(counts).encode()


def counters_of(path):
    if not path.exists():
        return b"absent"
    stats = json.loads(path.read_text())
    return repr(sorted((key, value) for key, value in stats.items()
                       if key.startswith("num_"))).encode()


def replay(case):
    log = log_folder(case)
    out = WORK / "runs" / case.name
    shutil.rmtree(out, ignore_errors=True)
    words = [BUILD / "bin/lio-replay", "--config", log / "config.yaml", *case.replay]
    if case.lag:
        words += ["--match-lag", case.lag]
    done = run(*words, log / "log.lcm", "--out", out)
    (WORK / "runs" / f"{case.name}.stderr").write_text(done.stderr)

    def hash_of(names):
        return digest(*((out / name).read_bytes() if (out / name).exists() else b"absent"
                        for name in names))
    registration, matches = rows_of(out / "registration.csv")
    return {"case": case.name, "log": (log / "complete").read_text(), "exit": str(done.returncode),
            "trajectory": hash_of(TRAJECTORIES), "covariance": hash_of(COVARIANCES),
            "registration": digest(registration), "matches": digest(matches),
            "counters": digest(counters_of(out / "stats.json"))}


def read_record():
    if not RECORD.exists():
        return {}
    with open(RECORD, newline="", encoding="utf-8") as stream:
        return {row["case"]: row for row in csv.DictReader(stream, delimiter="\t")}


def write_record(rows):
    RECORD.parent.mkdir(parents=True, exist_ok=True)
    with open(RECORD, "w", newline="", encoding="utf-8") as stream:
        writer = csv.DictWriter(stream, COLUMNS, delimiter="\t", lineterminator="\n",
                                extrasaction="ignore")
        writer.writeheader()
        writer.writerows(rows)


def verdict(found, recorded):
    """Gives the line on a case, and whether it is as recorded; None where it cannot be compared."""
    if recorded is None:
        return "NEW: not recorded yet", False
    if found["log"] != recorded["log"]:
        return "skipped: the log differs from the recorded one (simulator, data or processor)", None
    differing = [column for column in COLUMNS[2:] if found[column] != recorded[column]]
    if differing:
        return f"DIFFERS: {', '.join(differing)}", False
    return "same", True


def arguments():
    parser = argparse.ArgumentParser(prog="tools/golden.sh", add_help=False)
    parser.add_argument("--update", action="store_true")
    parser.add_argument("--list", action="store_true")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("cases", nargs="*", choices=[[], *(case.name for case in CASES)])
    return parser.parse_args()


def chosen(names):
    cases = [case for case in CASES if not names or case.name in names]
    there = [case for case in cases if not case.real or (DATA / case.real).exists()]
    for case in cases:
        if case not in there:
            print(f"{case.name:24} skipped: {DATA / case.real} is not there; set LIO_DATA")
    return there


def exit_code(verdicts):
    """A run passes only where something was compared: see usage."""
    if verdicts.count(False):
        return 1
    if verdicts.count(True):
        return 0
    print(f"golden: nothing was compared, so nothing is proved: run this where {RECORD} was "
          "recorded, or record this machine's logs by --update before your change", file=sys.stderr)
    return 3


def main():
    given = arguments()
    if given.list:
        for case in CASES:
            source = shlex.join(["lio-sim", *case.sim]) if case.sim else case.real
            lag = ("--match-lag", str(case.lag)) if case.lag else ()
            print(f"{case.name:24} {source}  |  {shlex.join(['lio-replay', *case.replay, *lag])}")
        return 0
    cases = chosen(given.cases)
    record = read_record()
    with concurrent.futures.ThreadPoolExecutor(given.jobs) as pool:
        distinct = {(case.sim, case.real): case for case in cases}.values()
        list(pool.map(log_folder, distinct))
        results = []
        for found in pool.map(replay, cases):
            text, _ = verdict(found, record.get(found["case"]))
            print(f"{found['case']:24} {text}", flush=True)
            results.append(found)
    verdicts = [verdict(found, record.get(found["case"]))[1] for found in results]
    num_same, num_skipped = verdicts.count(True), verdicts.count(None)
    num_other = len(verdicts) - num_same - num_skipped
    print(f"golden: {num_same} the same, {num_other} different, {num_skipped} not compared")
    if given.update:
        record |= {found["case"]: found for found in results}
        write_record([record[case.name] for case in CASES if case.name in record])
        print(f"golden: recorded in {RECORD}; look at its diff before you commit it")
        return 0
    return exit_code(verdicts)


if __name__ == "__main__":
    sys.exit(main())
