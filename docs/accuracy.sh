#!/usr/bin/env bash
# Makes docs/accuracy.md: errors of five presets on every built-in scene, of every tracing method and shadow filter, against
# the path-traced reference. Takes about half an hour on two cores, which should be idle otherwise because the tables have
# times. The reports with the images stay in out/accuracy*.
#
#     docs/accuracy.sh            makes the whole page
#     docs/accuracy.sh presets    only the first section, "All bounces"
#     docs/accuracy.sh stills     only the section "Stills", against references of 4096 samples: the first time, an hour more
#     docs/accuracy.sh convergence  only the section "Over frames at rest": a quarter of an hour
#     docs/accuracy.sh tables     all but the last two sections, "Shadows" and "Sources"
#     docs/accuracy.sh shadows    only the last two sections
#     docs/accuracy.sh sources    only the last section
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

reflet=${REFLET:-build/bin/reflet}
scenes=$("$reflet" list scenes | cut -d ' ' -f 1)
table=$(mktemp)
trap 'rm -f "$table"' EXIT

if [[ ${1:-} == shadows ]]; then
    sed '/^## Shadows$/,$d' docs/accuracy.md >"$table"
    { docs/accuracy_shadows.py && echo && docs/accuracy_sources.py; } >>"$table"
    cp "$table" docs/accuracy.md
    exit
fi
if [[ ${1:-} == sources ]]; then
    sed '/^## Sources$/,$d' docs/accuracy.md >"$table"
    docs/accuracy_sources.py >>"$table"
    cp "$table" docs/accuracy.md
    exit
fi

# Stills as `reflet render` makes them, with what the command line says by itself.
stills() {
    local folder=out/accuracy-stills scene
    mkdir -p "$folder"
    printf '## Stills\n\n`reflet render SCENE --size 320x180` (effort `normal`: up to 30 s, here on two cores) against references of 4096 samples.\n\n'
    printf '| scene | relative MSE | FLIP |\n|---|--:|--:|\n'
    for scene in cornell cave gloss moving mirror-hall colonnade lens glass; do
        [[ -f $folder/$scene-truth.exr ]] ||
            "$reflet" reference "builtin:$scene" --size 320x180 --spp 4096 -o "$folder/$scene-truth.exr" >&2
        rm -f "$folder/$scene.exr"
        "$reflet" render "builtin:$scene" --size 320x180 -o "$folder/$scene.exr" >&2
        "$reflet" compare "$folder/$scene.exr" "$folder/$scene-truth.exr" --json |
            LC_ALL=C awk -v scene="$scene" '/"relative_mse"/ { error = $2 + 0 } /"flip"/ { flip = $2 + 0 }
                END { printf "| %s | %.4f | %.3f |\n", scene, error, flip }'
    done
    printf '\nThe remaining error: in cave, few frames fit into the time, so fine relief is blurred;\n'
    printf 'in lens, depth of field is a post-process, which fails where glass is in front of the focal plane.\n'
}

# Error of frames at rest, down to the bias of each preset.
convergence() {
    local folder=out/accuracy-convergence pictures=docs/pictures/convergence scene
    mkdir -p "$folder" "$pictures"
    printf '## Over frames at rest\n\n'
    for scene in cornell cave gloss mirror-hall; do
        [[ -f $folder/$scene.json ]] ||
            "$reflet" bench "builtin:$scene" --preset fast,balanced,quality,hybrid,still --size 160x90 \
                --convergence 32,128,512 --truth-spp 1024 --first 1 --warmup 1 --frames 1 --no-bandwidth \
                --plot "$pictures/$scene.svg" --json "$folder/$scene.json" >&2
    done
    docs/accuracy_convergence.py "$folder"
}

# The page with one section made anew: what makes it, its heading, the next one's.
renewed() {
    sed "/^## $2\$/,\$d" docs/accuracy.md
    "$1"
    echo
    sed -n "/^## $3\$/,\$p" docs/accuracy.md
}

if [[ ${1:-} == stills || ${1:-} == convergence ]]; then
    if [[ $1 == stills ]]; then
        renewed stills "Stills" "Over frames at rest"
    else
        renewed convergence "Over frames at rest" "Tracing methods"
    fi >"$table"
    cp "$table" docs/accuracy.md
    exit
fi

