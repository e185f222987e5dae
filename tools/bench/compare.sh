#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
# Runs every registration method over one log: see usage.
set -euo pipefail

usage() {
  cat <<'USAGE'
Usage: tools/bench/compare.sh LOG TRUTH [OPTIONS]
Runs every registration method over one log, with and without the IMU, as a fleet, and makes one
Markdown table and one picture. Needs what tools/fleet.sh needs. Writes table.md, paths.png and the
files of the fleet, index.html and runs/METHOD/drive/ among them, into out/compare/NAME/, where NAME
is the name of LOG's folder. LOG may be any recording that lio-run takes.
  --config FILE  configuration with the rig; can be given several times (default: config.yaml beside
                 LOG, where lio-sim writes it)
  --duration S   run only this many seconds of the log
  --jobs N       number of runs at a time (1, so that no run costs another one time)
  --out DIR      write into this folder
USAGE
}

fail_usage() {
  echo "tools/bench/compare.sh: $1; see tools/bench/compare.sh --help" >&2
  exit 2
}

words=() out="" jobs=1 configs=() cut=""
while (($#)); do
  case $1 in
    -h | --help) usage && exit 0 ;;
    --config | --duration | --jobs | --out)
      (($# > 1)) || fail_usage "$1 needs a value"
      case $1 in
        --config) configs+=("$(realpath "$2")") ;;
        --duration) cut="--duration $2" ;;
        --jobs) jobs=$2 ;;
        --out) out=$(realpath -m "$2") ;;
      esac
      shift
      ;;
    -*) fail_usage "unknown option $1" ;;
    *) words+=("$(realpath "$1")") ;;
  esac
  shift
done
((${#words[@]} == 2)) || fail_usage "LOG and TRUTH are needed"
log=${words[0]} truth=${words[1]}
((${#configs[@]})) || configs=("$(dirname "$log")/config.yaml")
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
out=${out:-$PWD/out/compare/$(basename "$(dirname "$log")")}
mkdir -p "$out"

fleet() {
  cat <<DRIVE
drives:
  - name: drive
    input: "$log"
    truth: "$truth"
    rig: "${configs[0]}"
configurations:
DRIVE
  for method in ndt loam gicp; do
    for use_imu in true false; do
      cat <<CONFIGURATION
  - name: $method$([[ $use_imu == true ]] || echo -lidar)
    config: [$(printf '"%s", ' "${configs[@]:1}" "$PWD/config/methods/$method.yaml")]
    set: pipeline.use_imu=$use_imu
    words: --passes 1 $cut
CONFIGURATION
    done
  done
}
fleet >"$out/fleet.yaml"
tools/fleet.sh "$out/fleet.yaml" --out "$out" --jobs "$jobs"
/usr/bin/python3 -B tools/bench/compare_runs.py "$out" | tee "$out/table.md"
echo "$out/paths.png" >&2
