#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
# The estimator over every scenario of the simulator: drives, replays and scores each, and prints one
# Markdown table, which docs/results.md shows.
#   tools/bench/scenarios.sh [SEED [SCENARIO...]]     (seed 1, all scenarios)
# Needs tools/setup.sh. Results stay in out/scenarios/SEED/, pictures of each path included.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
seed=${1:-1}
shift || true
scenarios=("$@")
((${#scenarios[@]})) || mapfile -t scenarios < <(build/bin/lio-sim --list)
root=out/scenarios/$seed
for scenario in "${scenarios[@]}"; do
  dir=$root/$scenario
  mkdir -p "$dir"
  echo "$scenario" >&2
  build/bin/lio-sim --scenario "$scenario" --seed "$seed" --threads "$(nproc)" --out "$dir" >&2
  build/bin/lio-replay --config "$dir/config.yaml" "$dir/log.lcm" --out "$dir/run" --map >&2
  build/bin/lio-eval "$dir/truth.tum" "$dir/run/trajectory.tum" --json "$dir/eval.json" \
    --plot "$dir/path.png" --map "$dir/run/map.pcd" >"$dir/eval.txt"
  rm "$dir/log.lcm" # up to a gigabyte each
done
/usr/bin/python3 tools/bench/scenarios_table.py "$root" "${scenarios[@]}"
