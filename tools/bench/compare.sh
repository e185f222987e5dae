#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
# Runs every registration method over one log: see usage.
set -euo pipefail

usage() {
  cat <<'USAGE'
Usage: tools/bench/compare.sh LOG TRUTH [OPTIONS]
Runs every registration method over one log, with and without the IMU, and makes one Markdown table
and one picture. Needs tools/setup.sh. Writes table.md, paths.png and each run into
out/compare/NAME/, where NAME is the name of LOG's folder.
  --config FILE  configuration with the rig; can be given several times (default: config.yaml beside
                 LOG, where lio-sim writes it)
  --duration S   replay only this many seconds of the log
  --out DIR      write into this folder
USAGE
}

fail_usage() {
  echo "tools/bench/compare.sh: $1; see tools/bench/compare.sh --help" >&2
  exit 2
}

repo=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
log='' truth='' out='' configs=() cut=()
while (($#)); do
  case $1 in
    -h | --help) usage && exit 0 ;;
    --config | --duration | --out)
      (($# > 1)) || fail_usage "$1 needs a value"
      case $1 in
        --config) configs+=(--config "$2") ;;
        --duration) cut=(--duration "$2") ;;
        --out) out=$2 ;;
      esac
      shift
      ;;
    -*) fail_usage "unknown option $1" ;;
    *) if [[ -z $log ]]; then log=$1; elif [[ -z $truth ]]; then truth=$1; else fail_usage "unknown argument $1"; fi ;;
  esac
  shift
done
[[ -n $log && -n $truth ]] || fail_usage "LOG and TRUTH are needed"
[[ -f $log && -f $truth ]] || { echo "compare.sh: no such file: $log or $truth" >&2 && exit 5; }
if ((${#configs[@]} == 0)); then
  configs=(--config "$(dirname "$log")/config.yaml")
  [[ -f ${configs[1]} ]] || { echo "compare.sh: no ${configs[1]}: give --config FILE" >&2 && exit 3; }
fi
out=${out:-$repo/out/compare/$(basename "$(dirname "$(realpath "$log")")")}
mkdir -p "$out"

runs=()
for method in ndt loam gicp; do
  for use_imu in true false; do
    run=$method && [[ $use_imu == true ]] || run=$method-lidar
    dir=$out/$run && rm -rf "$dir" && mkdir -p "$dir"
    "$repo/build/bin/lio-replay" "${configs[@]}" --config "$repo/config/methods/$method.yaml" \
      --set "pipeline.use_imu=$use_imu" "${cut[@]}" "$log" --out "$dir" --overwrite \
      2>"$dir/replay.log" ||
      { echo "compare.sh: $run failed: $(tail -n 1 "$dir/replay.log")" >&2 && continue; }
    "$repo/build/bin/lio-eval" "$truth" "$dir/trajectory.tum" --json "$dir/eval.json" \
      >"$dir/eval.txt" || continue
    runs+=("$run")
  done
done
/usr/bin/python3 "$repo/tools/bench/compare_runs.py" "$truth" "$out" "${runs[@]}" | tee "$out/table.md"
echo "$out/paths.png" >&2
