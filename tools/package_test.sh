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

skip() {
  echo "package: skipped: $1"
  exit 77
}
((EUID == 0)) || skip "this needs root"
for tool in debootstrap cpack dpkg-deb; do
  command -v "$tool" >/dev/null || skip "there is no $tool here"
done
# The first address that apt reads packages of Debian from.
mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' "Codename: $suite" \
  'Component: main' 2>/dev/null | head -n 1)
[[ -n $mirror ]] || skip "apt has no source of $suite; run apt-get update"

folder=$(mktemp -d /var/tmp/lio_package.XXXXXX)
root=$folder/root
clean_up() {
  umount "$root/proc" 2>/dev/null || true
  if [[ $keep == yes ]]; then echo "package: the system is in $root"; else rm -rf "$folder"; fi
}
trap clean_up EXIT

echo "package: making the packages"
cpack -G DEB --config build/CPackConfig.cmake -B "$folder/deb" >"$folder/cpack.log" ||
  { cat "$folder/cpack.log" >&2 && exit 1; }
echo "package: debootstrap $suite"
keyring=(/usr/share/keyrings/debian-archive-keyring.gpg)
[[ -f ${keyring[0]} ]] || skip "the package debian-archive-keyring is missing"
debootstrap --variant=minbase "$suite" "$root" "$mirror" >"$folder/debootstrap.log" ||
  { tail -n 20 "$folder/debootstrap.log" >&2 && exit 1; }
mount -t proc proc "$root/proc" || skip "proc cannot be mounted in the bare system"
cp "$folder"/deb/liod_*.deb "$root/tmp/liod.deb"
# The bare system asks for packages as this machine does.
cp /etc/resolv.conf "$root/etc/" 2>/dev/null || true
cp -r /etc/apt/apt.conf.d/. "$root/etc/apt/apt.conf.d/" 2>/dev/null || true

in_root() { chroot "$root" /usr/bin/env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root \
  DEBIAN_FRONTEND=noninteractive "$@"; }
echo "package: installing liod and lcm's player"
in_root apt-get -qq update >"$folder/apt.log"
in_root apt-get -qq install -y --no-install-recommends /tmp/liod.deb liblcm-bin iproute2 \
  >>"$folder/apt.log" 2>&1 || { tail -n 20 "$folder/apt.log" >&2 && exit 1; }

echo "package: the demo with the installed programs"
cp tools/package_test/demo.sh "$root/tmp/demo.sh"
unshare -n chroot "$root" /usr/bin/env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin bash /tmp/demo.sh
du -sh "$root/usr/bin" >/dev/null
echo "package: installed size $(in_root dpkg-query -W -f '${Installed-Size}' liod) kB"
