#!/bin/sh
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
# Draws a contact sheet of all scenarios: one bird's-eye view each, with the path of the vehicle.
#   tools/sim/contact_sheet.sh [OUT.png] [SEED]     (docs/images/contact_sheet.png, seed 1)
# Needs a build (tools/setup.sh) and Debian's python3-matplotlib. LIO_BUILD may name a build folder.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
build=${LIO_BUILD:-$here/../../build}
out=${1:-$here/../../docs/images/contact_sheet.png}
seed=${2:-1}
sim=$build/bin/lio-sim
if [ ! -x "$sim" ]; then
  echo "contact_sheet.sh: no $sim: run tools/setup.sh first, or set LIO_BUILD" >&2
  exit 5
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
for name in $("$sim" --list); do
  "$sim" --scenario "$name" --seed "$seed" --threads "$(nproc)" --picture "$work/$name.ppm"
done
"$sim" --list >"$work/names"
/usr/bin/python3 -B "$here/contact_sheet.py" "$work" "$out"
