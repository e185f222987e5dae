#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
# Every registration method over one log, with and without the IMU: one Markdown table and one
# picture.
#   tools/bench/compare.sh LOG TRUTH [--config FILE ...] [--duration S] [--out DIR]
# The rig comes from the given configurations, by default from config.yaml beside LOG, as lio-sim
# leaves it. Needs tools/setup.sh. Leaves out/compare/NAME/{table.md,paths.png} and each run, NAME
# that of LOG's folder.
set -euo pipefail
if [[ ${1:-} == -h || ${1:-} == --help ]]; then
  sed -n '4,9s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"
  exit 0
fi
repo=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
usage() {
  sed -n '4,9s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" >&2
  exit 2
}
log='' truth='' out='' configs=() cut=()
while (($#)); do
  case $1 in
    --config) configs+=(--config "${2:?--config needs a file}") && shift ;;
    --duration) cut=(--duration "${2:?--duration needs seconds}") && shift ;;
    --out) out=${2:?--out needs a folder} && shift ;;
    -*) usage ;;
    *) if [[ -z $log ]]; then log=$1; elif [[ -z $truth ]]; then truth=$1; else usage; fi ;;
  esac
  shift
done
[[ -n $log && -n $truth ]] || usage
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
      --set "pipeline.use_imu=$use_imu" "${cut[@]}" "$log" --out "$dir" 2>"$dir/replay.log" ||
      { echo "compare.sh: $run failed: $(tail -n 1 "$dir/replay.log")" >&2 && continue; }
    "$repo/build/bin/lio-eval" "$truth" "$dir/trajectory.tum" --json "$dir/eval.json" \
      >"$dir/eval.txt" || continue
    runs+=("$run")
  done
done
/usr/bin/python3 "$repo/tools/bench/compare_runs.py" "$truth" "$out" "${runs[@]}" | tee "$out/table.md"
echo "$out/paths.png" >&2
