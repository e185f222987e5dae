# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Replays the cases of cases.py and compares hashes of the results with the recorded ones."""
import argparse
import csv
import hashlib
import json
import os
import pathlib
import shlex
import subprocess
import sys
import tempfile

from cases import CASES

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "bench"))
from fleet_runs import run_fleet  # noqa: E402

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
LOGS, WAYS = {}, {}  # the name of each log's drive, and of each way's configuration
for _case in CASES:
    LOGS.setdefault(_case.log, _case.name)
    WAYS.setdefault(_case.way, _case.name)
COLUMNS = ("case", "log", "exit", "trajectory", "covariance", "registration", "counters", "matches")


def digest(*parts):
    return hashlib.sha256(b"\0".join(parts)).hexdigest()[:12]


def unpack(archive, folder):
    """Returns the recording and its kind, as lio-convert calls it."""
    if archive.name.endswith(".tar.xz"):
        subprocess.run(["tar", "-xf", archive, "-C", folder], check=True)
        return next(folder.glob("kitti_raw/*/*_sync")), "kitti-raw"
    with open(folder / archive.stem, "wb") as stream:
        subprocess.run(["xz", "-dc", archive], stdout=stream, check=True)
    return folder / archive.stem, "rosbag"


def converted(name):
    """The log of a recording of the shared data, which is made once."""
    log = WORK.resolve() / f"recordings/{name}.lcm"
    if not log.exists():
        log.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(dir=log.parent) as folder:
            source, kind = unpack(DATA / name, pathlib.Path(folder))
            part = pathlib.Path(folder) / "log.lcm"
            subprocess.run([BUILD / "bin/lio-convert", kind, source, part], check=True,
                           env=ENVIRONMENT, stdout=subprocess.DEVNULL)
            part.rename(log)
    return str(log)


def drive_of(case):
    drive = {"name": LOGS[case.log], "once": "yes"}
    if case.sim:
        return drive | {"sim": case.sim}
    return drive | {"input": converted(case.real), "rig": str(pathlib.Path(case.config).resolve())}


def drive_name(case):
    return LOGS[case.log] + "-1" * bool(case.sim)  # the fleet puts the seed behind the name


def fleet_of(cases):
    drives, configurations = {}, {}
    for case in cases:
        words, threads = case.way
        drives.setdefault(case.log, drive_of(case))
        one = configurations.setdefault(case.way, {
            "name": WAYS[case.way], "program": "lio-replay", "words": words,
            "threads": str(threads), "drives": []})
        one["drives"].append(drive_name(case))
    return {"drives": list(drives.values()), "configurations": list(configurations.values()),
            "keep": "logs"}


def log_digest(drive):
    """The sum of the drive's log, which is noted in its folder, since logs are large."""
    noted = drive / "log.digest"
    if not noted.exists():
        with open(drive / "log.lcm", "rb") as stream:
            noted.write_text(hashlib.file_digest(stream, "sha256").hexdigest()[:12])
    return noted.read_text()


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


def result_of(case):
    drive = WORK / "drives" / drive_name(case)
    out = WORK / "runs" / WAYS[case.way] / drive.name

    def hash_of(names):
        return digest(*((out / name).read_bytes() if (out / name).exists() else b"absent"
                        for name in names))
    registration, matches = rows_of(out / "registration.csv")
    code = json.loads((out / "row.json").read_text()).get("exit", "none")
    return {"case": case.name, "log": log_digest(drive), "exit": str(code),
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
            words, threads = case.way
            print(f"{case.name:24} {source}  |  "
                  f"{shlex.join(['lio-replay', '--threads', str(threads), *words])}")
        return 0
    cases = chosen(given.cases)
    record = read_record()
    code = run_fleet(fleet_of(cases), WORK, given.jobs, ENVIRONMENT) if cases else 0
    if code != 0:
        print("golden: the fleet has not finished, so nothing is compared", file=sys.stderr)
        return max(code, 1)
    verdicts, results = [], {case.name: result_of(case) for case in cases}
    for name, found in results.items():
        text, is_same = verdict(found, record.get(name))
        print(f"{name:24} {text}")
        verdicts.append(is_same)
    num_same, num_skipped = verdicts.count(True), verdicts.count(None)
    num_other = len(verdicts) - num_same - num_skipped
    print(f"golden: {num_same} the same, {num_other} different, {num_skipped} not compared")
    if given.update:
        record |= results
        write_record([record[case.name] for case in CASES if case.name in record])
        print(f"golden: recorded in {RECORD}; look at its diff before you commit it")
        return 0
    return exit_code(verdicts)


if __name__ == "__main__":
    sys.exit(main())
