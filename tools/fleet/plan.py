# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Writes what the workflow reads: plan.json, and a key file for each drive and each run. A key
holds all that its result depends on, and is written only when it changes, so that its time tells
Snakemake what to make anew."""
import dataclasses
import functools
import hashlib
import json
import os
import pathlib
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[2]
HERE = pathlib.Path(__file__).resolve().parent


def default_build():
    return os.environ.get("LIO_BUILD", str(ROOT / "build"))


@functools.lru_cache(maxsize=None)
def digest(path):
    """The sum of a file's content; of a folder or a large file that of names, sizes, times."""
    path = pathlib.Path(path)
    summed = hashlib.sha256()
    if path.is_file() and path.stat().st_size < 64 << 20:
        summed.update(path.read_bytes())
    else:
        for file in sorted(path.rglob("*")) if path.is_dir() else [path]:
            if file.is_file():
                stat = file.stat()
                summed.update(f"{file} {stat.st_size} {stat.st_mtime_ns}\n".encode())
    return summed.hexdigest()[:16]


def program(build, name):
    return str(pathlib.Path(build or default_build()).resolve() / "bin" / name)


def programs(build, *names):
    return {name: digest(program(build, name)) for name in names}


def drive_key(fleet, drive):
    name = "lio-sim" if drive.sim else "lio-run"
    key = dataclasses.asdict(drive) | {"program": name, "digests": {}}
    if not drive.once:
        key |= {"program": program("", name), "digests": programs("", name)}
    if drive.sim:
        files = {word: digest(word) for word in drive.sim if pathlib.Path(word).is_file()}
        key["digests"] |= {"sensors": sensors_digest()} | files
    if drive.scans:
        key["scans"] = drive_key(fleet, fleet.by_name[drive.scans])
    for name in ("input", "truth", "rig"):
        if key[name]:
            key["digests"][name] = digest(key[name])
    for name in ("group", "keep", "place"):  # no result depends on them
        del key[name]
    return key


@functools.lru_cache(maxsize=None)
def sensors_digest():
    files = sorted((ROOT / "config").glob("lidars/*")) + sorted((ROOT / "config").glob("imus/*"))
    return hashlib.sha256("".join(digest(file) for file in files).encode()).hexdigest()[:16]


ROW_VERSION = 2  # a higher one makes all rows anew, when their figures change


def run_key(fleet, drive, configuration):
    build = configuration.build
    # Only lio-run's results are scored.
    used = [configuration.program] + ["lio-eval"] * (configuration.program == "lio-run")
    return {"version": ROW_VERSION, "drive": drive_key(fleet, drive),
            "configuration": configuration.name, "config": configuration.config,
            "set": configuration.set, "words": configuration.words,
            "threads": configuration.threads, "program": configuration.program,
            "keep_map": "maps" in fleet.keep,
            "programs": {name: program(build, name) for name in used},
            "digests": programs(build, *used) |
            {file: digest(file) for file in configuration.config}}


def peer_key(fleet, drive, peer):
    file = peer.files.get(drive.name, "")
    return {"version": ROW_VERSION, "drive": drive_key(fleet, drive), "peer": peer.name,
            "file": file, "words": peer.words,
            "programs": {"lio-eval": program("", "lio-eval")},
            "digests": programs("", "lio-eval") | ({"file": digest(file)} if file else {})}


def write_if_changed(path, content):
    text = json.dumps(content, indent=1) + "\n"
    if not path.exists() or path.read_text(encoding="utf-8") != text:
        path.parent.mkdir(parents=True, exist_ok=True)
        partial = path.with_name(path.name + ".part")
        partial.write_text(text, encoding="utf-8")
        os.replace(partial, path)


def key_sum(key):
    return hashlib.sha256(json.dumps(key).encode()).hexdigest()[:16]


def check_programs(fleet):
    """The faults of builds: a program that is missing."""
    builds = {configuration.build for configuration in fleet.configurations} | {""}
    needed = ["lio-run", "lio-eval", "lio-replay"]
    needed += ["lio-sim"] if any(drive.sim for drive in fleet.drives) else []
    for build in sorted(builds):
        for name in needed:
            if not os.access(program(build, name), os.X_OK):
                yield (f"{program(build, name)}: is not there; run tools/setup.sh, or set "
                       "LIO_BUILD to the folder of a build")


def check_options(fleet):
    """The words of lio-replay against a configuration, but for what only a rig can give."""
    for configuration in fleet.configurations:
        words = [word for file in configuration.config for word in ("--config", file)]
        words += [word for setting in configuration.set for word in ("--set", setting)]
        done = subprocess.run([program(configuration.build, "lio-replay"), *words,
                               "--print-options"], stdin=subprocess.DEVNULL, capture_output=True,
                              text=True, check=False)
        for line in done.stderr.splitlines():
            said = line.removeprefix("lio-replay: ")
            if done.returncode and not said.startswith("configuration: rig."):
                yield f"{configuration.place}: configuration {configuration.name}: {said}"


def check_scenarios(fleet):
    if not any(drive.sim for drive in fleet.drives):
        return
    listed = subprocess.run([program("", "lio-sim"), "--list"], capture_output=True, text=True,
                            check=False).stdout.split()
    for place, group, sim in sorted({(drive.place, drive.group, drive.sim)
                                     for drive in fleet.drives if drive.sim}):
        words = " ".join(sim).replace("=", " ").split()
        if "--scenario" in words[:-1]:
            scenario = words[words.index("--scenario") + 1]
            if scenario not in listed:
                yield (f"{place}: drive {group}: lio-sim knows no scenario {scenario}; "
                       "see lio-sim --list")


def plan_run(fleet, drive, system, out):
    """Writes the run's key file; returns its part of the plan."""
    if system in fleet.peers:
        key, kind, threads = peer_key(fleet, drive, system), "peer", 1
    else:
        key, threads = run_key(fleet, drive, system), system.threads
        kind = "liod" if system.program == "lio-run" else "replay"
    write_if_changed(out / f"keys/runs/{system.name}/{drive.name}.json", key)
    return {"drive": drive.name, "group": drive.group, "seed": drive.seed, "system": system.name,
            "kind": kind, "threads": threads, "key": key_sum(key)}


def write_plan(fleet, out):
    """Fills OUT/keys and OUT/plan.json."""
    runs, systems = [], (*fleet.configurations, *fleet.peers)
    for drive in fleet.drives:
        write_if_changed(out / f"keys/drives/{drive.name}.json", drive_key(fleet, drive))
        runs += [plan_run(fleet, drive, system, out) for system in systems if system.runs_on(drive)]
    plan = {"baseline": fleet.baseline, "runs": runs,
            "kept_logs": [drive.name for drive in fleet.drives if fleet.keeps_log(drive)],
            "scans": {drive.name: drive.scans for drive in fleet.drives if drive.scans},
            "systems": [system.name for system in systems],
            "page": key_sum([digest(HERE / name) for name in sorted(os.listdir(HERE))
                             if (HERE / name).is_file()])}
    write_if_changed(out / "plan.json", plan)