section() {  # heading folder [option…]
    local heading=$1 folder=$2
    shift 2
    # shellcheck disable=SC2086  # a word for each scene
    "$reflet" report $scenes --size 320x180 --spp 256 -o "$folder" "$@"
    printf '\n## %s\n\n' "$heading"
    cat "$folder/table.md"
}

methods="linear halving fixed_point dda exhaustive hiz"

# Relative MSE and bias of diffuse light alone, with enough rays that noise is a small part of the error.
diffuse_table() {
    local scenes="cubes cornell cave" truth=out/accuracy-diffuse scene method
    mkdir -p "$truth"
    echo "| method | $(echo "$scenes" | sed 's/ / | /g') |"
    echo "|---|--:|--:|--:|"
    for scene in $scenes; do
        "$reflet" reference "builtin:$scene" --size 320x180 --spp 256 --bounces 1 --visible-only -o "$truth/$scene.exr" >&2
    done
    for method in $methods; do
        printf '| `%s` |' "$method"
        for scene in $scenes; do
            "$reflet" render "builtin:$scene" --preset plain --size 320x180 -o "$truth/$method.exr" --aov indirect_diffuse \
                --set "trace_screen.method=$method" --set trace_screen.light=direct --set trace_screen.thickness=0.1 \
                --set diffuse.rays=256 --set specular.rays=0
            "$reflet" compare "$truth/$method.exr:indirect_diffuse" "$truth/$scene.exr:indirect_diffuse" --json |
                LC_ALL=C awk '/"relative_mse"/ { error = $2 + 0 } /"bias"/ { bias = $2 + 0 }
                    END { printf " %.4f (%+.1f %%) |", error, 100 * bias }'
        done
        echo
    done
}

otherSections() {
    printf '\n## Tracing methods\n\nThe settings of `plain` except `trace_screen.method`; one bounce.\n\n'
    variants=()
    for method in $methods; do
        variants+=(--variant "$method=trace_screen.method=$method")
    done
    "$reflet" report builtin:cubes builtin:cave builtin:gloss builtin:mirror-hall --size 320x180 --spp 256 --bounces 1 \
        --preset direct -o out/accuracy-methods --set trace_screen.light=direct "${variants[@]}"
    cat out/accuracy-methods/table.md

    printf '\n## Diffuse light by tracing method\n\n'
    printf 'Relative MSE (and bias) of `indirect_diffuse` against visible-only with one bounce: 256 rays per pixel, %s\n\n' \
        '`trace_screen.thickness=0.1`, `trace_screen.light=direct`; otherwise the settings of `plain`.'
    diffuse_table
    echo
    if [[ ${1:-} == tables ]]; then
        sed -n '/^## Shadows$/,$p' docs/accuracy.md
    else
        docs/accuracy_shadows.py
        echo
        docs/accuracy_sources.py
    fi
}

{
    cat <<'TEXT'
# Accuracy

The error of the presets against a path-traced reference, and its cost, on all built-in scenes, including the cases where
it is bad. [performance.md](performance.md) summarises this page. Made by `docs/accuracy.sh`.
For artefacts known from other renderers, see [hard-cases.md](hard-cases.md).

- **truth** (the reference, ground truth): all light, path-traced by `reflet reference`.
- **visible-only**: the same, but scattered rays return light only from points that the camera sees, and from the
  environment. Its error against the reference, in a row of its own, is the limit of screen-space methods. A preset's error
  against visible-only is the error of its own approximations. The two errors need not add up: an approximation can make up
  for missing light.
- **relative MSE**: mean of (a - b)² / (b² + 0.01) over pixels and channels of linear light. **Bias**: of the mean radiance; above 0
  the image is too bright. **FLIP**: HDR-FLIP. `reflet compare --help` has all definitions.
- **noise of the references**: the relative MSE between one run of the reference and its converged result. Smaller
  differences are not significant. FLIP includes that noise, too.
- Each image is frame 32 of a static view, when temporal accumulation has converged.
TEXT
    echo
    sed -n '/^## What one sees$/,/^## All bounces$/p' docs/accuracy.md | sed '$d' # written by hand, after docs/sheets.sh
    section "All bounces" out/accuracy --preset direct,fast,balanced,quality,hybrid
    echo
    if [[ ${1:-} == presets ]]; then
        sed -n '/^## Stills$/,$p' docs/accuracy.md
    else
        stills
        echo
        convergence
        otherSections "$@"
    fi
} >"$table"
cp "$table" docs/accuracy.md
