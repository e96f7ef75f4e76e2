#!/usr/bin/env bash
# Makes docs/accuracy.md: every built-in scene and preset, every tracing method and shadow filter, against the truth. Takes
# about half an hour on two cores, which should have nothing else to do: the tables have times. The pages with the pictures
# stay in out/accuracy*. `docs/accuracy.sh shadows` makes the sections "Shadows" and "Sources", the last two, alone, and
# leaves the rest as it is; `docs/accuracy.sh sources` only the last; `docs/accuracy.sh tables` all but these two.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

reflet=build/bin/reflet
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

section() {  # heading folder [option…]
    local heading=$1 folder=$2
    shift 2
    # shellcheck disable=SC2086  # a word for each scene
    "$reflet" report $scenes --size 320x180 --spp 256 -o "$folder" "$@"
    printf '\n## %s\n\n' "$heading"
    cat "$folder/table.md"
}

methods="linear halving fixed_point dda exhaustive hiz"

# Relative MSE and bias of diffuse light alone, at so many rays that their noise is a small part of it.
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

{
    cat <<'TEXT'
# Accuracy

Made by `docs/accuracy.sh`. How far each preset is from the path-traced truth, and how long it takes, on every built-in
scene. Nothing here is chosen to look good.

- **truth**: all the light there is, by `reflet reference`.
- **visible-only**: the same, but scattered rays bring light only from points that the camera sees (and from the
  environment). Its error against the truth, in a row of its own, is what no screen-space method can know. A preset's error
  against visible-only is what the preset itself gets wrong. Both need not add up: a guess can make up for what is not
  known.
- **relative MSE**: mean of (a - b)² / (b² + 0.01) over pixels and channels of linear light. **FLIP**: HDR-FLIP.
  `reflet compare --help` has all definitions.
- **noise of the references**: the relative MSE that a second run of the reference would have against the first one's
  limit; smaller differences mean nothing. FLIP sees that noise, too.
- All are shown at their sixth frame. Presets that clean (`denoise.enabled`) are better at their 32nd.
TEXT
    section "All bounces" out/accuracy
    section "One bounce" out/accuracy-one-bounce --bounces 1 --set trace_screen.light=direct

    printf '\n## Tracing methods\n\nThe settings of `plain` but for `trace_screen.method`; one bounce.\n\n'
    variants=()
    for method in $methods; do
        variants+=(--variant "$method=trace_screen.method=$method")
    done
    "$reflet" report builtin:cubes builtin:cave builtin:gloss builtin:mirror-hall --size 320x180 --spp 256 --bounces 1 \
        --preset direct -o out/accuracy-methods --set trace_screen.light=direct "${variants[@]}"
    cat out/accuracy-methods/table.md

    printf '\n## Diffuse light, method by method\n\n'
    printf 'Relative MSE (and bias) of `indirect_diffuse` against visible-only with one bounce: 256 rays a pixel, %s\n\n' \
        '`trace_screen.thickness=0.1`, `trace_screen.light=direct`; else the settings of `plain`.'
    diffuse_table
    echo
    if [[ ${1:-} == tables ]]; then
        sed -n '/^## Shadows$/,$p' docs/accuracy.md
    else
        docs/accuracy_shadows.py
        echo
        docs/accuracy_sources.py
    fi
} >"$table"
cp "$table" docs/accuracy.md
