#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
# Plays a drive from one host to liod on another: see usage.
set -euo pipefail

usage() {
  cat <<'USAGE'
Usage: tools/bench/netns.sh [--mtu BYTES] [--speed S] [CASE...]
Makes two hosts (network namespaces) with a cable between (veth), plays a simulated drive on the one
and runs liod on the other, and prints what came through and how right the path is. Cases:
  clean    nothing is wrong
  loss     2 % of the packets are lost
  reorder  a quarter of the packets overtake others, by 2 ms
  link     the link is down for 5 s in the middle of the drive
A packet of the usual MTU (1500) is a fortieth of a chunk of 60 kB, which is lost with any of them;
--mtu 65535 (the default) makes a packet a message. Loss and delay are those of netns_relay.py, since
few kernels have netem. Needs root and ip, else it says so and ends with 77. Writes into
out/netns/CASE/.
USAGE
}

cd "$(dirname "${BASH_SOURCE[0]}")/../.."
mtu=65535 speed=1 cases=() build=${LIO_BUILD:-build} out=out/netns
while (($#)); do
  case $1 in
    -h | --help) usage && exit 0 ;;
    --mtu) mtu=$2 && shift ;;
    --speed) speed=$2 && shift ;;
    clean | loss | reorder | link) cases+=("$1") ;;
    *) echo "tools/bench/netns.sh: unknown argument $1; see --help" >&2 && exit 2 ;;
  esac
  shift
done
((${#cases[@]})) || cases=(clean loss reorder link)
robot=lio_robot_$$ sensor=lio_sensor_$$

skip() {
  echo "netns: skipped: $1"
  exit 77
}
remove_hosts() {
  ip netns del "$robot" 2>/dev/null || true
  ip netns del "$sensor" 2>/dev/null || true
}
make_hosts() {
  ip netns add "$robot" 2>/dev/null && ip netns add "$sensor" ||
    skip "network namespaces are not allowed here"
  ip link add cable netns "$robot" type veth peer name cable netns "$sensor" ||
    skip "the kernel has no veth"
  local host address=1
  for host in "$robot" "$sensor"; do
    ip -n "$host" link set lo up
    ip -n "$host" addr add "10.77.0.$address/24" dev cable
    ip -n "$host" link set cable mtu "$mtu" up
    ip -n "$host" route add 224.0.0.0/4 dev cable
    address=$((address + 1))
  done
}

# spoil CASE: between the player and the cable stands a relay that loses or delays datagrams.
spoil() {
  [[ $1 == loss || $1 == reorder ]] || return 0
  ip -n "$sensor" link set lo multicast on
  ip -n "$sensor" route replace 224.0.0.0/4 dev lo
  ip netns exec "$sensor" /usr/bin/python3 -B tools/bench/netns_relay.py "$1" "$mtu" 10.77.0.2 \
    >"$folder/relay.log" &
  relay=$!
  until grep -qs listening "$folder/relay.log"; do
    kill -0 "$relay" || exit 1
    sleep 0.1
  done
}

break_link() {
  sleep "$(awk "BEGIN { print 25 / $speed }")"
  ip -n "$sensor" link set cable down
  sleep "$(awk "BEGIN { print 5 / $speed }")"
  ip -n "$sensor" link set cable up
  ip -n "$sensor" route replace 224.0.0.0/4 dev cable
}

run_case() {
  local case=$1 folder=$out/$1 liod relay="" url="udpm://239.255.76.67:7667?ttl=1"
  rm -rf "$folder" && mkdir -p "$folder"
  make_hosts
  spoil "$case"
  ip netns exec "$robot" "$build/bin/liod" --lcm-url "$url" --config "$out/drive/config.yaml" \
    --out "$folder" --overwrite 2>"$folder/liod.log" &
  liod=$!
  until grep -qs listening "$folder/liod.log"; do
    kill -0 "$liod" || { cat "$folder/liod.log" >&2 && exit 1; }
    sleep 0.1
  done
  if [[ $case == link ]]; then break_link & fi
  ip netns exec "$sensor" lcm-logplayer --lcm-url="$url" --speed="$speed" "$out/drive/log.lcm" >/dev/null
  sleep 3
  kill -TERM "$liod"
  wait "$liod" || true
  if [[ -n $relay ]]; then kill "$relay" 2>/dev/null || true; fi
  remove_hosts
  /usr/bin/python3 -B tools/bench/netns_row.py "$case" "$folder" "$out/drive" "$build"
}

((EUID == 0)) || skip "this needs root"
command -v ip >/dev/null || skip "there is no ip here"
trap remove_hosts EXIT
mkdir -p "$out"
[[ -f $out/drive/config.yaml ]] || "$build/bin/lio-sim" --scenario street --lidar vlp16 \
  --imu xsens_mti10 --duration 60 --threads 2 --out "$out/drive"
echo "| case, MTU $mtu, speed $speed | messages received | of | inertial samples missing | chunks missing | rows | LOST s | APE cm |"
echo "|---|---|---|---|---|---|---|---|"
for case in "${cases[@]}"; do run_case "$case"; done
