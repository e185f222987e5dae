#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
# The systemd unit is one that systemd takes, and as locked up as it claims to be.
#   service_test.sh LIOD.SERVICE LIOD
set -euo pipefail
if ! command -v systemd-analyze >/dev/null; then
  echo "skipped: there is no systemd-analyze here"
  exit 77
fi
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
unit=$folder/liod.service
# The program is not installed where the unit says.
sed "s|^ExecStart=[^ ]*|ExecStart=$2|; /^Documentation=/d" "$1" >"$unit"
systemd-analyze verify --man=no "$unit"
# An exposure of at most 2.0 of 10 counts as "OK"; a plain unit has 9.6.
systemd-analyze security --offline=yes --threshold=20 "$unit" | tail -n 1
