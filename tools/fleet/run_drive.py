# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Runs one configuration over one drive, or scores a peer's trajectory of it, and leaves the run's
folder with row.json.

    run_drive.py SYSTEM DRIVE    in the fleet's folder
"""
import pathlib
import sys

import plan
import rows
import steps


OPTIONS = {"lio-run": (("--rig", "rig.yaml"), ("--truth", "truth.tum")),
           "lio-replay": (("--config", "rig.yaml"),)}


def run_words(key, drive, out):
    words = [key["programs"][key["program"]], drive / "log.lcm", "--out", out, "--overwrite",
             "--threads", key["threads"], *key["words"]]
    for option, name in OPTIONS[key["program"]]:
        words += [option, drive / name] if (drive / name).exists() else []
    words += [word for file in key["config"] for word in ("--config", file)]
    return words + [word for setting in key["set"] for word in ("--set", setting)]


def score(key, truth, out, log):
    """Adds to lio-run's eval.json of the level path that of the path as it was published, and how
    true the covariance is; the truth lies beside them for programs that score a run's folder."""
    for words in (("consistency", truth, out, "--json", out / "consistency.json"),
                  (truth, out / "trajectory.tum", "--json", out / "eval_published.json")):
        judged = steps.call([key["programs"]["lio-eval"], *words], log)
        if judged["exit"] < 0:
            steps.stop_unless_final(judged, log)
    (out / "truth.tum").symlink_to(f"../../../{truth}")


def why_unscored(key, truth):
    if key["program"] == "lio-replay":
        return "not scored"
    return "" if truth.exists() else "no truth"


def run_ours(key, drive, work):
    out, log, truth = work / "run", work / "run.txt", drive / "truth.tum"
    done = steps.call(run_words(key, drive, out), log)
    steps.stop_unless_final(done, log)
    unscored = why_unscored(key, truth)
    if not unscored and (out / "trajectory.tum").exists():
        score(key, truth, out, log)
    if not key["keep_map"]:
        (out / "map.pcd").unlink(missing_ok=True)
    for file in out.iterdir() if out.is_dir() else ():
        file.rename(work / file.name)
    if out.is_dir():
        out.rmdir()
    return rows.row_of_run(work, done, unscored)


def score_peer(key, drive, work):
    if not key["file"]:
        return rows.empty_row("absent", "the peer has no file for this drive")
    if not (drive / "truth.tum").exists():
        return rows.empty_row("no truth", "the drive has no truth")
    log = work / "run.txt"
    done = steps.call([key["programs"]["lio-eval"], drive / "truth.tum", key["file"], *key["words"],
                       "--json", work / "eval.json"], log)
    done["exit"] = steps.INPUT if done["exit"] == 2 else done["exit"]
    steps.stop_unless_final(done, log)
    return rows.row_of_peer(work, done)


def main():
    steps.die_with_parent()
    system, name = sys.argv[1:]
    key = steps.read_json(f"keys/runs/{system}/{name}.json")
    drive = pathlib.Path("drives") / name
    prepared = steps.read_json(drive / "drive.json")
    with steps.replaced(pathlib.Path("runs") / system / name) as work:
        if not prepared["usable"]:
            row = rows.empty_row("failed", f"{prepared['program']}: {prepared['said']}")
        elif "peer" in key:
            row = score_peer(key, drive, work)
        else:
            row = run_ours(key, drive, work)
        steps.write_json(work / "row.json", {"key": plan.key_sum(key), **row})


if __name__ == "__main__":
    main()
