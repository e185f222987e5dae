#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
# Measures the speed of the whole pipeline: see usage.
set -euo pipefail

usage() {
  cat <<'USAGE'
Usage: tools/bench/speed.sh [RUNS [THREADS]]
Replays a simulated HDL-32E drive of full resolution several times (3, on 1 thread) and prints the
medians over the runs: milliseconds per sweep and stage, real-time factor, memory. Needs
tools/setup.sh. The drive is kept in out/inputs/speed/.
USAGE
}

if [[ ${1:-} == -h || ${1:-} == --help ]]; then
  usage
  exit 0
fi
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
runs=${1:-3} threads=${2:-1}
drive=out/inputs/speed
if [[ ! -f $drive/complete ]]; then
  build/bin/lio-sim --scenario street --lidar hdl32e --duration 40 --threads "$(nproc)" --out $drive
  touch $drive/complete
fi
rm -rf out/bench && mkdir -p out/bench
for run in $(seq "$runs"); do
  build/bin/lio-replay --config $drive/config.yaml $drive/log.lcm --out "out/bench/$run" \
    --threads "$threads" 2>"out/bench/$run.log"
done
grep -m1 'model name' /proc/cpuinfo | sed 's/.*: /machine: /'
/usr/bin/python3 tools/bench/speed_table.py out/bench/*/
