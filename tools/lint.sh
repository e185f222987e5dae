#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
# The checks of form: see usage.
set -euo pipefail

usage() {
  cat <<'USAGE'
Usage: tools/lint.sh [--fast]
The checks of form, those that fail fastest first:
  licence tags, length of files
  tools/lint/tests.py   every source has its test (docs/testing.md)
  tools/lint/layers.py  includes between folders follow tools/lint/layers.txt, as design.md draws it
  tools/lint/names.py   no two types or inline variables of one name, which the linker would mix up
  tools/lint/sizes.py   20 data members a class, 60 lines a function (exceptions: sizes.txt)
  tools/lint/prose.py   width of docs, sentences that have a subject
  clang-format, and clang-tidy over src/ (the checks and why others are off: .clang-tidy)
Needs what tools/setup.sh --tests installs and builds.
  --fast  without clang-tidy
USAGE
}

if [[ ${1:-} == -h || ${1:-} == --help ]]; then
  usage
  exit 0
fi
cd "$(dirname "${BASH_SOURCE[0]}")/.."

failed=0
complain() {
  echo "lint: $*" >&2
  failed=1
}

mapfile -t sources < <(find include src test tools examples -name '*.hpp' -o -name '*.cpp' | sort)
mapfile -t scripts < <(find tools test src examples setup.py .ci \
  -name '*.sh' -o -name '*.py' -o -name '*.pyi' -o -path .ci/run | sort)

for file in "${sources[@]}"; do
  lines=$(wc -l <"$file")
  ((lines <= 500)) || complain "$file has $lines lines; split it (500 is the wall, 300 the budget)"
done
while read -r file; do
  complain "$file lacks the two SPDX lines"
done < <(grep -L 'SPDX-License-Identifier: MIT' "${sources[@]}" "${scripts[@]}")

for check in tests layers names sizes prose; do
  /usr/bin/python3 -B "tools/lint/$check.py" || failed=1
done
clang-format --dry-run --Werror "${sources[@]}" || complain "run clang-format -i on the files above"

[[ ${1:-} == --fast ]] || /usr/bin/python3 tools/lint/tidy.py || failed=1
((failed == 0)) && echo "lint: ${#sources[@]} files in form"
exit $failed
