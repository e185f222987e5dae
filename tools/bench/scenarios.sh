#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
# Runs the estimator over every scenario of the simulator: see usage.
set -euo pipefail

usage() {
  cat <<'USAGE'
Usage: tools/bench/scenarios.sh [OPTIONS] [SCENARIO...]
Simulates, replays and evaluates every scenario of lio-sim (or those named), and prints two Markdown
tables. Scored is trajectory_level.tum, the path to keep, and beside it the height of trajectory.tum
as it was published. Needs tools/setup.sh. Writes into out/scenarios/SEED/: table.md, one folder per
scenario with eval.txt, path.png and run/, and loop/closeup.png, which shows surfaces that the loop
sees at its begin and at its end.
  --duration S     end each drive after so many seconds
  --seed N         seed of the places, the traffic and every error (1)
  --set KEY=VALUE  override one key of the estimator; can be given several times
  --keep-logs      keep each log.lcm (up to 1.4 GB) and use it again while lio-sim is the same
  --docs           put the table into docs/results.md and the close-up into docs/images/
USAGE
}

fail_usage() {
  echo "tools/bench/scenarios.sh: $1; see tools/bench/scenarios.sh --help" >&2
  exit 2
}

cd "$(dirname "${BASH_SOURCE[0]}")/../.."
seed=1 keep_logs=no docs=no settings=() scenarios=() cut=()
while (($#)); do
  case $1 in
    -h | --help) usage && exit 0 ;;
    --seed | --set | --duration)
      (($# > 1)) || fail_usage "$1 needs a value"
      case $1 in
        --seed) seed=$2 ;;
        --set) settings+=(--set "$2") ;;
        --duration) cut=(--duration "$2") ;;
      esac
      shift
      ;;
    --keep-logs) keep_logs=yes ;;
    --docs) docs=yes ;;
    -*) fail_usage "unknown option $1" ;;
    *) scenarios+=("$1") ;;
  esac
  shift
done
((${#scenarios[@]})) || mapfile -t scenarios < <(build/bin/lio-sim --list)
root=out/scenarios/$seed
maker="${cut[*]}$(cat build/bin/lio-sim config/lidars/*.yaml config/imus/*.yaml | cksum)"

for scenario in "${scenarios[@]}"; do
  dir=$root/$scenario
  mkdir -p "$dir"
  echo "$scenario" >&2
  if [[ ! -f $dir/log.lcm || ! -f $dir/maker || $(<"$dir/maker") != "$maker" ]]; then
    rm -f "$dir/maker"
    build/bin/lio-sim --scenario "$scenario" --seed "$seed" --threads "$(nproc)" "${cut[@]}" \
      --out "$dir" >&2
    echo "$maker" >"$dir/maker"
  fi
  build/bin/lio-replay --config "$dir/config.yaml" "${settings[@]}" "$dir/log.lcm" \
    --out "$dir/run" --overwrite --map >&2 || (($? == 6)) # 6: done, but not to be trusted
  # lio-eval takes the level path, which the map fits, of a run's folder when it is there.
  build/bin/lio-eval "$dir/truth.tum" "$dir/run" --json "$dir/eval.json" \
    --plot "$dir/path.png" --map "$dir/run/map.pcd" >"$dir/eval.txt"
  build/bin/lio-eval "$dir/truth.tum" "$dir/run/trajectory.tum" --json "$dir/eval_published.json" \
    >/dev/null
  if [[ $scenario == loop ]]; then
    /usr/bin/python3 -B tools/bench/wall_closeup.py "$dir" "$dir/closeup.png" >&2
  fi
  [[ $keep_logs == yes ]] || rm "$dir/log.lcm"
done
/usr/bin/python3 -B tools/bench/scenarios_table.py "$root" "${scenarios[@]}" | tee "$root/table.md"
if [[ $docs == yes ]]; then
  /usr/bin/python3 -B tools/bench/put_table.py docs/results.md scenarios "$root/table.md"
  [[ ! -f $root/loop/closeup.png ]] || cp "$root/loop/closeup.png" docs/images/loop_closeup.png
fi
