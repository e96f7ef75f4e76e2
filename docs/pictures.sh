#!/usr/bin/env bash
# Renders the images of the documentation, docs/pictures/*.png. Needs a built program (./demo.sh).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
mkdir -p docs/pictures

render() { # SCENE NAME OPTION…
    local scene=$1 file="docs/pictures/$2.png"
    shift 2
    build/bin/reflet render "builtin:$scene" -o "$file" "$@"
    echo "$file"
}

# Several bounces: hits return the previous frame's light, so each frame adds one bounce.
bounces=(--preset plain --set trace_screen.light=previous --set temporal.enabled=true)
render cubes cubes "${bounces[@]}" --frames 8 --set diffuse.rays=64 --size 560x315
render cornell cornell "${bounces[@]}" --frames 4 --set diffuse.rays=64 --size 320x240
render cornell cornell-direct --preset direct --size 320x240
render mirror-hall mirror-hall "${bounces[@]}" --frames 6 --set specular.rays=4 --size 448x252
render mirror-hall mirror-hall-source --preset plain --size 448x252 --show specular_source
for show in albedo normal depth sun_visibility direct indirect_diffuse indirect_specular source; do
    render cubes "cubes-$show" --preset plain --set diffuse.rays=16 --size 320x180 --show "$show"
done

# The reference, its visible-only part, the default settings and their error.
reflet=build/bin/reflet
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$reflet" reference builtin:cubes --size 320x180 --spp 1024 -o docs/pictures/cubes-truth.png -o "$work/truth.exr"
"$reflet" reference builtin:cubes --size 320x180 --spp 1024 --visible-only -o docs/pictures/cubes-visible-only.png
"$reflet" render builtin:cubes --preset balanced --size 320x180 -o docs/pictures/cubes-default.png -o "$work/default.exr"
"$reflet" compare "$work/default.exr" "$work/truth.exr" --heatmap docs/pictures/cubes-default-error.png

# The window, on a virtual display.
if command -v xvfb-run >/dev/null; then
    XDG_CONFIG_HOME=$work xvfb-run -a -s "-screen 0 1600x1000x24" "$reflet" view builtin:mirror-hall --size 440x400 --pick 385,178 \
        --window-picture docs/pictures/view.png
else
    echo "docs/pictures/view.png: not made (no xvfb-run)" >&2
fi
