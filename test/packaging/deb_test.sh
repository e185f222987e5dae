#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
# Makes the Debian packages of a built tree, asks lintian, and runs the programs as unpacked.
#   deb_test.sh BUILD_FOLDER
set -euo pipefail
for tool in cpack lintian dpkg-shlibdeps; do
  if ! command -v "$tool" >/dev/null; then
    echo "skipped: there is no $tool here"
    exit 77
  fi
done
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cpack -G DEB --config "$1/CPackConfig.cmake" -B "$folder" >"$folder/log" ||
  { cat "$folder/log" && exit 1; }
(cd "$folder" && lintian --fail-on error ./*.deb)
dpkg -x "$folder"/liod_*.deb "$folder/root"
for program in "$folder"/root/usr/bin/lio*; do
  [[ ${program##*/} == lio-spy ]] || "$program" --version
done
"$folder/root/usr/bin/liod" --print-options >/dev/null 2>&1 || (($? == 3)) # no rig is named
if command -v python3 >/dev/null; then
  (source "$folder/root/usr/share/bash-completion/completions/liod" && complete -p liod)
fi
if compgen -G "$folder/python3-liod_*.deb" >/dev/null; then
  dpkg -x "$folder"/python3-liod_*.deb "$folder/root"
  PYTHONPATH=$folder/root/usr/lib/python3/dist-packages \
    LIO_CONFIG_DIR=$folder/root/usr/share/liod/config /usr/bin/python3 -c \
    'import liod; print("python3-liod", liod.__version__, liod.Odometry(
       {"pipeline": {"use_imu": False}, "rig": {"lidar": {"model": "vlp16"}}}).status)'
  [[ $(dpkg-deb -f "$folder"/python3-liod_*.deb Depends) == *"liod (= "*python3-numpy* ]]
fi
grep -q uPlot "$folder/root/usr/share/doc/liod/copyright"
depends=$(dpkg-deb -f "$folder"/liod_*.deb Depends)
for library in liblcm1 libyaml-cpp libc6; do
  [[ $depends == *$library* ]] || { echo "no dependency on $library: $depends" && exit 1; }
done
