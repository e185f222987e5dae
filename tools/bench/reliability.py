#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""Makes the table of faults of docs/reliability.md; see --help.

Each case is one drive with one fault, replayed, and some of them played to liod as well. Scans are
cast once a drive. Results are kept in out/reliability, so an interrupted measurement goes on. A
--check fails where a case breaks a bar and is not among the KNOWN ones of reliability_cases.py.
"""
import argparse
import json
import pathlib
import shutil
import subprocess
import sys

import live
import reliability_score
from reliability_cases import BRIEF, START_S, all_cases, why_known

DURATION_S = 60
BRIEF_DURATION_S = 45  # faults end at 40 s, and the rows after them are judged
MAX_WRONG_S = 1.0
MAX_ANEES = 2.0
IMUS = {"campus": "consumer_mems"}  # in the hand; elsewhere the IMU of a car
SPEED = 3
OUT = pathlib.Path("out/reliability")
COLUMNS = ("drive", "fault", "by", "crash", "wrong [s]", "ANEES", "LOST [s]", "end [m]", "tracks",
           "rows lost")


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--scenario", action="append", help="of lio-sim (street and campus)")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", help="cases whose name contains this")
    parser.add_argument("--no-live", action="store_true", help="by replay alone")
    parser.add_argument("--docs", action="store_true",
                        help="put the table into docs/reliability.md")
    parser.add_argument("--check", action="store_true", help="end with 1 where a bar is broken")
    parser.add_argument("--brief", action="store_true",
                        help=f"thirteen cases of a walk of {BRIEF_DURATION_S} s, by replay, anew")
    options = parser.parse_args()
    if options.brief and options.docs:
        parser.error("the table of the docs is of all cases")
    if options.brief:
        options.scenario = options.scenario or ["campus"]
        options.no_live = True
    options.duration_s = BRIEF_DURATION_S if options.brief else DURATION_S
    options.out = OUT.with_name("reliability-brief") if options.brief else OUT
    return options


def simulate(scenario, options, folder, *words):
    if (folder / "complete").exists():
        return
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    subprocess.run([live.BIN / "lio-sim", "--scenario", scenario, "--seed", str(options.seed),
                    "--lidar", "vlp16", "--imu", IMUS.get(scenario, "xsens_mti10"), "--duration",
                    str(options.duration_s), "--threads", "2", *words, "--out", folder],
                   check=True, capture_output=True)
    (folder / "complete").write_text("")


def run_replay(log, run):
    shutil.rmtree(run, ignore_errors=True)
    return subprocess.run([live.BIN / "lio-replay", "--config", log / "config.yaml",
                           log / "log.lcm", "--out", run], check=False,
                          capture_output=True).returncode


def run_live(log, run):
    shutil.rmtree(run, ignore_errors=True)
    liod = live.Liod(run, "--config", log / "config.yaml")
    live.play(log / "log.lcm", SPEED)
    liod.wait_until_idle()
    return liod.stop()


def rows_lost(run, num_rows):
    """Scans that the estimator gave a row for and that no file has, and what has no fate."""
    account = json.loads((run / "stats.json").read_text())["account"]
    unaccounted = sum(abs(fates["unaccounted"]) for fates in account.values())
    return account["scans"]["used"] + account["scans"]["rejected"] - num_rows + unaccounted


def measure(case, by, log, clean):
    run = log / by
    code = (run_live if by == "live" else run_replay)(log, run)
    result = {"code": code}
    if code not in (0, 6):
        return result
    true_end_s = {int(row["scan_seq"]): float(row["t_s"])
                  for row in reliability_score.table(clean / "replay" / "registration.csv")}
    begin_s = float((clean / "truth.tum").open(encoding="utf-8").readline().split()[0])
    result |= reliability_score.score(run, clean / "truth.tum", case, begin_s, true_end_s)
    result["rows_lost"] = rows_lost(run, result["num_rows"])
    return result


def broken_bars(r):
    """Returns what a result breaks, in words."""
    if "num_rows" not in r:
        return [f"ended with code {r['code']}"]
    faults = []
    if r["wrong_ok_s"] > MAX_WRONG_S:
        faults.append(f"wrong for {r['wrong_ok_s']:.1f} s while OK")
    if (r["anees_after"] or 0.0) >= MAX_ANEES:
        faults.append(f"ANEES {r['anees_after']:.2g}")
    if r["rows_lost"]:
        faults.append(f"{r['rows_lost']} rows lost")
    return faults


def check(results):
    """Names the bars that are broken; returns whether all of that is known."""
    num_unknown = 0
    for (scenario, case, by), result in results.items():
        faults = broken_bars(result)
        why = why_known(case, scenario)
        if faults:
            print(f"{scenario}, {case}, {by}: {', '.join(faults)}: {why or 'NOT KNOWN'}")
        num_unknown += bool(faults and not why)
    print(f"{len(results)} runs were checked, {num_unknown} break a bar and are not known to")
    return num_unknown == 0


def text_of(drive, case, by, r):
    if "num_rows" not in r:
        return [drive, case.name, by, f"code {r['code']}", *[""] * 6]
    anees = "LOST" if r["anees_after"] is None else f"{r['anees_after']:.2g}"
    wrong = f"{r['wrong_ok_s']:.1f}"
    return [drive, case.name, by, "no",
            f"**{wrong}**" if r["wrong_ok_s"] > MAX_WRONG_S else wrong,
            f"**{anees}**" if (r["anees_after"] or 0.0) >= MAX_ANEES else anees,
            f"{r['lost_s']:.1f}", f"{r['end_m']:.2g}",
            "yes" if r["is_tracking"] else f"**{r['drift_m']:.2g} m**",
            f"**{r['rows_lost']}**" if r["rows_lost"] else "0"]


def markdown(rows):
    lines = [COLUMNS, ["---"] * len(COLUMNS), *rows]
    return "".join(f"| {' | '.join(map(str, line))} |\n" for line in lines)


def run_case(scenario, case, options, kept, results):
    clean = options.out / f"{scenario}-{options.seed}" / "none"
    name = case.name.replace(" ", "_").replace("'", "")
    log = clean.parent / name
    rows = []
    for by in ("replay", "live") if case.is_live and not options.no_live else ("replay",):
        key = f"{scenario} {options.seed} {case.name} {by}"
        if key not in kept:
            words = [word for fault in case.faults for word in ("--fault", fault)]
            if log != clean and not case.is_cast_anew:
                words += ["--scans", str(clean / "log.lcm")]
            simulate(scenario, options, log, *words)
            kept[key] = measure(case, by, log, clean)
            (options.out / "results.json").write_text(json.dumps(kept, indent=1))
        results[scenario, case.name, by] = kept[key]
        rows.append(text_of(scenario, case, by, kept[key]))
        print(" | ".join(rows[-1]), flush=True)
    if log != clean:
        (log / "log.lcm").unlink(missing_ok=True)
        (log / "complete").unlink(missing_ok=True)
    return rows


def main():
    options = arguments()
    if not options.no_live:
        live.enter_namespace()
    if options.brief:
        shutil.rmtree(options.out, ignore_errors=True)
    options.out.mkdir(parents=True, exist_ok=True)
    earlier = options.out / "results.json"
    kept = json.loads(earlier.read_text()) if earlier.exists() else {}
    cases = [case for case in all_cases()
             if (not options.brief or case.name in BRIEF)
             and (not options.only or options.only in case.name or case.name == "none")]
    rows, results = [], {}
    for scenario in options.scenario or ("street", "campus"):
        for case in cases:
            rows += run_case(scenario, case, options, kept, results)
    table = options.out / "table.md"
    table.write_text(markdown(rows), encoding="utf-8")
    print(f"{len(rows)} runs, faults from {START_S:g} s on; the table is in {table}")
    if options.docs:
        subprocess.run([sys.executable, "-B", "tools/bench/put_table.py", "docs/reliability.md",
                        "faults", table], check=True)
    if options.check and not check(results):
        sys.exit(1)


if __name__ == "__main__":
    main()
