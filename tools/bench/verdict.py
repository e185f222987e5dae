#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Replays simulated drives with right and wrong set-ups, and compares the verdicts with what was
wrong. Prints three Markdown tables: the first cause that each verdict names, how often each cause
was named for each that was right, and the position error with the wrong rig, with the fix that the
verdict proposes, and with the right rig.

  tools/bench/verdict.py [--seeds 1,2] [--drives street,campus] [--work out/verdict] [--no-fix]
                         [--no-faulty] [--keep-logs]

Ends with 1 where a first answer is wrong or a right rig is blamed. Needs tools/setup.sh, and for
each drive up to 1 GB of disk, which is given back unless the logs are kept for another time."""
import argparse
import collections
import contextlib
import json
import math
import os
import pathlib
import re
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
BIN = pathlib.Path(os.environ.get("LIO_BUILD", ROOT / "build")) / "bin"

# Name: arguments of lio-sim. The first three get every set-up, the others the right one alone.
DRIVES = {
    "street": ("--scenario", "street", "--lidar", "hdl32e", "--duration", "50"),
    "campus": ("--scenario", "campus", "--lidar", "vlp16", "--duration", "50"),
    "loop": ("--scenario", "loop", "--lidar", "os1_64", "--duration", "60"),
    "suburb": ("--scenario", "suburb", "--lidar", "vlp16", "--imu", "consumer_mems",
               "--duration", "40"),
    "motorway": ("--scenario", "motorway", "--lidar", "os1_64", "--duration", "30"),
    "tunnel": ("--scenario", "tunnel", "--lidar", "vlp16", "--duration", "40"),
    "garage": ("--scenario", "garage", "--lidar", "vlp16", "--duration", "40"),
    "hall": ("--scenario", "hall", "--lidar", "os1_64", "--duration", "20"),
    "parked": ("--scenario", "parked", "--lidar", "vlp16", "--duration", "30"),
    "moving start": ("--scenario", "loop", "--lidar", "vlp16", "--duration", "40",
                     "--moving-start"),
}
WITH_EVERY_SETUP = ("street", "campus", "loop")
# Logs with a fault of their own: the simulator's fault and the cause that is right.
FAULTY = {
    "no scans from 10 s on": ("lidar_gap:start=10,duration=100", "no_scans"),
    "no IMU at all": ("imu_gap:start=0,duration=100", "no_imu"),
    "each inertial sample twice": ("duplicate:channel=imu,ratio=1", "two_senders"),
    "gyro at its limit": ("gyro_saturation:limit=0.1,start=5,duration=30", "saturation"),
    "lidar's clock 25 ms off": ("clock_offset:channel=lidar,offset=0.025", "clock_offset"),
}


def multiply(a, b):
    w, x, y, z = a
    return (w * b[0] - x * b[1] - y * b[2] - z * b[3], w * b[1] + x * b[0] + y * b[3] - z * b[2],
            w * b[2] - x * b[3] + y * b[0] + z * b[1], w * b[3] + x * b[2] - y * b[1] + z * b[0])


def turned(vector, q):
    w, x, y, z = multiply(multiply(q, (0.0, *vector)), (q[0], -q[1], -q[2], -q[3]))
    return [x, y, z]


def turn(axis, degrees):
    half = math.radians(degrees) / 2
    return (math.cos(half), *(math.sin(half) * a for a in axis))


def extrinsic(translation, rotation):
    return (f"rig: {{T_imu_lidar: {{translation_m: {[float(x) for x in translation]}, "
            f"rotation_wxyz: {[float(x) for x in rotation]}}}}}\n")


def moved(x, y, z):
    return lambda t, q: extrinsic([t[0] + x, t[1] + y, t[2] + z], q)


def rotated(axis, degrees):
    return lambda t, q: extrinsic(t, multiply(turn(axis, degrees), q))


def inverted(t, q):
    inverse = (q[0], -q[1], -q[2], -q[3])
    return extrinsic([-x for x in turned(t, inverse)], inverse)


def entry(text):
    return lambda t, q: f"rig: {{{text}}}\n"


# Name: the configuration that is laid over the right one, and the cause that is right.
SETUPS = {
    "right": (lambda t, q: "{}\n", None),
    "yaw 5 deg": (rotated((0, 0, 1), 5), "extrinsic_rotation"),
    "pitch 5 deg": (rotated((0, 1, 0), 5), "extrinsic_rotation"),
    "roll 5 deg": (rotated((1, 0, 0), 5), "extrinsic_rotation"),
    "yaw 90 deg": (rotated((0, 0, 1), 90), "extrinsic_rotation"),
    "x 1 m": (moved(1, 0, 0), "lever_arm"),
    "y 1 m": (moved(0, 1, 0), "lever_arm"),
    "z 1 m": (moved(0, 0, 1), "lever_arm"),
    "x 0.3 m": (moved(0.3, 0, 0), "lever_arm"),
    "inverted": (inverted, "extrinsic_inverted"),
    "clock +25 ms": (entry("lidar: {clock_offset_s: 0.025}"), "clock_offset"),
    "clock -25 ms": (entry("lidar: {clock_offset_s: -0.025}"), "clock_offset"),
    "units: g": (entry("imu: {units: g}"), "imu_units"),
    "units: deg": (entry("imu: {units: deg}"), "imu_units"),
    "gravity: removed": (entry("imu: {gravity: removed}"), "imu_gravity"),
}


def run(program, *words, may_end_with=(0,)):
    done = subprocess.run([str(BIN / program), *map(str, words)], stdin=subprocess.DEVNULL,
                          capture_output=True, text=True, check=False)
    if done.returncode not in may_end_with:
        raise RuntimeError(f"{program} {words} ended with {done.returncode}: {done.stderr}")
    return done


def simulate(words, folder):
    if not (folder / "complete").exists():
        shutil.rmtree(folder, ignore_errors=True)
        run("lio-sim", *words, "--threads", os.cpu_count(), "--out", folder)
        (folder / "complete").touch()


def read_extrinsic(folder):
    text = (folder / "config.yaml").read_text()

    def numbers(key):
        return [float(x) for x in re.search(key + r": \[([^]]*)\]", text)[1].split(",")]
    return numbers("translation_m"), numbers("rotation_wxyz")


def judged(folder, overlays):
    """The verdict and the exit code of a replay with these texts laid over the configuration."""
    words = ["--config", folder / "config.yaml"]
    for number, text in enumerate(overlays):
        path = folder / f"overlay{number}.yaml"
        path.write_text(text)
        words += ["--config", path]
    out = folder / "run"
    shutil.rmtree(out, ignore_errors=True)
    done = run("lio-replay", *words, folder / "log.lcm", "--out", out, may_end_with=(0, 3, 6))
    return json.loads((out / "verdict.json").read_text()), done.returncode


def position_error_m(folder):
    path = folder / "eval.json"
    path.unlink(missing_ok=True)
    run("lio-eval", folder / "truth.tum", folder / "run/trajectory_level.tum", "--json", path,
        may_end_with=(0, 5))
    return json.loads(path.read_text())["ape"]["position_m"]["rmse"] if path.exists() else None


def first_of(verdict):
    return verdict["causes"][0]["kind"] if verdict["causes"] else None


def is_right(verdict, expected):
    if expected is None:
        return verdict["trust"] == "yes" and first_of(verdict) in (None, "no_motion")
    return verdict["trust"] != "yes" and first_of(verdict) == expected


def cell(verdict, code, expected):
    text = first_of(verdict) or "-"
    if verdict["causes"] and verdict["causes"][0]["sigma"]:
        text += f" {verdict['causes'][0]['sigma']:.0f}"
    wrong = "" if is_right(verdict, expected) else "WRONG: "
    return f"{wrong}{text}, {verdict['trust']}, {code}"


def centimetres(error_m):
    return "-" if error_m is None else f"{100 * error_m:.1f}"


class Matrix:
    """The table as it grows: a row a set-up, a column a drive."""

    def __init__(self, gives_errors):
        self.gives_errors = gives_errors
        self.verdicts, self.errors = {}, {}
        self.num_right = self.num_wrong = 0
        self.counts = collections.Counter()  # key: (right cause, first cause)

    def add(self, folder, setup, column, expected):
        overlay = SETUPS[setup][0](*read_extrinsic(folder)) if setup in SETUPS else "{}\n"
        verdict, code = judged(folder, [overlay])
        right = is_right(verdict, expected)
        self.num_right += right
        self.num_wrong += not right
        self.counts[expected or "none", first_of(verdict) or "none"] += 1
        self.verdicts.setdefault(setup, {})[column] = cell(verdict, code, expected)
        print(f"{column}, {setup}: {self.verdicts[setup][column]}", file=sys.stderr, flush=True)
        if self.gives_errors:
            self.add_errors(folder, setup, column, overlay, verdict)

    def add_errors(self, folder, setup, column, overlay, verdict):
        errors = [centimetres(position_error_m(folder))]
        fixes = [cause["fix"] for cause in verdict["causes"][:1] if cause["fix"]]
        if fixes:
            judged(folder, [overlay, *fixes])
            errors.append(centimetres(position_error_m(folder)))
        self.errors.setdefault(setup, {})[column] = " -> ".join(errors)

    def confusion(self):
        """A row for each cause that is right, a column for each that was named first."""
        kinds = list(dict.fromkeys(kind for pair in self.counts for kind in pair))
        lines = ["| right | " + " | ".join(kinds) + " |", "|---" * (len(kinds) + 1) + "|"]
        for right in kinds:
            cells = [str(self.counts[right, named] or "") for named in kinds]
            if any(cells):
                lines.append(f"| {right} | " + " | ".join(cells) + " |")
        return "\n".join(lines)

    def markdown(self, rows):
        columns = list(dict.fromkeys(column for row in rows.values() for column in row))
        lines = ["| set-up | " + " | ".join(columns) + " |", "|---" * (len(columns) + 1) + "|"]
        for setup, row in rows.items():
            cells = [row.get(column, "") for column in columns]
            lines.append(f"| {setup} | " + " | ".join(cells) + " |")
        return "\n".join(lines)


def arguments():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seeds", default="1")
    parser.add_argument("--drives", default=",".join(DRIVES))
    parser.add_argument("--work", type=pathlib.Path, default=ROOT / "out/verdict")
    parser.add_argument("--no-fix", action="store_true")
    parser.add_argument("--no-faulty", action="store_true")
    parser.add_argument("--keep-logs", action="store_true")
    return parser.parse_args()


@contextlib.contextmanager
def simulated(given, name, *words):
    folder = given.work / name.replace(" ", "-")
    simulate(words, folder)
    yield folder
    shutil.rmtree(folder / "run", ignore_errors=True)
    if not given.keep_logs:
        shutil.rmtree(folder)


def fill(given, matrix):
    for seed in given.seeds.split(","):
        for drive in given.drives.split(","):
            setups = SETUPS if drive in WITH_EVERY_SETUP else ("right",)
            with simulated(given, f"{drive}-{seed}", *DRIVES[drive], "--seed", seed) as folder:
                for setup in setups:
                    matrix.add(folder, setup, f"{drive} {seed}", SETUPS[setup][1])
        for fault, (text, expected) in ({} if given.no_faulty else FAULTY).items():
            with simulated(given, f"{fault}-{seed}", *DRIVES["campus"], "--seed", seed, "--fault",
                           text) as folder:
                matrix.add(folder, fault, f"campus {seed}", expected)


def main():
    given = arguments()
    matrix = Matrix(not given.no_fix)
    fill(given, matrix)
    print(matrix.markdown(matrix.verdicts))
    print("\n" + matrix.confusion())
    if matrix.gives_errors:
        print("\n" + matrix.markdown(matrix.errors))
    print(f"\nfirst answer right in {matrix.num_right} of {matrix.num_right + matrix.num_wrong}")
    return 1 if matrix.num_wrong else 0


if __name__ == "__main__":
    sys.exit(main())
