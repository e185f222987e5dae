# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Makes a drive ready for all its runs: simulates or converts it, or links its log. See prepare().

    prepare_drive.py DRIVE    in the fleet's folder
"""
import pathlib
import shutil
import sys

import plan
import steps

LCM_MAGIC = b"\xed\xa1\xda\x01"


def simulate(key, work, log):
    words = [key["program"], *key["sim"], "--seed", key["seed"], "--out", work]
    words += ["--scans", f"drives/{key['scans']['name']}/log.lcm"] if key["scans"] else []
    done = steps.call(words, log)
    if (work / "config.yaml").exists():
        (work / "config.yaml").rename(work / "rig.yaml")
        (work / "truth_states.csv").unlink(missing_ok=True)
    # lio-sim has no exit code of its own for an impossible drive; 2 is a fault of the words.
    done["exit"] = steps.INPUT if done["exit"] == 2 else done["exit"]
    return done


def is_log(path):
    with open(path, "rb") as stream:
        return stream.read(4) == LCM_MAGIC


def find_log(given):
    """The LCM log that an input is or holds, else None: such a one needs no conversion."""
    if (given / "log.lcm").is_file():
        return given / "log.lcm"
    return given if given.is_file() and is_log(given) else None


def truth_beside(log):
    """As lio-run looks for it: drive.gt.tum, drive.tum, truth.tum."""
    for name in (f"{log.stem}.gt.tum", f"{log.stem}.tum", "truth.tum"):
        if (log.parent / name).is_file():
            return log.parent / name
    return None


def link(log, work):
    (work / "log.lcm").symlink_to(log)
    for found, name in ((truth_beside(log), "truth.tum"), (log.parent / "config.yaml", "rig.yaml")):
        if found and found.is_file():
            shutil.copyfile(found, work / name)
    return {"exit": steps.DONE, "wall_s": 0.0, "cpu_s": 0.0, "said": "", "program": "link"}


def convert(key, work, log):
    """Lets lio-run convert and draft the rig; the first second of its run is thrown away."""
    out = work / "converted"
    words = [key["program"], key["input"], "--out", out, "--duration", "1", *key["words"]]
    words += ["--truth", key["truth"]] if key["truth"] else []
    done = steps.call(words, log)
    for name, kept in (("log.lcm", "log.lcm"), ("truth.tum", "truth.tum"),
                       ("rig_draft.yaml", "rig.yaml"), ("conversion.txt", "conversion.txt")):
        if (out / name).exists():
            (out / name).rename(work / kept)
    if not key["truth"] and not (work / "truth.tum").exists():
        beside = truth_beside(pathlib.Path(key["input"]))
        if beside:
            shutil.copyfile(beside, work / "truth.tum")
    shutil.rmtree(out, ignore_errors=True)
    return done


def prepare(key, work):
    """Leaves log.lcm, and as far as they are known truth.tum and rig.yaml, in the folder."""
    log = work / "prepare.txt"
    if key["sim"]:
        done = simulate(key, work, log)
    else:
        found = find_log(pathlib.Path(key["input"]))
        done = link(found, work) if found else convert(key, work, log)
    steps.stop_unless_final(done, log)
    for name, kept in (("truth", "truth.tum"), ("rig", "rig.yaml")):
        if key[name]:
            shutil.copyfile(key[name], work / kept)
    done["usable"] = (work / "log.lcm").exists()
    if not done["usable"]:
        (work / "log.lcm").touch()
    return done


def main():
    steps.die_with_parent()
    name = sys.argv[1]
    key = steps.read_json(f"keys/drives/{name}.json")
    # A drive that is made once has a program's name alone, so that any build's is good.
    key["program"] = plan.program("", key["program"])
    with steps.replaced(pathlib.Path("drives") / name) as work:
        steps.write_json(work / "drive.json", prepare(key, work))


if __name__ == "__main__":
    main()
