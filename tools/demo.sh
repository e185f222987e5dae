#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
# Runs the whole path from the sensors' data to the score with one command: see usage.
set -euo pipefail

usage() {
  cat <<'USAGE'
Usage: tools/demo.sh [OPTIONS] [INPUT]
Sets up (tools/setup.sh), makes or converts the input, plays it with lcm-logplayer over UDP
multicast to liod, and scores the result with lio-eval. Leaves path.png, error.png, map.png,
eval.json and the files that liod writes in out/demo/.
INPUT is a ROS 1 bag, a ROS 2 bag folder, a KITTI raw drive folder, a KITTI odometry sequence
folder, an LCM log, or a folder that lio-sim wrote. Without INPUT a drive around a block is
simulated.
  --config FILE    configuration of liod; may be given again (default: by the kind of input)
  --set KEY=VALUE  override one key; may be given again
  --truth FILE     true trajectory (default: from the input, or beside it)
  --speed S        speed of playing, in multiples of real time (1; 3 for the simulated drive)
  --out DIR        folder of the results (out/demo)
USAGE
}

fail_usage() {
  echo "tools/demo.sh: $1; see tools/demo.sh --help" >&2
  exit 2
}

# On a busy machine the demo may be late, but it drops no scans.
settings=(--set pipeline.max_queued_scans=1000)
input="" given_truth="" speed="" out=out/demo given_configs=()
while (($#)); do
  case $1 in
    -h | --help) usage && exit 0 ;;
    --config | --set | --truth | --speed | --out)
      (($# > 1)) || fail_usage "$1 needs a value"
      case $1 in
        --config) given_configs+=("$(realpath -ms "$2")") ;;
        --set) settings+=(--set "$2") ;;
        --truth) given_truth=$(realpath -ms "$2") ;;
        --speed) speed=$2 ;;
        --out) out=$(realpath -ms "$2") ;;
      esac
      shift
      ;;
    -*) fail_usage "unknown option $1" ;;
    *)
      [[ -z $input ]] || fail_usage "only one INPUT is possible"
      input=$(realpath -ms "$1")
      ;;
  esac
  shift
done
if [[ -n $input && ! -e $input ]]; then
  echo "tools/demo.sh: $input does not exist" >&2
  exit 5
fi

cd "$(dirname "${BASH_SOURCE[0]}")/.."
tools/setup.sh
log="" truth="" configs=()
source tools/demo/input.sh
if [[ -n $input ]]; then
  find_input "$input"
else
  make_input
  speed=${speed:-3}
fi
speed=${speed:-1}
truth=${given_truth:-$truth}
if ((${#given_configs[@]})); then configs=("${given_configs[@]}"); fi

words=()
for config in "${configs[@]}"; do words+=(--config "$config"); done
mkdir -p "$out"
rm -f "$out"/{path,error,map}.png "$out"/eval.{json,txt} # liod replaces the other files
echo "demo: lcm-logplayer plays $log to liod at speed $speed"
code=0
tools/demo/play.sh "$log" "$out" "$speed" "${words[@]}" "${settings[@]}" || code=$?
# liod's 6 says that the result cannot be trusted: it is shown, with the reason.
((code == 0 || code == 6)) || exit "$code"

if [[ ! -s $out/trajectory.tum ]]; then
  echo "tools/demo.sh: liod wrote no trajectory; its messages were:" >&2
  cat "$out/liod.log" >&2
  exit 1
fi
# The level path is what a user keeps; without gravity there is only the path as it was published.
path=$out/trajectory_level.tum
[[ -s $path ]] || path=$out/trajectory.tum
if [[ -n $truth ]]; then
  echo "demo: scoring ${path##*/}"
  build/bin/lio-eval "$truth" "$path" --json "$out/eval.json" --plots "$out" \
    --map "$out/map.pcd" >"$out/eval.txt"
else
  echo "demo: this input has no true trajectory: drawing only path and map"
  /usr/bin/python3 tools/plot/plot_run.py "$out"
fi
/usr/bin/python3 tools/demo/table.py "$out"
sed -n '/trust: /,$p' "$out/liod.log"
echo "demo: results are in $out/"
exit "$code"
