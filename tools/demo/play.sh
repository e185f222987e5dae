#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
# Plays an LCM log with lcm-logplayer over real UDP multicast to liod. It uses an own network
# namespace when that is allowed, so that other LCM programs of this machine receive nothing, and
# otherwise, or with LIO_IN_NAMESPACE=no, the machine's multicast route.
#   tools/demo/play.sh LOG.lcm OUT_DIR SPEED LIOD_ARGUMENT...
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
export LCM_DEFAULT_URL=${LCM_DEFAULT_URL:-udpm://239.255.76.67:7667?ttl=0}

if [[ ${LIO_IN_NAMESPACE:-} != yes ]]; then
  for flags in $( ((EUID == 0)) && echo -n) -rn; do
    if [[ ${LIO_IN_NAMESPACE:-} != no ]] && unshare "$flags" true 2>/dev/null; then
      LIO_IN_NAMESPACE=yes exec unshare "$flags" "${BASH_SOURCE[0]}" "$@"
    fi
  done
  if ! ip route get 239.255.76.67 >/dev/null 2>&1; then
    echo "play: there is no multicast route, and no network namespace was made; as root run:" \
      "ip route add 224.0.0.0/4 dev lo" >&2
    exit 4
  fi
else
  ip link set lo up multicast on
  ip route add 224.0.0.0/4 dev lo
fi

log=$1 out=$2 speed=$3
shift 3
mkdir -p "$out"
# liod's messages go to a file, which shows when it listens and what it found odd.
"$root/build/bin/liod" "$@" --out "$out" --overwrite --map 2>"$out/liod.log" &
liod=$!
trap 'kill "$liod" 2>/dev/null || true' EXIT
until grep -qs listening "$out/liod.log"; do
  if ! kill -0 "$liod" 2>/dev/null; then
    trap - EXIT
    code=0
    wait "$liod" || code=$?
    cat "$out/liod.log" >&2
    exit "$code"
  fi
  sleep 0.05
done

lcm-logplayer --speed="$speed" "$log" >/dev/null
# All messages are sent now. liod is done when none of its threads has worked or waited for a core
# for a second, which on a busy machine is some time after the player's end. (Little CPU time proves
# nothing, because other processes may take it.)
works() {
  cat /proc/"$liod"/task/*/stat 2>/dev/null |
    awk '{ sub(/.*\) /, ""); if ($1 == "R" || $1 == "D") found = 1 } END { exit !found }'
}
quiet=0
for _ in {1..1200}; do
  if works; then quiet=0; else quiet=$((quiet + 1)); fi
  ((quiet < 10)) || break
  sleep 0.1
done
trap - EXIT
kill -TERM "$liod"
wait "$liod"
