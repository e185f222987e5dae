#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
# Runs the whole path from the sensors' data to the score with one command: see usage.
set -euo pipefail

usage() {
  cat <<'USAGE'
Usage: tools/demo.sh [OPTIONS] [INPUT]
Sets up (tools/setup.sh), then runs odometry and leaves report.html, map.pcd, eval.json, verdict.json
and the paths in out/demo/.
INPUT goes to lio-run, which takes a ROS 1 bag, a ROS 2 bag folder, an MCAP file, a KITTI raw
drive, a KITTI odometry sequence, an LCM log, or a folder that lio-sim wrote. Without --config it
drafts a rig.
Without INPUT a drive around a block is simulated and played with lcm-logplayer over UDP multicast
to liod; path.png, error.png and map.png are drawn, too.
  --config FILE    configuration; may be given again (default: by the kind of input)
  --set KEY=VALUE  override one key; may be given again
  --truth FILE     true trajectory (default: from the input, or beside it)
  --speed S        without INPUT: speed of playing, in multiples of real time (3; with --view 1)
  --view           without INPUT: shows the drive on the page of lio-view while it is played, and
                   after it until Enter is pressed; needs a multicast route (any network gives one)
  --out DIR        folder of the results (out/demo)
USAGE
}

fail_usage() {
  echo "tools/demo.sh: $1; see tools/demo.sh --help" >&2
  exit 2
}

settings=() input="" truth="" speed="" out="" configs=() code=0 view=""
while (($#)); do
  case $1 in
    -h | --help) usage && exit 0 ;;
    --config | --set | --truth | --speed | --out)
      (($# > 1)) || fail_usage "$1 needs a value"
      case $1 in
        --config) configs+=("$(realpath -ms "$2")") ;;
        --set) settings+=(--set "$2") ;;
        --truth) truth=$(realpath -ms "$2") ;;
        --speed) speed=$2 ;;
        --out) out=$(realpath -ms "$2") ;;
      esac
      shift
      ;;
    --view) view=yes ;;
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
[[ -z $input || -z $speed ]] || fail_usage "--speed is for the simulated drive alone"
[[ -z $input || -z $view ]] || fail_usage "--view is for the simulated drive alone"

cd "$(dirname "${BASH_SOURCE[0]}")/.."
out=${out:-out/demo}
tools/setup.sh

# The first configuration stands for the rig, so that none is drafted.
run_input() {
  local words=(--out "$out" --overwrite "${settings[@]}") config
  if [[ -n $truth ]]; then words+=(--truth "$truth"); fi
  if ((${#configs[@]})); then words+=(--rig "${configs[0]}"); fi
  for config in "${configs[@]:1}"; do words+=(--config "$config"); done
  build/bin/lio-run "$input" "${words[@]}" || code=$?
}

# The simulated drive is kept while its maker is the same: the program and its sensor files.
make_drive() {
  local folder=$1 id
  id="loop vlp16 $(cat build/bin/lio-sim config/lidars/*.yaml config/imus/*.yaml | cksum)"
  if [[ -f $folder/source && $(<"$folder/source") == "$id" ]]; then return; fi
  rm -rf "$folder" && mkdir -p "$folder"
  echo "demo: making the input, a drive around a simulated block (kept in $folder)"
  build/bin/lio-sim --scenario loop --lidar vlp16 --threads "$(nproc)" --out "$folder"
  echo "$id" >"$folder/source"
}

# The page is served outside of a network namespace, so that a browser finds it. Others' LCM programs
# hear nothing all the same: the drive has a port of its own.
start_view() {
  export LIO_IN_NAMESPACE=no LCM_DEFAULT_URL=udpm://239.255.76.67:7676?ttl=0
  speed=${speed:-1}
  mkdir -p "$out"
  build/bin/lio-view 2>"$out/view.log" &
  viewer=$!
  trap 'kill "$viewer" 2>/dev/null || true' EXIT
  until grep -qs "open " "$out/view.log"; do
    kill -0 "$viewer" 2>/dev/null || { cat "$out/view.log" >&2 && exit 4; }
    sleep 0.05
  done
  local address
  address=$(sed -n 's/.*open //p' "$out/view.log")
  echo "demo: the drive is shown at $address"
  if [[ -n ${DISPLAY:-}${WAYLAND_DISPLAY:-} ]] && command -v xdg-open >/dev/null; then
    xdg-open "$address" >/dev/null 2>&1 || true
  fi
}

end_view() {
  [[ ! -t 0 ]] || read -rp "demo: the page stays until you press Enter "
  kill -TERM "$viewer" && wait "$viewer"
  trap - EXIT
}

play_drive() {
  local folder=out/inputs/loop words=() config
  make_drive "$folder"
  if ! ((${#configs[@]})); then configs=("$folder/config.yaml"); fi
  for config in "${configs[@]}"; do words+=(--config "$config"); done
  # On a busy machine the demo may be late, but it drops no scans.
  settings=(--set pipeline.max_queued_scans=1000 "${settings[@]}")
  mkdir -p "$out"
  rm -f "$out"/{path,error,map}.png "$out"/eval.{json,txt} # liod replaces the other files
  echo "demo: lcm-logplayer plays $folder/log.lcm to liod at speed ${speed:-3}"
  tools/demo/play.sh "$folder/log.lcm" "$out" "${speed:-3}" "${words[@]}" "${settings[@]}" ||
    code=$?
  # liod's 6 says that the result cannot be trusted: it is shown, with the reason.
  ((code == 0 || code == 6)) || exit "$code"
  if [[ ! -s $out/trajectory.tum ]]; then
    echo "tools/demo.sh: liod wrote no trajectory; its messages were:" >&2
    cat "$out/liod.log" >&2
    exit 1
  fi
  truth=${truth:-$folder/truth.tum}
  score_drive
}

# The level path is what a user keeps; without gravity there is only the path as it was published.
score_drive() {
  local path=$out/trajectory_level.tum
  [[ -s $path ]] || path=$out/trajectory.tum
  echo "demo: scoring ${path##*/}"
  build/bin/lio-eval "$truth" "$path" --json "$out/eval.json" --plots "$out" \
    --map "$out/map.pcd" >"$out/eval.txt"
  build/bin/lio-run "$out" --truth "$truth" >/dev/null
  /usr/bin/python3 tools/demo/table.py "$out"
  sed -n '/trust: /,$p' "$out/liod.log"
}

if [[ -n $view ]]; then start_view; fi
if [[ -n $input ]]; then run_input; else play_drive; fi
if [[ -n $view ]]; then end_view; fi
((code == 0 || code == 6)) || exit "$code"
echo "demo: results are in $out/: open report.html in a browser"
exit "$code"
