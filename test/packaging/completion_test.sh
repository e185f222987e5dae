#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
# Presses the tabulator key at command lines: the completions made from --help offer what is there.
#   completion_test.sh BUILD_FOLDER
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
# Outside of a completion bash knows no compopt.
compopt() { asked_files=yes; }

# offers "WORDS OF THE LINE" EXPECTED...: the reply to a tabulator behind the last word.
offers() {
  local line=$1 program asked_files=no expected
  shift
  read -ra COMP_WORDS <<<"$line"
  [[ $line != *' ' ]] || COMP_WORDS+=("")
  COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
  program=${COMP_WORDS[0]}
  COMPREPLY=()
  "_${program//-/_}"
  for expected in "$@"; do
    [[ $expected == files && $asked_files == yes ]] && continue
    [[ " ${COMPREPLY[*]} " == *" $expected "* ]] && continue
    echo "'$line' does not offer $expected but: ${COMPREPLY[*]}" && exit 1
  done
}

for program in liod lio-log lio-eval lio-view; do
  "$(dirname "$0")/../../packaging/completion.py" "$1/bin/$program" "$folder/$program"
  # shellcheck source=/dev/null
  source "$folder/$program"
done
offers "liod --ch" --check --channel-prefix
offers "liod --config " files
offers "lio-log " info calibrate doctor export
offers "lio-view --log " files
offers "lio-view --b" --bind
offers "lio-log info --" --channel-prefix
offers "lio-log calibrate --c" --config
offers "lio-eval --align " none yaw se3
[[ -z $(offers "liod --set ") ]]
