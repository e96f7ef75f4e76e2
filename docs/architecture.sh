#!/usr/bin/env bash
# Writes the diagram of the frame into docs/architecture.md, between its two comments. A test compares it with the program.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

reflet=${REFLET:-build/bin/reflet}
page=docs/architecture.md
made=$(mktemp)
trap 'rm -f "$made"' EXIT

{
    sed '/^<!-- passes: /q' "$page"
    echo '```mermaid'
    "$reflet" list passes builtin:cubes --preset balanced --format mermaid
    echo '```'
    sed -n '/^<!-- end of passes -->$/,$p' "$page"
} >"$made"
cp "$made" "$page"
