# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
# A bare Debian in a folder of its own, for tests that ask how liod does on a fresh machine; sourced
# by package_test.sh and newcomer_test.sh.

# skip REASON: ends the test as one that was not run.
skip() {
  echo "$test_name: skipped: $1"
  exit 77
}

# make_bare_system SUITE: a minimal Debian in $root, from the mirror that this machine's own package
# sources name, which goes when the script ends unless $keep is yes. $folder holds it and the logs.
make_bare_system() {
  local suite=$1 mirror keyring=/usr/share/keyrings/debian-archive-keyring.gpg
  ((EUID == 0)) || skip "this needs root"
  command -v debootstrap >/dev/null || skip "there is no debootstrap here"
  [[ -f $keyring ]] || skip "the package debian-archive-keyring is missing"
  # The first address that apt reads packages of Debian from.
  mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' \
    "Codename: $suite" 'Component: main' 2>/dev/null | head -n 1)
  [[ -n $mirror ]] || skip "apt has no source of $suite; run apt-get update"

  folder=$(mktemp -d /var/tmp/lio_bare.XXXXXX)
  root=$folder/root
  trap remove_bare_system EXIT
  echo "$test_name: debootstrap $suite"
  debootstrap --variant=minbase "$suite" "$root" "$mirror" >"$folder/debootstrap.log" ||
    { tail -n 20 "$folder/debootstrap.log" >&2 && exit 1; }
  mount -t proc proc "$root/proc" || skip "proc cannot be mounted in the bare system"
  # The bare system asks for packages as this machine does.
  cp /etc/resolv.conf "$root/etc/" 2>/dev/null || true
  cp -r /etc/apt/apt.conf.d/. "$root/etc/apt/apt.conf.d/" 2>/dev/null || true
  in_root apt-get -qq update >"$folder/apt.log"
}

remove_bare_system() {
  umount "$root/proc" 2>/dev/null || true
  if [[ $keep == yes ]]; then echo "$test_name: the system is in $root"; else rm -rf "$folder"; fi
}

# in_root COMMAND...: runs it in the bare system, with nothing of this environment.
in_root() {
  chroot "$root" /usr/bin/env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root \
    DEBIAN_FRONTEND=noninteractive "$@"
}
