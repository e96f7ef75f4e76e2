#!/usr/bin/env python3
"""Prints tables and plots of the section "Over frames at rest" of docs/accuracy.md from the folder's files of `reflet bench`;
called by docs/accuracy.sh. Needs Python's standard library."""
import json
import pathlib
import sys

SCENES = ["cornell", "cave", "gloss", "mirror-hall"]

folder = pathlib.Path(sys.argv[1])
print("""Relative MSE and FLIP of the image after 32, 128 and 512 frames of a static view, 160x90, against references of 1024 samples
(`docs/accuracy.sh convergence`). The error after 512 frames is nearly all bias. In gloss, glints of the sun appear in two pixels at a
mirror's edge after frame 128 in presets with full-resolution reflections: they raise relative MSE, while FLIP falls.
""")
frames = []
for scene in SCENES:
    for run in json.loads((folder / f"{scene}.json").read_text())["runs"]:
        points = run["convergence"]
        if not frames:
            frames = [point["frame"] for point in points]
            print("| scene | preset | " + " | ".join(map(str, frames)) + " |")
            print("|---|---|" + "--:|" * len(frames))
        cells = [f"{point['relative_mse']:.4f}, {point['flip']:.3f}" for point in points]
        print(f"| {scene} | `{run['variant']}` | " + " | ".join(cells) + " |")
print()
for scene in SCENES:
    print(f"![{scene}: relative MSE over frames, for each preset](pictures/convergence/{scene}.svg)")
