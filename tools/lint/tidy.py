#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Reads every source under src/ with clang-tidy, on all cores; exits 1 when it finds a fault.

It reads what the compiler reads: with LIO_UNITY a dozen sources of a folder together, which takes a
quarter of the time, else one by one. A source that passed is not read again until it, a file that
it includes or .clang-tidy changes: the build folder's own list of dependencies tells. Needs a
finished build in build/.
"""
import concurrent.futures
import json
import os
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = ROOT / "build"


def dependencies():
    """Source -> all files it was compiled from, as ninja recorded them."""
    text = subprocess.run(["ninja", "-C", BUILD, "-t", "deps"], check=True, capture_output=True,
                          text=True).stdout
    found = {}
    for block in text.split("\n\n"):
        files = [BUILD / line.strip() for line in block.splitlines()[1:]]
        if files:
            found[files[0].resolve()] = files
    return found


def compiled_sources():
    """The files of src/ that the compiler is given: our sources, or those that include them."""
    entries = json.loads((BUILD / "compile_commands.json").read_text())
    folders = (ROOT / "src", BUILD / "src")
    files = {pathlib.Path(entry["file"]) for entry in entries}
    return sorted(file for file in files if any(folder in file.parents for folder in folders))


def stamp_of(source):
    return BUILD / "tidy" / source.relative_to(ROOT).with_suffix(".ok")


def is_fresh(source, files):
    stamp = stamp_of(source)
    if not stamp.exists() or not files:
        return False
    newest = max(os.stat(file).st_mtime for file in [*files, ROOT / ".clang-tidy"])
    return newest < stamp.stat().st_mtime


def read(source):
    done = subprocess.run(["clang-tidy", "-p", BUILD, "--quiet", source], cwd=ROOT,
                          stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    if done.returncode == 0:
        stamp = stamp_of(source)
        stamp.parent.mkdir(parents=True, exist_ok=True)
        stamp.touch()
    return source, done


def main():
    files = dependencies()
    sources = compiled_sources()
    stale = [source for source in sources if not is_fresh(source, files.get(source))]
    num_faulty = 0
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as workers:
        for source, done in workers.map(read, stale):
            print(f"clang-tidy {source.relative_to(ROOT)}", flush=True)
            if done.returncode != 0:
                num_faulty += 1
                print(done.stdout, flush=True)
    print(f"clang-tidy: {len(stale)} of {len(sources)} files read, {num_faulty} with faults")
    return 1 if num_faulty else 0


if __name__ == "__main__":
    sys.exit(main())
