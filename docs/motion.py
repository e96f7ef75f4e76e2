#!/usr/bin/env python3
"""Writes docs/motion.md from the measurements of docs/motion.sh: motion.py FOLDER, which has JSON files of `reflet bench --motions`."""
import json
import os
import sys

PRESETS = ["fast", "balanced", "quality", "hybrid"]
PICTURES = "docs/pictures/motion"
# The target of the error ratio where it is not 1.5.
PANS = {"pan-5": 2.0, "pan-15": 2.0}
GHOST, LAG, FLICKER = 0.02, 4, 1.2

HEAD = """# In motion

Artefacts caused by motion: error of frames in hard motion relative to frames at rest, ghosting, lag and flicker, for the presets
that keep history. Made by `docs/motion.sh`; [bench.md](bench.md#hard-motion) defines the cases and the measures.

How to read a row: a ratio of 1.8 means 1.8 times the error of the same views at rest. A ghost of 5 % after 8 frames
means that a pixel still shows a twentieth of the light that left it 8 frames ago. A lag of 3 means that the third frame
after the first with the new light is within 10 % of the step, or of the error at rest. A flicker of 1.3 means that frames
change by 30 % more than converged images of the same poses and the noise at rest do together. "–": the case has no such
event, or too few pixels. Numbers in italics miss their target.

| measure | target |
|---|---|
| ratio of errors | at most 1.5; pans 2 |
| ghost after 8 frames | at most 2 % |
| lag | at most 4 frames |
| flicker | at most 1.2 |
"""

COLUMNS = ["case", "FLIP at rest", "in motion", "ratio", "ghost after 1 frame", "after 8", "lag, frames",
           "of indirect light", "flicker"]


def mean(values):
    return sum(values) / len(values)


def judged(text, good):
    return text if good else f"*{text}*"


def lag(run, prefix):
    values = run.get("lag", {}).get(prefix + "left")
    if not values or None in values:
        return "–"
    frames = run["lag"][prefix + "frames"]
    return judged(f"> {len(values) - 1}" if frames is None else str(frames), frames is not None and frames <= LAG)


def row(run):
    rest, moving = (mean(run[key]["displayed_flip"]) for key in ("error_at_rest", "error_in_motion"))
    ratio, flicker = run["error_ratio"], run["flicker_ratio"]
    first, last = run["ghost"]["left"][0], run["ghost"]["left"][-1]
    return [run["case"], f"{rest:.4f}", f"{moving:.4f}", judged(f"{ratio:.2f}", ratio <= PANS.get(run["case"], 1.5)),
            "–" if first is None else f"{100 * first:.1f} %",
            "–" if last is None else judged(f"{100 * last:.1f} %", last <= GHOST),
            lag(run, ""), lag(run, "indirect_"), judged(f"{flicker:.2f}", flicker <= FLICKER)]


# How many of the cases that have each measure meet its target.
def summary(runs):
    lines = ["| preset | ratio | ghost | lag | flicker |", "|---|--:|--:|--:|--:|"]
    for preset in PRESETS:
        rows = [row(run) for run in runs if run["variant"] == preset]
        counts = []
        for name in ("ratio", "after 8", "lag, frames", "flicker"):
            values = [r[COLUMNS.index(name)] for r in rows]
            values = [value for value in values if value != "–"]
            counts.append(f"{sum(not value.startswith('*') for value in values)} of {len(values)}")
        lines.append(f"| `{preset}` | " + " | ".join(counts) + " |")
    return "\n".join(lines)


def table(runs):
    lines = ["| " + " | ".join(COLUMNS) + " |", "|---" + "|--:" * (len(COLUMNS) - 1) + "|"]
    return "\n".join(lines + ["| " + " | ".join(row(run)) + " |" for run in runs])


def main():
    files = [json.load(open(os.path.join(sys.argv[1], name), encoding="utf-8"))
             for name in sorted(os.listdir(sys.argv[1])) if name.endswith(".json")]
    runs = [run for file in files for run in file["motions"]]
    first = files[0]
    with open("docs/motion.md", "w", encoding="utf-8") as page:
        page.write(HEAD)
        page.write(f"\nMeasured with reflet {first['reflet']} on {first['device']}, {first['size'][0]}x{first['size'][1]} pixels.\n")
        page.write(f"\nCases that meet their target:\n\n{summary(runs)}\n")
        for preset in PRESETS:
            own = sorted((run for run in runs if run["variant"] == preset), key=lambda run: run["case"])
            if own:
                page.write(f"\n## {preset}\n\n{table(own)}\n")
            missing = sorted({run["case"] for run in runs} - {run["case"] for run in own})
            if own and missing:
                page.write(f"\nNot measured yet: {', '.join(missing)}.\n")
        page.write("\n## Pictures\n\nFor each case: the reference, then a row for each preset that has the case, in the order above; the "
                   "first and the\neighth frame in motion, or after the step.\n")
        for name in sorted({run["case"] for run in runs}):
            if os.path.exists(f"{PICTURES}/{name}.png"):
                page.write(f"\n**{name}**\n\n![{name}: the reference and presets in two frames](pictures/motion/{name}.png)\n")


if __name__ == "__main__":
    main()
