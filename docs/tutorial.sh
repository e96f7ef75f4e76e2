#!/usr/bin/env bash
# Makes the pictures of docs/tutorial.md, docs/tutorial/*.png: runs the commands of its code blocks in a temporary folder.
# Needs a built program (./demo.sh).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
root=$PWD
mkdir -p docs/tutorial

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
ln -s "$root/build" "$work/build"
# Lines of code blocks that call the program, with the lines that continue them.
awk '/^    build\/bin\/reflet / { on = 1 } on { sub(/^    /, ""); print; on = /\\$/ }' docs/tutorial.md >"$work/commands"
(cd "$work" && bash -euxo pipefail commands)
cp "$work"/[0-9][0-9]-*.png docs/tutorial/
printf '%s\n' docs/tutorial/*.png
