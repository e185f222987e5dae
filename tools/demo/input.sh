# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
# tools/demo.sh sources this file. make_input and find_input set
#   log      the LCM log
#   truth    its true trajectory; empty when there is none
#   configs  the configurations to run it with, unless the user named some
# Logs that were made or converted are kept under out/inputs/ and used again while their source is
# the same.

# kept FOLDER SOURCE_ID: true when FOLDER was completed from the same source; otherwise empties it.
kept() {
  if [[ -f $1/source && $(<"$1/source") == "$2" ]]; then return 0; fi
  rm -rf "$1" && mkdir -p "$1"
  return 1
}

# source_id PATH: changes when the file changes, or the list of files in the folder.
source_id() { stat -c '%n %s %Y' "$(realpath "$1")"; }

# maker_id: changes when the program or a sensor file changes that the simulated drive is made with.
maker_id() { cat build/bin/lio-sim config/lidars/*.yaml config/imus/*.yaml | cksum; }

make_input() {
  local folder=out/inputs/loop id
  id="loop vlp16 $(maker_id)"
  if ! kept "$folder" "$id"; then
    echo "demo: making the input, a drive around a simulated block (kept in $folder)"
    build/bin/lio-sim --scenario loop --lidar vlp16 --threads "$(nproc)" --out "$folder"
    echo "$id" >"$folder/source"
  fi
  take_simulated "$folder"
}

take_simulated() {
  log=$1/log.lcm truth=$1/truth.tum configs=("$1/config.yaml")
  if [[ ! -f $truth ]]; then truth=; fi
}

# convert INPUT WORDS...: runs lio-convert WORDS, where @ is a kept folder named after INPUT.
# The sound parts of a damaged input are converted; an input without any is an error.
convert() {
  local input=$1 id folder code=0
  shift
  id="$(source_id "$input") $*"
  folder=out/inputs/$(basename "$input")-$(cksum <<<"$id" | cut -d' ' -f1)
  log=$folder/log.lcm truth=$folder/truth.tum
  if ! kept "$folder" "$id"; then
    echo "demo: converting $input (kept in $folder)"
    build/bin/lio-convert "${@//@/$folder}" || code=$?
    [[ $code == 0 || ($code == 5 && -s $log) ]] || return "$code"
    echo "$id" >"$folder/source"
  fi
  if [[ ! -s $truth ]]; then truth=; fi
}

convert_bag() {
  local bag=$1 sibling
  configs=(config/ulhk.yaml)
  if ! convert "$bag" rosbag "$bag" @/log.lcm --truth @/truth.tum; then
    echo "demo: trying again without truth"
    convert "$bag" rosbag "$bag" @/log.lcm
  fi
  for sibling in "${bag%.*}.gt.tum" "${bag%.*}.tum"; do # a better truth beside the bag
    if [[ -f $sibling ]]; then truth=$sibling; fi
  done
}

# KITTI publishes poses only for the first half of its sequences.
convert_sequence() {
  local sequence=$1 poses words=()
  poses=$(dirname "$(dirname "$sequence")")/poses/$(basename "$sequence").txt
  if [[ -f $poses ]]; then words=(--poses "$poses" --truth @/truth.tum); fi
  convert "$sequence" kitti-odometry "$sequence" @/log.lcm "${words[@]}"
  configs=(config/kitti_odometry.yaml)
}

find_input() {
  local input=${1%/}
  if [[ -f $input/log.lcm && -f $input/config.yaml ]]; then
    take_simulated "$input"
  elif [[ -d $input/velodyne_points && -d $input/oxts ]]; then
    convert "$input" kitti-raw "$input" @/log.lcm --truth @/truth.tum --rig @/rig.yaml \
      --imu-rate 100
    configs=(config/kitti_raw.yaml "$(dirname "$log")/rig.yaml")
  elif [[ -d $input/velodyne && -f $input/times.txt ]]; then
    convert_sequence "$input"
  elif [[ -f $input/metadata.yaml ]]; then
    convert_bag "$input"
  elif [[ $(head -c 12 "$input" 2>/dev/null | tr -d '\0') == "#ROSBAG V2.0" ]]; then
    convert_bag "$input"
  elif [[ $(head -c 4 "$input" 2>/dev/null | od -An -tx1) == " ed a1 da 01" ]]; then
    log=$input truth= configs=(config/default.yaml)
    local folder
    folder=$(dirname "$input")
    if [[ -f $folder/truth.tum ]]; then truth=$folder/truth.tum; fi
    if [[ -f $folder/config.yaml ]]; then configs=("$folder/config.yaml"); fi
  else
    echo "tools/demo.sh: $input is not a ROS bag, KITTI drive or sequence folder, LCM log, or" \
      "folder of lio-sim" >&2
    return 5
  fi
}
