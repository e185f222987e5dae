#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
# Runs the estimator over every scenario of the simulator: see usage.
set -euo pipefail

usage() {
  cat <<'USAGE'
Usage: tools/bench/scenarios.sh [OPTIONS] [SCENARIO...]
Simulates, runs and evaluates every scenario of lio-sim (or those named) as a fleet, and prints two
Markdown tables. Scored is trajectory_level.tum, the path to keep, and beside it the height of
trajectory.tum as it was published. Needs what tools/fleet.sh needs. Writes into
out/scenarios/SEED/: the files of the fleet, index.html and runs/liod/SCENARIO-SEED/ among them,
table.md, and closeup.png, which shows surfaces that the loop sees at its begin and at its end; the
loop's log is kept for it. The same command does only what changed.
  --duration S     end each drive after so many seconds
  --seed N         seed of the places, the traffic and every error (1)
  --set KEY=VALUE  override one key of the estimator; can be given several times
  --jobs N         number of jobs at a time (1, so that no run costs another one time)
  --keep-logs      keep each log.lcm (up to 1.4 GB), to run it again by other programs or settings
  --out DIR        write into this folder
  --docs           put the table into docs/results.md and the close-up into docs/images/
USAGE
}

fail_usage() {
  echo "tools/bench/scenarios.sh: $1; see tools/bench/scenarios.sh --help" >&2
  exit 2
}

seed=1 jobs=1 keep="" docs=no settings=() scenarios=() cut="" root=""
while (($#)); do
  case $1 in
    -h | --help) usage && exit 0 ;;
    --seed | --set | --duration | --jobs | --out)
      (($# > 1)) || fail_usage "$1 needs a value"
      case $1 in
        --seed) seed=$2 ;;
        --set) settings+=("$2") ;;
        --duration) cut="--duration $2" ;;
        --jobs) jobs=$2 ;;
        --out) root=$(realpath -ms "$2") ;;
      esac
      shift
      ;;
    --keep-logs) keep=logs ;;
    --docs) docs=yes ;;
    -*) fail_usage "unknown option $1" ;;
    *) scenarios+=("$1") ;;
  esac
  shift
done
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
((${#scenarios[@]})) || mapfile -t scenarios < <("${LIO_BUILD:-build}/bin/lio-sim" --list)
root=${root:-out/scenarios/$seed}
mkdir -p "$root"

fleet() {
  echo "drives:"
  for scenario in "${scenarios[@]}"; do
    cat <<DRIVE
  - name: $scenario
    sim: --scenario $scenario $cut
    seeds: $seed
    keep: $([[ $scenario != loop ]] || echo logs)
DRIVE
  done
  cat <<CONFIGURATION
configurations:
  - name: liod
    set: >-
      ${settings[*]@Q}
keep: $keep
CONFIGURATION
}
fleet >"$root/fleet.yaml"
tools/fleet.sh "$root/fleet.yaml" --out "$root" --jobs "$jobs"

/usr/bin/python3 -B tools/bench/scenarios_table.py "$root" | tee "$root/table.md"
if [[ " ${scenarios[*]} " == *" loop "* ]]; then
  /usr/bin/python3 -B tools/bench/wall_closeup.py "$root/drives/loop-$seed" \
    "$root/runs/liod/loop-$seed" "$root/closeup.png" >&2
fi
if [[ $docs == yes ]]; then
  /usr/bin/python3 -B tools/bench/put_table.py docs/results.md scenarios "$root/table.md"
  [[ ! -f $root/closeup.png ]] || cp "$root/closeup.png" docs/images/loop_closeup.png
fi
