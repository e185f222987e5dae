# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""The body of tools/fleet.sh, whose --help tells how to use it."""
import argparse
import fcntl
import os
import pathlib
import shutil
import subprocess
import sys

import collect
import fleet_file
import plan
import steps
from say import say

DONE, UNFINISHED, USAGE, CONFIGURATION, MISSING = 0, 1, 2, 3, 4


def arguments():
    parser = argparse.ArgumentParser(prog="tools/fleet.sh", add_help=False)
    parser.add_argument("fleet", type=pathlib.Path)
    parser.add_argument("--out", type=pathlib.Path)
    parser.add_argument("--jobs", type=int, default=len(os.sched_getaffinity(0)))
    parser.add_argument("--profile")
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--dry-run", action="store_true")
    given = parser.parse_args()
    if given.jobs < 1:
        parser.error(f"--jobs {given.jobs}: at least 1 is needed")
    return given


def read_fleet(file):
    """The fleet, or None after all its faults have been told."""
    fleet, faults = fleet_file.read_fleet(file)
    if not faults:
        faults = list(plan.check_programs(fleet))
    if not faults:
        faults = [*plan.check_options(fleet), *plan.check_scenarios(fleet)]
    for fault in faults:
        say(fault)
    return None if faults else fleet


def lock(out):
    """Keeps other fleets out of the folder while this process, or Snakemake, lives."""
    stream = open(out / "lock", "w", encoding="utf-8")
    try:
        fcntl.flock(stream, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        say(f"{out}: another fleet works here; wait until it ends, or choose another --out")
        sys.exit(UNFINISHED)
    return stream


def snakemake_words(given, out):
    # A result is put in place whole by one rename, so none is ever incomplete, as Snakemake would
    # suspect of those that it had no time to note.
    words = ["snakemake", "--snakefile", plan.HERE / "Snakefile", "--directory", out,
             "--rerun-triggers", "mtime", "--ignore-incomplete", "--keep-going", "--nolock",
             "--scheduler", "greedy", "--log-handler-script", plan.HERE / "say.py"]
    if given.profile:
        words += ["--profile", pathlib.Path(given.profile).resolve(), "--jobs", given.jobs]
    else:
        words += ["--cores", given.jobs]
    words += ["--dry-run", "--quiet", "rules"] if given.dry_run else []
    return [str(word) for word in words]


def run_snakemake(given, out, held):
    """Its jobs die with it, and it with this process; a dry run speaks on stderr."""
    number = os.dup(sys.stderr.fileno())
    environment = dict(os.environ, XDG_CACHE_HOME=str(out / ".snakemake/cache"),
                       FLEET_STDERR=str(number))
    with open(out / "snakemake.txt", "w", encoding="utf-8") as words:
        stream = None if given.dry_run else words
        return subprocess.run(snakemake_words(given, out), stdin=subprocess.DEVNULL, check=False,
                              stdout=stream, stderr=stream, env=environment,
                              pass_fds=[held.fileno(), number],
                              preexec_fn=steps.die_with_parent).returncode


def sweep(out, fleet):
    """Removes what a killed fleet left: halves of results, and logs that nobody needs."""
    shutil.rmtree(out / "scratch", ignore_errors=True)
    for drive in fleet.drives:
        if not fleet.keeps_log(drive):
            (out / "drives" / drive.name / "log.lcm").unlink(missing_ok=True)


def tell_result(out, table):
    open_runs = sum(row["status"] == "unfinished" for row in table)
    failed = sum(row["status"] in ("failed", "no pose") for row in table)
    say(f"{len(table)} runs, {open_runs} unfinished, {failed} failed or without a pose")
    say(f"{out / 'index.html'} has the page, {out / 'table.tsv'} and table.json the table")
    if open_runs:
        say("the messages above name what went wrong; the same command does only what is open")
    return UNFINISHED if open_runs else DONE


def main():
    given = arguments()
    if not shutil.which("snakemake"):
        say("snakemake is missing; install Debian's packages: apt-get install snakemake "
            "python3-scipy")
        return MISSING
    fleet = read_fleet(given.fleet)
    if fleet is None:
        return CONFIGURATION
    if given.check:
        say(f"{len(fleet.drives)} drives, {len(fleet.configurations)} configurations, "
            f"{len(fleet.peers)} peers: no fault")
        return DONE
    out = (given.out or pathlib.Path("out/fleet") / given.fleet.stem).resolve()
    out.mkdir(parents=True, exist_ok=True)
    with lock(out) as held:
        plan.write_plan(fleet, out)
        if given.dry_run:
            return run_snakemake(given, out, held)
        shutil.rmtree(out / "scratch", ignore_errors=True)
        code = run_snakemake(given, out, held)
        os.chdir(out)
        if code == 0:
            sweep(out, fleet)
            return tell_result(out, collect.read_table())
        return tell_result(out, collect.collect())


if __name__ == "__main__":
    sys.exit(main())
