#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
# The demo of package_test.sh, which runs in the bare system without the source tree: a simulated
# drive by replay and by liod, both judged.
set -euo pipefail
cd /tmp
ip link set lo up multicast on
ip route add 224.0.0.0/4 dev lo
lio-sim --scenario street --lidar vlp16 --imu xsens_mti10 --duration 20 --threads 2 --out drive \
  >/dev/null
lio-replay --config drive/config.yaml drive/log.lcm --out replay
lio-eval drive/truth.tum replay | grep 'APE position'
export LCM_DEFAULT_URL='udpm://239.255.76.67:7667?ttl=0'
liod --config drive/config.yaml --out live 2>liod.log &
liod=$!
until grep -qs listening liod.log; do
  kill -0 "$liod" || { cat liod.log >&2 && exit 1; }
  sleep 0.1
done
lcm-logplayer drive/log.lcm >/dev/null
sleep 2
kill -TERM "$liod"
wait "$liod"
lio-eval drive/truth.tum live | grep 'APE position'
lio-log info drive/log.lcm >/dev/null
source /usr/share/bash-completion/completions/liod
test -f /usr/share/man/man1/liod.1.gz || echo "demo: the manual pages are left out of this system"
test -f /lib/systemd/system/liod.service
