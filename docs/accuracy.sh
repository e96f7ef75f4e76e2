#!/usr/bin/env bash
# Makes docs/accuracy.md: every built-in scene and preset against the truth. Takes about ten minutes on two cores, which
# should have nothing else to do: the table has times. The pages with the pictures stay in out/accuracy*.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

reflet=build/bin/reflet
scenes=$("$reflet" list scenes | cut -d ' ' -f 1)
table=$(mktemp)
trap 'rm -f "$table"' EXIT

section() {  # heading folder [option…]
    local heading=$1 folder=$2
    shift 2
    # shellcheck disable=SC2086  # a word for each scene
    "$reflet" report $scenes --size 320x180 --spp 256 -o "$folder" "$@"
    printf '\n## %s\n\n' "$heading"
    cat "$folder/table.md"
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
- The presets have no denoiser: much of `default`'s and `fast`'s error is the grain of few rays.
TEXT
    section "All bounces" out/accuracy
    section "One bounce" out/accuracy-one-bounce --bounces 1
} >"$table"
cp "$table" docs/accuracy.md
