#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
# Installs the Debian package on a bare Debian and runs a drive there: see usage.
set -euo pipefail

usage() {
  cat <<'USAGE'
Usage: tools/package_test.sh [--suite NAME] [--keep]
Makes the packages of the built tree (tools/setup.sh), a bare Debian by debootstrap from the mirror
that this machine's own package sources name, installs liod there with what it depends on, and runs
the demo: simulate, replay, judge, and liod with lcm-logplayer, all with the installed programs.
Needs root, debootstrap and cpack, and 1 GB in /var/tmp; without them it says so and ends with 77.
  --suite NAME  release of Debian (that of this machine)
  --keep        leave the folder of the bare system, and say which it is
USAGE
}

cd "$(dirname "${BASH_SOURCE[0]}")/.."
suite=$(. /etc/os-release && echo "${VERSION_CODENAME:-stable}") keep=no
while (($#)); do
  case $1 in
    -h | --help) usage && exit 0 ;;
    --suite) suite=$2 && shift ;;
    --keep) keep=yes ;;
    *) echo "tools/package_test.sh: unknown argument $1; see --help" >&2 && exit 2 ;;
  esac
  shift
done

test_name=package
source tools/package_test/bare_system.sh
for tool in cpack dpkg-deb; do
  command -v "$tool" >/dev/null || skip "there is no $tool here"
done
make_bare_system "$suite"

echo "package: making the packages"
cpack -G DEB --config build/CPackConfig.cmake -B "$folder/deb" >"$folder/cpack.log" ||
  { cat "$folder/cpack.log" >&2 && exit 1; }
cp "$folder"/deb/liod_*.deb "$root/tmp/liod.deb"

echo "package: installing liod and lcm's player"
in_root apt-get -qq install -y --no-install-recommends /tmp/liod.deb liblcm-bin iproute2 \
  >>"$folder/apt.log" 2>&1 || { tail -n 20 "$folder/apt.log" >&2 && exit 1; }

echo "package: the demo with the installed programs"
cp tools/package_test/demo.sh "$root/tmp/demo.sh"
unshare -n chroot "$root" /usr/bin/env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin bash /tmp/demo.sh
echo "package: installed size $(in_root dpkg-query -W -f '${Installed-Size}' liod) kB"
