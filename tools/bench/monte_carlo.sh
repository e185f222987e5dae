#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
# Is the covariance true? Runs seeds of a scenario through the whole pipeline on all cores and judges
# the runs together by NEES and NIS.
#   tools/bench/monte_carlo.sh SCENARIO [RUNS [DURATION_S]]     (20 runs of 40 s)
# Needs tools/setup.sh. Leaves out/monte_carlo/SCENARIO/consistency.{json,png}.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
scenario=${1:?usage: tools/bench/monte_carlo.sh SCENARIO [RUNS [DURATION_S]]}
runs=${2:-20} duration=${3:-40}
root=out/monte_carlo/$scenario
mkdir -p "$root"
one_run() { # ROOT SCENARIO DURATION SEED
  local dir=$1/$4
  [[ -f $dir/stats.json ]] && return
  build/bin/lio-sim --scenario "$2" --duration "$3" --seed "$4" --out "$dir" >/dev/null
  build/bin/lio-replay --config "$dir/config.yaml" "$dir/log.lcm" --out "$dir" 2>"$dir/replay.log"
  rm "$dir/log.lcm"
}
export -f one_run
seq "$runs" | xargs -P "$(nproc)" -I{} bash -c "one_run '$root' '$scenario' '$duration' {}"
build/bin/lio-eval consistency truth.tum "$root"/[0-9]* --json "$root/consistency.json" \
  --plot "$root/consistency.png"
