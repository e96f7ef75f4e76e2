#!/usr/bin/env python3
"""Writes docs/gpu.md from the measurements of `docs/performance.sh gpu`: docs/gpu.py [out/performance].

Hand-written text is under the heading "On a GPU" of docs/performance-notes.md.
"""
import os
import sys

from performance import ROOT, Targets, group_ms, load, ms, read_notes, short, submitted

PAGE = os.path.join(ROOT, "docs", "gpu.md")
PRESETS = ("fast", "balanced", "quality", "hybrid")


def by_scene(runs):
    """scene: {preset: run}, in the order of measurement."""
    scenes = {}
    for run in runs:
        scenes.setdefault(short(run["scene"]), {})[run["variant"]] = run
    return scenes


def table(head, rows, value):
    """rows: name: {preset: run}."""
    lines = [f"| {head} | {' | '.join(f'`{p}`' for p in PRESETS)} |", "|---|" + "--:|" * len(PRESETS)]
    for name, runs in rows.items():
        lines.append(f"| {name} | {' | '.join(value(runs[p]) if p in runs else '' for p in PRESETS)} |")
    return "\n".join(lines)


def frame(run):
    return ms(run["steady"]["frame_ms"]["median"])


def passes(runs, most=14):
    """The slowest passes of one scene, for each preset."""
    names = sorted({n for run in runs.values() for n in run["steady"]["passes"]},
                   key=lambda n: -max(run["steady"]["passes"].get(n, {}).get("median", 0.0) for run in runs.values()))
    rows = {f"`{n}`": {p: run["steady"]["passes"].get(n) for p, run in runs.items()} for n in names[:most]}
    return table("pass", rows, lambda one: ms(one["median"]) if one else "")


def targets(frames):
    """Effects of `balanced`, each in its slowest scene, against what was aimed at."""
    own = [run for run in frames["runs"] if run["variant"] == "balanced"]

    def shadow_ms(run):
        return sum(p["median"] for name, p in run["steady"]["passes"].items()
                   if ("shadow" in name or "visibility" in name) and not p["raster"])

    result = Targets()
    for what, limit, time in (("denoised specular light", 0.5, lambda run: group_ms(run, "specular")),
                              ("denoised diffuse light", 0.5, lambda run: group_ms(run, "diffuse")),
                              ("denoised PCSS", 0.2, shadow_ms)):
        worst = max(own, key=time)
        result.add(f"{what} of `balanced`, 1920x1080", f"{limit} ms", f"{time(worst):.3f} ms (`{short(worst['scene'])}`)",
                   time(worst) <= limit)
    return ["## Targets", "Met:", result.table(missed=False), "Missed:", result.table(missed=True)]


def main():
    folder = sys.argv[1] if len(sys.argv) > 1 else os.path.join(ROOT, "out", "performance")
    frames, sizes, errors = (load(folder, name) for name in ("gpu", "gpu-sizes", "gpu-errors"))
    if frames is None:
        sys.exit(f"docs/gpu.py: there is no {folder}/gpu.json; run docs/performance.sh gpu on a machine with a GPU")
    scenes = by_scene(frames["runs"])
    parts = ["# On a GPU",
             "The cost of frames on a GPU, and a check that their errors agree with the CPU device. Made by `docs/performance.sh gpu` and "
             "`docs/gpu.py`; the hand-written text is in `performance-notes.md`.",
             f"**{frames['device']}**, driver {frames['driver']}; {frames['bandwidth_bytes_per_s'] / 1e9:.0f} GB/s measured. "
             "Milliseconds are medians of 20 frames by the device's timestamps.",
             read_notes().get("On a GPU", ""),
             "## Frames at 1920x1080", table("scene", scenes, frame),
             "Host time to record a frame, ms:", table("scene", {n: scenes[n] for n in ("cave", "glass") if n in scenes},
                                                     lambda run: ms(run["steady"]["record_ms"]["median"])),
             "The first frame of a view, without history and with its probes captured, ms from submission to fence:",
             table("scene", {n: scenes[n] for n in ("cave", "glass") if n in scenes}, lambda run: ms(submitted(run, "first")))]
    if sizes:
        rows = {}
        for run in sizes["runs"]:
            rows.setdefault("{}x{}".format(*run["size"]), {})[run["variant"]] = run
        parts += ["## Sizes", "`builtin:cave`.", table("size", rows, frame)]
    parts += ["## Passes", "The slowest passes of `builtin:cave` at 1920x1080.", passes(scenes["cave"])]
    if errors:
        parts += ["## Errors", "HDR-FLIP of frame 32 to the path-traced reference, 320x180. [accuracy.md](accuracy.md) has all "
                  "measures.",
                  table("scene", by_scene(errors["runs"]), lambda run: f"{run['steady']['error']['flip']:.4f}")]
    parts += targets(frames)
    with open(PAGE, "w", encoding="utf-8") as file:
        file.write("\n\n".join(part for part in parts if part) + "\n")


if __name__ == "__main__":
    main()
