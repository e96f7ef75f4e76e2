#!/usr/bin/env bash
# Contact sheets of every built-in scene in every preset beside the reference: out/sheets/rest.png (frame 32 of a still
# view) and motion.png (frame 23 of an orbit of 1.5 degrees a frame). Made to be looked at; half an hour on two cores.
# Pictures that exist are kept: delete out/sheets/ after the program has changed. Needs a built program (./demo.sh).
#   docs/sheets.sh [SCENE...]    some scenes alone
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
reflet=build/bin/reflet
presets=(direct fast balanced quality hybrid)
size=240x135
frame=023
orbit=(--frames 240 --path orbit)

scenes=("$@")
((${#scenes[@]})) || mapfile -t scenes < <("$reflet" list scenes | sed -nE 's/^builtin:([^ ]+).*/\1/p')
rest=()
motion=()
for scene in "${scenes[@]}"; do
    folder=out/sheets/$scene
    mkdir -p "$folder"
    [[ -f "$folder/truth.png" ]] ||
        "$reflet" reference "builtin:$scene" --size $size --spp 128 --quiet -o "$folder/truth.png"
    "$reflet" reference "builtin:$scene" --size $size --spp 128 --quiet "${orbit[@]}" --share 24/240 -o "$folder/moving-truth-###.png"
    rest+=("$folder/truth.png")
    motion+=("$folder/moving-truth-$frame.png")
    for preset in "${presets[@]}"; do
        picture=$folder/$preset.png
        [[ -f "$picture" ]] ||
            "$reflet" render "builtin:$scene" --size $size --preset "$preset" --frames 32 --quiet -o "$picture"
        # The second segment of twelve frames; without a history every frame is one of its own.
        share=(--segment 12 --warmup 12 --share 2/20)
        [[ "$preset" != direct ]] || share=(--share 24/240)
        "$reflet" render "builtin:$scene" --size $size --preset "$preset" --quiet "${orbit[@]}" "${share[@]}" \
            -o "$folder/moving-$preset-###.png"
        rest+=("$picture")
        motion+=("$folder/moving-$preset-$frame.png")
    done
    echo "$scene: $SECONDS s"
done
"$reflet" contact-sheet "${rest[@]}" --cell $size --columns 6 --gap 4 --names path --quiet -o out/sheets/rest.png
"$reflet" contact-sheet "${motion[@]}" --cell $size --columns 6 --gap 4 --names path --quiet -o out/sheets/motion.png
