#!/usr/bin/env bash
# Renders the images of the documentation, docs/pictures/. Needs a built program (./demo.sh); the last two also cwebp and
# img2webp (apt install webp).
#     docs/pictures.sh           the pictures of the manual
#     docs/pictures.sh street    the picture of the README; half an hour on two cores, most of it for the reference
#     docs/pictures.sh moving    the animations, docs/pictures/moving/*.webp; a quarter of an hour on two cores
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
reflet=${REFLET:-build/bin/reflet}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p docs/pictures/moving

# The night in three bands: direct light, the default preset, the reference.
street() {
    local scene=(builtin:street --size 640x360)
    "$reflet" render "${scene[@]}" --preset direct -o "$work/direct.png"
    "$reflet" render "${scene[@]}" --preset balanced -o "$work/balanced.png"
    "$reflet" reference "${scene[@]}" --spp 256 -o "$work/reference.png"
    docs/street.py "$work"/{direct,balanced,reference}.png "$work/wipe.png"
    cwebp -quiet -q 94 -m 6 "$work/wipe.png" -o docs/pictures/street-wipe.webp
}

# animation NAME MILLISECONDS PICTURE...: an endless loop.
animation() {
    local file="docs/pictures/moving/$1.webp" time=$2
    shift 2
    img2webp -loop 0 -lossy -q 62 -m 6 -d "$time" "$@" -o "$file"
    echo "$file: $(stat -c %s "$file") bytes"
}

# sequence NAME FRAMES FRAMES_PER_SECOND SCENE OPTION...
sequence() {
    local name=$1 frames=$2 rate=$3 scene=$4
    shift 4
    "$reflet" render "$scene" --preset balanced --size 320x180 --frames "$frames" --fps "$rate" --segment 0 "$@" \
        -o "$work/${name}_####.png"
    animation "$name" $((1000 / rate)) "$work/${name}"_*.png
}

moving() {
    sequence street 48 12 builtin:street --path docs/views/street-flight.json
    sequence reflections 48 12 builtin:moving
    sequence light 24 24 builtin:motion-lamp
    "$reflet" render builtin:cave --preset direct --size 320x180 -o "$work/off.png"
    "$reflet" render builtin:cave --preset balanced --size 320x180 -o "$work/on.png"
    animation indirect 1500 "$work/off.png" "$work/on.png"
}

case "${1-}" in
    "") ;;
    street | moving)
        "$1"
        exit
        ;;
    *)
        echo "usage: docs/pictures.sh [street|moving]" >&2
        exit 2
        ;;
esac

render() { # SCENE NAME OPTION…
    local scene=$1 file="docs/pictures/$2.png"
    shift 2
    "$reflet" render "builtin:$scene" -o "$file" "$@"
    echo "$file"
}

# Several bounces: hits return the previous frame's light, so each frame adds one bounce.
bounces=(--preset plain --set trace_screen.light=previous --set temporal.enabled=true)
render cornell cornell "${bounces[@]}" --frames 4 --set diffuse.rays=64 --size 320x240
render cornell cornell-direct --preset direct --size 320x240
render mirror-hall mirror-hall "${bounces[@]}" --frames 6 --set specular.rays=4 --size 448x252
render mirror-hall mirror-hall-source --preset plain --size 448x252 --show specular_source
for show in albedo normal depth sun_visibility direct indirect_diffuse indirect_specular source; do
    render cubes "cubes-$show" --preset plain --set diffuse.rays=16 --size 320x180 --show "$show"
done

# The reference, its visible-only part, the default settings and their error.
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
