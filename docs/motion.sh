#!/usr/bin/env bash
# Makes docs/motion.md and docs/pictures/motion/*.png: faults in hard motion, by `reflet bench --motions`. The measurements are kept
# in out/motion/ as JSON, one for each case, and not repeated; delete that folder after the program has changed. Takes half an
# hour on two cores, a quarter of it for the references, which are cached.
#
#     docs/motion.sh           makes the missing measurements, then writes the page
#     docs/motion.sh page      writes the page from existing measurements
#     docs/motion.sh NAME...   repeats these cases (pan-5, rods, …), then writes the page
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

reflet=${REFLET:-build/bin/reflet}
out=out/motion
pictures=docs/pictures/motion
mkdir -p "$out" "$pictures"

measure() {
    echo "== $1" >&2
    "$reflet" bench --motions "$1" --preset fast,balanced,quality,hybrid --truth-spp 64 --json "$out/$1.json" \
        --strips "$pictures" --markdown >/dev/null
}

if [[ $# -gt 0 && $1 != page ]]; then
    for name in "$@"; do
        measure "$name"
    done
elif [[ $# -eq 0 ]]; then
    for name in pan-5 pan-15 rods leaves mirror lamp sun lamp-off lamp-on figures instances glass blended blended-pan cut look-back stop; do
        [[ -f $out/$name.json ]] || measure "$name"
    done
fi

docs/motion.py "$out"
