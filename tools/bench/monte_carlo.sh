#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
# Tests whether the covariance agrees with the errors, over many seeds: see usage.
set -euo pipefail

usage() {
  cat <<'USAGE'
Usage: tools/bench/monte_carlo.sh [OPTIONS] SCENARIO [RUNS [DURATION_S]]
Runs seeds of a scenario (default: 20 seeds of 40 s) through the whole pipeline as a fleet, and
judges all runs by NEES and NIS with lio-eval consistency. Needs what tools/fleet.sh needs. Writes
into out/monte_carlo/SCENARIO/: the files of the fleet, index.html and runs/liod/SCENARIO-SEED/
among them, and consistency.txt, .json and .png of the steady path, consistency_world.* of the level
world, and consistency_level.* of the path that is level by the last estimate. Seeds that the same
programs and settings have finished are kept, so an interrupted run continues.
  --set KEY=VALUE    override one key of the estimator; can be given several times
  --sim "ARGUMENTS"  more arguments of lio-sim, e.g. --sim "--lidar vlp16 --moving-start"
                     (a sensor's file by its whole path)
  --first N          first seed (1)
  --jobs N           number of runs at a time (all cores)
  --out DIR          write into this folder
Examples:
  tools/bench/monte_carlo.sh street 50 60
  tools/bench/monte_carlo.sh --set filter.map_walk_scale=0.5 --out out/walk_half loop 20 60
USAGE
}

fail_usage() {
  echo "tools/bench/monte_carlo.sh: $1; see tools/bench/monte_carlo.sh --help" >&2
  exit 2
}

settings=() sim="" first=1 jobs=$(nproc) root="" words=()
while (($#)); do
  case $1 in
    -h | --help) usage && exit 0 ;;
    --set | --sim | --first | --jobs | --out)
      (($# > 1)) || fail_usage "$1 needs a value"
      case $1 in
        --set) settings+=("$2") ;;
        --sim) sim=$2 ;;
        --first) first=$2 ;;
        --jobs) jobs=$2 ;;
        --out) root=$(realpath -ms "$2") ;;
      esac
      shift
      ;;
    -*) fail_usage "unknown option $1" ;;
    *) words+=("$1") ;;
  esac
  shift
done
((${#words[@]} >= 1 && ${#words[@]} <= 3)) || fail_usage "name one SCENARIO"
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
scenario=${words[0]} runs=${words[1]:-20} duration=${words[2]:-40}
root=${root:-out/monte_carlo/$scenario}
mkdir -p "$root"

cat >"$root/fleet.yaml" <<FLEET
drives:
  - name: $scenario
    sim: >-
      --scenario $scenario --duration $duration $sim
    seeds: $first..$((first + runs - 1))
configurations:
  - name: liod
    words: --passes 1   # as liod would
    set: >-
      ${settings[*]@Q}
FLEET
tools/fleet.sh "$root/fleet.yaml" --out "$root" --jobs "$jobs"

dirs=()
for seed in $(seq "$first" $((first + runs - 1))); do
  dirs+=("$root/runs/liod/$scenario-$seed")
done
judge() { # NAME TITLE ARGUMENTS...
  echo "== $2"
  "${LIO_BUILD:-build}/bin/lio-eval" consistency "${@:3}" truth.tum "${dirs[@]}" \
    --json "$root/$1.json" --plot "$root/$1.png" | tee "$root/$1.txt"
}
judge consistency "the steady path: trajectory.tum with covariance.csv"
judge consistency_world "the level world: trajectory_world.tum with covariance_world.csv" --world
judge consistency_level "the path to keep: trajectory_level.tum with covariance_level.csv" --level
