#!/usr/bin/env bash
# Builds reflet and renders every built-in scene to out/NAME.png. A second run builds and renders only what changed.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

./setup.sh
# The first time without the tests, which need more packages; a build that has them keeps them.
if [[ ! -f build/build.ninja ]]; then
    cmake --preset release -DREFLET_TESTS=OFF
fi
cmake --build --preset release --parallel "$(nproc)" --target reflet

reflet=build/bin/reflet
mkdir -p out
# To a variable first: a failure within `for … in $(…)` would go unnoticed.
scenes=$("$reflet" list scenes)
while read -r scene _; do
    picture="out/${scene#builtin:}.png"
    if [[ "$picture" -nt "$reflet" ]]; then
        echo "$picture is up to date"
    else
        "$reflet" render "$scene" --size 1280x720 -o "$picture"
        echo "$picture"
    fi
done <<<"$scenes"
echo "The pictures are in $PWD/out. A window into a scene: $reflet view builtin:cave. More: $reflet --help"
