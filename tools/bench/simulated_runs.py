# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Simulates, replays and scores drives for the other scripts of this folder; results are kept, so
that an interrupted measurement goes on where it was. Needs tools/setup.sh."""
import dataclasses
import json
import os
import pathlib
import shutil
import statistics
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[2]
BIN = pathlib.Path(os.environ.get("LIO_BUILD", ROOT / "build")) / "bin"


@dataclasses.dataclass(frozen=True)
class Drive:
    scenario: str
    lidar: str
    seed: int
    duration_s: int = 60

    @property
    def name(self):
        return f"{self.scenario}-{self.lidar}-{self.seed}"

    def words(self):
        return ("--scenario", self.scenario, "--lidar", self.lidar, "--seed", str(self.seed),
                "--duration", str(self.duration_s))


def call(*words):
    done = subprocess.run([str(word) for word in words], stdin=subprocess.DEVNULL, check=False,
                          capture_output=True, text=True)
    if done.returncode not in (0, 6):  # 6: done, but not to be trusted
        raise RuntimeError(f"{' '.join(done.args)} ended with {done.returncode}: {done.stderr}")
    return done


def simulate(drive, folder, *words):
    """Writes the log into the folder, unless it is there."""
    asked = " ".join(str(word) for word in (*drive.words(), *words))
    complete = folder / "complete"
    if complete.exists() and complete.read_text() == asked:
        return
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    call(BIN / "lio-sim", *drive.words(), *words, "--out", folder)
    complete.write_text(asked)


def nees(folder, frame=""):
    """NEES per degree of freedom of the path in map, or of the `frame` world or level."""
    out = folder / f"nees_{frame or 'map'}.json"
    call(BIN / "lio-eval", "consistency", *((f"--{frame}",) if frame else ()), "truth.tum", folder,
         "--json", out)
    return json.loads(out.read_text())["runs"][0]["nees_pose_per_dof"]


def replay(folder, *settings):
    """Returns ATE [m] of the level path (of the path in map where nothing is level), and NEES per
    degree of freedom of the path in map, of the level world's poses and of the level path."""
    run = folder / "run"
    shutil.rmtree(run, ignore_errors=True)
    words = [word for setting in settings for word in ("--set", setting)]
    call(BIN / "lio-replay", "--config", folder / "config.yaml", *words, folder / "log.lcm",
         "--out", run)
    shutil.copy(folder / "truth.tum", run)
    score = run / "eval.json"
    call(BIN / "lio-eval", folder / "truth.tum", run, "--json", score)
    ape = json.loads(score.read_text())["ape"]["position_m"]["rmse"]
    figures = {"ate_m": ape, "nees": nees(run), "nees_world": nees(run, "world")}
    if (run / "covariance_level.csv").exists():
        figures["nees_level"] = nees(run, "level")
    return figures


class Results:
    """Figures by name, in a file that every new one is written to at once."""

    def __init__(self, path):
        self.path = path
        path.parent.mkdir(parents=True, exist_ok=True)
        self.figures = json.loads(path.read_text()) if path.exists() else {}

    def __contains__(self, name):
        return name in self.figures

    def __getitem__(self, name):
        return self.figures[name]

    def keep(self, name, figures):
        self.figures[name] = figures
        self.path.write_text(json.dumps(self.figures, indent=1))
        print(name, *(f"{key} {value:.4g}" for key, value in figures.items()), flush=True)


def median_and_worst(values):
    """As text; a dash where nothing was measured, and one figure where only one was."""
    if not values:
        return "-"
    if len(values) == 1:
        return f"{values[0]:.2g}"
    return f"{statistics.median(values):.2g}, {max(values):.2g}"
