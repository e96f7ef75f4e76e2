#!/usr/bin/env bash
# Makes docs/performance.md and docs/pictures/performance-*.svg from measurements by `reflet bench`, which are kept in
# out/performance/ as JSON and not repeated; delete that folder after the program has changed. Takes about an hour on two
# cores, which should be idle otherwise. The table at the top of the page comes from docs/accuracy.md.
#
#     docs/performance.sh           makes the missing measurements, then writes the page
#     docs/performance.sh page      writes the page from existing measurements
#     docs/performance.sh NAME...   repeats these measurements (games202-cave, mirror, …), then writes the page
#     docs/performance.sh gpu       on a machine with a GPU: out/performance/gpu*.json; then docs/gpu.py
#
# CUBE1=FILE.gltf with FILE.view.json beside it: the assignment's scene, which is not part of the project. PRESET: the preset
# to compare with the targets [balanced]. Hand-written text is in docs/performance-notes.md.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

reflet=${REFLET:-build/bin/reflet}
out=out/performance
mkdir -p "$out"
preset=${PRESET:-balanced}
all_scenes=$("$reflet" list scenes | cut -d ' ' -f 1)
wanted=("$@")

# NAME ARGUMENT…: `reflet bench ARGUMENT…` into NAME.json.
measure() {
    local name=$1
    shift
    local file="$out/$name.json"
    if [[ ${#wanted[@]} -gt 0 && " ${wanted[*]} " != *" $name "* ]]; then
        return
    fi
    if [[ -f $file && ${#wanted[@]} -eq 0 ]]; then
        return
    fi
    echo "== $name: reflet bench $*" >&2
    "$reflet" bench "$@" --json "$file" --markdown >"$out/$name.md"
}

if [[ ${1:-} == gpu ]]; then
    wanted=()
    # shellcheck disable=SC2086  # a word for each scene
    measure gpu $all_scenes --preset fast,balanced,quality,hybrid --size 1920x1080 --truth none --first 1 --warmup 31
    measure gpu-sizes builtin:cave --preset fast,balanced,quality,hybrid --truth none --first 1 --warmup 31 \
        --sizes 1280x720,1920x1080,2560x1440,3840x2160
    # shellcheck disable=SC2086  # a word for each scene
    measure gpu-errors $all_scenes --preset fast,balanced,quality,hybrid --size 320x180 --first 1 --warmup 31 --frames 1
    exit
fi

if [[ ${1:-} != page ]]; then
    # Error against time: the presets to render with, and games202 with 5 and with 32 rays, which lights Lambert surfaces alone:
    # all are in the cave, few in the street.
    measure presets-cave builtin:cave --preset direct,games202,plain,fast,balanced,quality,hybrid \
        --variant games202-32=games202,diffuse.rays=32 --size 640x360 --truth-spp 256 --first 1 --warmup 31 --frames 3 \
        --plot "$out/presets-cave.svg"
    measure presets-street builtin:street --preset direct,plain,fast,balanced,quality,hybrid --size 640x360 \
        --truth-spp 256 --first 1 --warmup 31 --frames 3 --plot "$out/presets-street.svg"
    # A whole frame, with reflections and all, against the GAMES202 method.
    against=(--compare "preset:$preset" preset:games202,diffuse.rays=32 --compare preset:fast preset:games202,diffuse.rays=32
        --size 640x360 --truth-spp 256 --first 2 --warmup 31 --frames 3)
    measure games202-cave builtin:cave "${against[@]}"
    if [[ -n ${CUBE1:-} ]]; then
        measure games202-cube1 "$CUBE1" --view-file "${CUBE1%.gltf}.view.json" "${against[@]}"
    fi
    # Reflections: a full-screen mirror.
    measure mirror builtin:mirror-hall --view-file docs/methods/views/into-the-mirror-without-sky.json --size 640x360 \
        --compare "preset:$preset" \
        preset:games202_linear,materials.lambert_only=false,specular.rays=1,trace_screen.max_steps=150 \
        --layer indirect_specular --truth-spp 256 --first 2 --warmup 31 --frames 3
    # Soft shadows against hard ones.
    measure shadow builtin:colonnade builtin:cave builtin:street --size 1280x720 --truth none --first 3 \
        --compare "preset:$preset,diffuse.rays=0,specular.rays=0,shadow.filter=pcss" \
        "preset:$preset,diffuse.rays=0,specular.rays=0,shadow.filter=hard"
    # Pixels and triangles.
    measure sizes builtin:cave builtin:street --preset "$preset" --sizes 640x360,1280x720,1920x1080,3840x2160 --truth none --first 1 \
        --warmup 2 --frames 5
    measure triangles-100 builtin:tessellated-100 --preset "$preset" --size 1280x720 --truth none
    measure triangles-1000000 builtin:tessellated-1000000 --preset "$preset" --size 1280x720 --truth none
fi

docs/performance.py "$out"
