#!/usr/bin/env bash
# Makes docs/motion.md and docs/pictures/motion/*.png: faults in hard motion, by `reflet bench --motions`. The tables are kept
# in out/motion/ and not repeated; delete that folder after the program has changed. Takes about an hour on two cores, half
# of it for the references, which are cached.
#
#     docs/motion.sh           measures if that is missing, then writes the page
#     docs/motion.sh page      writes the page from an existing measurement
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

reflet=${REFLET:-build/bin/reflet}
out=out/motion
pictures=docs/pictures/motion
mkdir -p "$out" "$pictures"

if [[ ${1:-} != page && ! -f $out/motion.json ]]; then
    "$reflet" bench --motions all --preset fast,balanced,quality,hybrid --json "$out/motion.json" --strips "$pictures" \
        --markdown >"$out/motion.md"
fi

{
    cat <<'TEXT'
# In motion

Faults that come from motion: the error of frames in hard motion over that at rest, ghosts, lag and flicker, for the presets
that keep history. Made by `docs/motion.sh`; [bench.md](bench.md#hard-motion) defines the cases and the measures.

How to read a row: the case `pan-5` with a ratio of 1.8 has 1.8 times the error in motion that the same views have at rest.
A ghost of 5 % after 8 frames means that a pixel still shows a twentieth of the light that left it 8 frames ago. A lag of 3
means that the third frame after the step is the first within 10 %. A flicker of 1.3 means that the frames change by 30 %
more than settled pictures of the same poses and noise at rest do together. "–": the case has no such event, or too few
pixels.

| measure | target |
|---|---|
| ratio of errors | at most 1.5; pans 2 |
| ghost after 8 frames | at most 2 % |
| lag | at most 4 frames |
| flicker | at most 1.2 |

TEXT
    # The headings of the tables are of the third level.
    sed 's/^### /## /' "$out/motion.md"
    cat <<'TEXT'

## Pictures

For each case: the reference, then `fast`, `balanced`, `quality` and `hybrid` from top to bottom; the first, fourth and eighth
frame in motion, or after the step.
TEXT
    for picture in "$pictures"/*.png; do
        name=$(basename "$picture" .png)
        printf '\n**%s**\n\n![%s: the reference and four presets in three frames](pictures/motion/%s.png)\n' \
            "$name" "$name" "$name"
    done
} >docs/motion.md
