#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
# Makes third_party/three/three.bundle.min.js from npm's three.js: the parts that the page of lio-view
# uses (three_parts.js), in one file without a comment. A build does not run it: the file is committed,
# and third_party/README.md has its sum. It needs node with npm, and a registry that npm can reach.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
three=0.187.0 esbuild=0.28.2 # others give another file
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cp tools/view/three_parts.js "$folder/"
npm install --prefix "$folder" --no-save --no-audit --no-fund --silent "three@$three" "esbuild@$esbuild"
"$folder/node_modules/.bin/esbuild" "$folder/three_parts.js" --bundle --minify --format=esm \
  --target=es2020 --legal-comments=none --charset=ascii --log-level=warning \
  --outfile=third_party/three/three.bundle.min.js
cp "$folder/node_modules/three/LICENSE" third_party/three/LICENSE
(cd third_party && sha256sum three/*)
