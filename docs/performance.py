#!/usr/bin/env python3
"""Writes docs/performance.md from the measurements of docs/performance.sh: docs/performance.py [out/performance].

The table at the top takes its figures from docs/accuracy.md and the presets' descriptions. Hand-written text is in
docs/performance-notes.md: text under a heading there is appended to the section of the same heading.
"""
import json
import os
import re
import shutil
import statistics
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
PAGE = os.path.join(ROOT, "docs", "performance.md")
NOTES = os.path.join(ROOT, "docs", "performance-notes.md")
ACCURACY = os.path.join(ROOT, "docs", "accuracy.md")
PRESETS = os.path.join(ROOT, "src", "renderer", "presets")
PICTURE = os.path.join("pictures", "performance.svg")

# Milliseconds of the GAMES202 assignment's original program on such a machine, at 1280x720, and by the number of pixels at
# 640x360; see methods/games202.md.
ORIGINAL_MIRROR_MS = 120.0 / 4.0


def load(folder, name):
    path = os.path.join(folder, name + ".json")
    if not os.path.exists(path):
        return None
    with open(path, encoding="utf-8") as file:
        return json.load(file)


def read_notes():
    notes, heading = {}, None
    if os.path.exists(NOTES):
        with open(NOTES, encoding="utf-8") as file:
            for line in file:
                if line.startswith("## "):
                    heading = line[3:].strip()
                    notes[heading] = ""
                elif heading:
                    notes[heading] += line
    return {heading: text.strip() for heading, text in notes.items()}


def ms(value):
    return f"{value:.3f}" if value < 10 else f"{value:.2f}" if value < 100 else f"{value:.0f}"


def spread(values):
    return f"{ms(values['median'])} ({ms(values['lower_quartile'])}–{ms(values['upper_quartile'])})"


def short(scene):
    return os.path.basename(scene).removeprefix("builtin:").removesuffix(".gltf")


def submitted(run, state="steady"):
    return run[state]["submitted_ms"]["median"]


def ratio(pair, state="steady"):
    return pair[state]["submitted"]["ratio"]["median"]


class Targets:
    """Rows of the tables at the end of the page, by whether the target was missed (not measured: it was not)."""

    def __init__(self):
        self.rows = {False: [], True: []}

    def add(self, what, limit, value, met):
        self.rows[met is False].append(f"| {what} | {limit} | {value} |")

    def missing(self, what, limit):
        self.add(what, limit, "not measured", None)

    def table(self, missed):
        rows = self.rows[missed]
        return "\n".join(["| target | limit | measured |", "|---|---|---|", *rows]) if rows else "None."


# Of `games202`'s time with 32 rays: in the steady state, and in the first frame.
AGAINST_GAMES202 = (("balanced", 40, 8), ("fast", 60, 12))


def against_games202(folder, targets):
    for name, scene in (("games202-cube1", "cube1"), ("games202", "cave")):
        data = load(folder, name)
        for index, (preset, steady, first) in enumerate(AGAINST_GAMES202):
            for what, state, limit in (("whole frame, steady state", "steady", steady), ("first frame", "first", first)):
                what = f"`{preset}`, `{scene}`, {what}, against `games202` with 32 rays"
                bound = f"1/{limit} of the time, no higher error"
                if data is None:
                    targets.missing(what, bound)
                    continue
                own, other = data["runs"][2 * index], data["runs"][2 * index + 1]
                times = 1 / ratio(data["comparisons"][index], state)
                error = own[state]["error"]["relative_mse"], other[state]["error"]["relative_mse"]
                targets.add(what, bound, f"1/{times:.0f} (interleaved; {ms(submitted(own, state))} of {ms(submitted(other, state))} ms); "
                            f"relative MSE {error[0]:.5f} against {error[1]:.5f}", times >= limit and error[0] <= error[1])


def group_ms(run, group, state="steady"):
    return run[state]["groups"].get(group, {}).get("median", 0.0)


def mirror(folder, targets):
    what, limit = "full-screen mirror, against `games202_linear` with 150 steps", "no more time, 1/4 of the error"
    data = load(folder, "mirror")
    if data is None:
        targets.missing(what, limit)
        return
    own, other = data["runs"]
    times = group_ms(own, "specular"), group_ms(other, "specular")
    errors = own["steady"]["error"]["relative_mse"], other["steady"]["error"]["relative_mse"]
    targets.add(what, limit, f"{ms(times[0])} ms against {ms(times[1])} ms (original program: {ORIGINAL_MIRROR_MS:.0f} ms "
                f"for a whole frame); relative MSE {errors[0]:.5f} against {errors[1]:.5f}",
                times[0] <= times[1] and 4 * errors[0] <= errors[1])


def shadow(folder, targets):
    data = load(folder, "shadow")
    if data is None:
        targets.missing("denoised PCSS, cost above hard shadows", "60 ms")
        return
    for pair in data["comparisons"]:
        more = pair["steady"]["submitted"]["difference_ms"]["median"]
        targets.add(f"denoised PCSS, cost above hard shadows, `{short(pair['scene'])}`", "60 ms", f"{ms(more)} ms", more <= 60)


def pixels_and_triangles(folder, targets):
    data = load(folder, "sizes")
    if data is None:
        targets.missing("cost per pixel, 640x360 to 3840x2160", "within 15 %")
    else:
        scaling = data["scaling"][0]
        targets.add("cost per pixel, 640x360 to 3840x2160", "within 15 %",
                    f"{', '.join(f'{ns:.0f}' for ns in scaling['ns_per_pixel'])} ns; {100 * scaling['spread']:.0f} %",
                    scaling["spread"] <= 0.15)
    few, many = load(folder, "triangles-100"), load(folder, "triangles-1000000")
    what = "all passes but geometry, with 100 and with 1,000,000 triangles"
    if few is None or many is None:
        targets.missing(what, "within 5 %")
        return
    a, b = (group_ms(data["runs"][0], "effects") for data in (few, many))
    targets.add(what, "within 5 %", f"{ms(a)} and {ms(b)} ms; {100 * (b / a - 1):+.1f} %", abs(b / a - 1) <= 0.05)


def gpu(folder, targets):
    data = load(folder, "gpu")
    limits = (("specular", 0.5), ("diffuse", 0.5))
    if data is None:
        for group, limit in limits:
            targets.missing(f"denoised {group} light on a GPU, 1920x1080", f"{limit} ms")
        targets.missing("denoised PCSS on a GPU, 1920x1080", "0.2 ms")
        return
    own = [run for run in data["runs"] if run["variant"] == "balanced"]
    for group, limit in limits:
        worst = max(own, key=lambda run: group_ms(run, group))
        value = group_ms(worst, group)
        targets.add(f"denoised {group} light on {data['device']}, 1920x1080", f"{limit} ms",
                    f"{value:.3f} ms (`{short(worst['scene'])}`)", value <= limit)

    def shadow_ms(run):
        return sum(p["median"] for name, p in run["steady"]["passes"].items()
                   if ("shadow" in name or "visibility" in name) and not p["raster"])
    worst = max(own, key=shadow_ms)
    targets.add(f"denoised PCSS on {data['device']}, 1920x1080", "0.2 ms",
                f"{shadow_ms(worst):.3f} ms (`{short(worst['scene'])}`)", shadow_ms(worst) <= 0.2)


def cost_and_error():
    """The table at the top: medians and ranges over the scenes of docs/accuracy.md, all bounces. Its rows are: scene,
    variant, relative MSE, bias and FLIP against the reference, the same against visible-only, milliseconds."""
    with open(ACCURACY, encoding="utf-8") as file:
        part = file.read().split("\n## All bounces\n", 1)[1].split("\n## ", 1)[0]
    scenes, variants = set(), {}
    for line in part.splitlines():
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        if line.startswith("| ") and re.fullmatch(r"[-+]?[\d.]+", cells[3]):
            scenes.add(cells[0])
            variants.setdefault(cells[1], []).append([float(cell) if cell else None for cell in cells[2:]])

    def cell(values, pattern):
        if None in values:
            return ""
        return f"{pattern} ({pattern}–{pattern})".format(statistics.median(values), min(values), max(values))

    def described(name):
        with open(os.path.join(PRESETS, name + ".json"), encoding="utf-8") as file:
            return json.load(file)["description"].split(";")[0]

    lines = ["| preset | ms per frame | HDR-FLIP to the reference | HDR-FLIP to visible-only | "
             "relative MSE to the reference, median | description |", "|---|--:|--:|--:|--:|---|"]
    for name, rows in sorted(variants.items(), key=lambda item: statistics.median(row[6] or 1e9 for row in item[1])):
        columns = list(zip(*rows))
        text = "the limit of screen-space methods" if name.startswith("*") else described(name)
        lines.append(f"| {name} | {cell(columns[6], '{:.0f}')} | {cell(columns[2], '{:.3f}')} | {cell(columns[5], '{:.3f}')} | "
                     f"{statistics.median(columns[0]):.4f} | {text} |")
    size = re.search(r"\d+x\d+", part)[0]
    named = re.search(r"times on (.*?)\. ", part)
    device = named[1] if named else "the device of accuracy.md"
    return device, size, len(scenes), "\n".join(lines)


def overview(folder):
    device, size, scenes, table = cost_and_error()
    text = (f"Per preset at {size} on {device}: the median over the {scenes} built-in scenes, with the lowest and highest in "
            "brackets. Milliseconds are device time. The *reference* is path-traced with all bounces; "
            "*visible-only* is the part of it that the camera sees, the best that a screen-space method can reach. Errors are "
            "those of frame 32. Values by scene are in [accuracy.md](accuracy.md).\n\n" + table)
    if data := load(folder, "sizes"):
        runs = data["runs"]
        text += (f"\n\nLarger images, from submission to fence, `{runs[0]['variant']}` on `{short(runs[0]['scene'])}`:\n\n"
                 "| size | ms per frame |\n|---|--:|\n"
                 + "\n".join(f"| {r['size'][0]}x{r['size'][1]} | {ms(submitted(r))} |" for r in runs))
    return text


def frames_table(data):
    """One row per run. Columns of errors that were not measured are left out."""
    runs = data["runs"]
    heads = ["scene", "size", "variant", "submitted, ms (quartiles)", "device, ms", "first frame, ms", "memory, MB"]
    rows = [[short(run["scene"]), f"{run['size'][0]}x{run['size'][1]}", run["variant"], spread(run["steady"]["submitted_ms"]),
             ms(run["steady"]["frame_ms"]["median"]), ms(submitted(run, "first")), f"{run['memory_bytes'] / 1e6:.0f}"]
            for run in runs]
    for head, state, name, digits in (("relative MSE: first", "first", "relative_mse", 5), ("steady", "steady", "relative_mse", 5),
                                      ("HDR-FLIP, steady", "steady", "flip", 4),
                                      ("FLIP of the tone-mapped image, steady", "steady", "displayed_flip", 4)):
        errors = [(run[state]["error"] or {}).get(name) for run in runs]
        if any(error is not None for error in errors):
            heads.append(head)
            for row, error in zip(rows, errors):
                row.append("" if error is None else f"{error:.{digits}f}")
    lines = [f"| {' | '.join(heads)} |", "|---|---|---|" + "--:|" * (len(heads) - 3)]
    return "\n".join(lines + [f"| {' | '.join(row)} |" for row in rows])


def roofline(run, bandwidth):
    lines = [f"`{short(run['scene'])}`, {run['variant']}, {run['size'][0]}x{run['size'][1]}; {bandwidth / 1e9:.1f} GB/s.", "",
             "| pass | ms (quartiles) | bound data, MB | bandwidth bound, ms | bound / time |", "|---|--:|--:|--:|--:|"]
    for name, one in sorted(run["steady"]["passes"].items(), key=lambda item: -item[1]["median"]):
        share = 100 * one["floor_ms"] / one["median"] if one["median"] > 0 else 0
        lines.append(f"| `{name}` | {spread(one)} | {one['bytes'] / 1e6:.1f} | {ms(one['floor_ms'])} | {share:.0f} % |")
    return "\n".join(lines)


def section(heading, text, notes):
    parts = [f"## {heading}", text]
    if notes.get(heading):
        parts.append(notes[heading])
    return "\n\n".join(part for part in parts if part)


def commands(folder):
    """The command line of every measurement."""
    lines = []
    for file in sorted(os.listdir(folder)):
        if file.endswith(".json"):
            data = load(folder, file.removesuffix(".json"))
            lines.append("    " + data["command"])
    return "\n".join(lines)


# Measurements, heading, and what the section shows.
SECTIONS = (
    (("games202", "games202-cube1"), "Whole frames against the GAMES202 method",
     "Diffuse light of Lambert surfaces, against the reference with all bounces. The preset `games202` is the "
     "method of [the GAMES202 assignment](methods/games202.md) with 32 rays."),
    (("mirror",), "Reflections", "A mirror that fills the screen, without sky; errors are those of the layer "
     "`indirect_specular` against the reference with all bounces."),
    (("shadow",), "Soft shadows", "Direct light only: PCSS with its denoiser, against hard shadows."),
    (("sizes",), "Cost per pixel", "One scene at four sizes."),
    (("triangles-100", "triangles-1000000"), "Triangles", "The same room with 100 and with 1,000,000 triangles."),
    (("rest",), "At rest", "A static camera, frame 32, against the same settings with 256 rays per pixel, averaged over "
     "frames and not denoised."),
)


def main():
    folder = sys.argv[1] if len(sys.argv) > 1 else os.path.join(ROOT, "out", "performance")
    notes = read_notes()
    targets = Targets()
    for add in (against_games202, mirror, shadow, pixels_and_triangles, gpu):
        add(folder, targets)
    presets = load(folder, "presets")
    parts = ["# Performance", "What a frame costs and how far it is from the reference.",
             section("Cost and error of the presets", overview(folder), notes),
             "## Measurements\n\nMade by `docs/performance.sh`; the hand-written text is in `performance-notes.md`. In all tables "
             "below, *submitted* is the host's time from submission to fence and *device* the time by the "
             "device's timestamps. On llvmpipe the timestamps miss clears, copies and the start of draws, so use *submitted* there. "
             "*First* is a frame without history, *steady* the state after a warm-up. `reflet bench --help` explains the other "
             "columns; see also [bench.md](bench.md)."]
    if presets:
        svg = os.path.join(folder, "presets.svg")
        if os.path.exists(svg):
            shutil.copyfile(svg, os.path.join(ROOT, "docs", PICTURE))
        parts.append(section("Error against time", f"{presets['device']} ({presets['driver']}), "
                             f"{presets['runs'][0]['size'][0]}x{presets['runs'][0]['size'][1]}; error of frame "
                             "32 against the reference with all bounces.\n\n"
                             f"![Error against time]({PICTURE})\n\n{frames_table(presets)}", notes))
    for names, heading, text in SECTIONS:
        data = [d for d in (load(folder, name) for name in names) if d]
        if data:
            parts.append(section(heading, "\n\n".join([text] + [frames_table(d) for d in data]), notes))
    for name, heading in (("sizes", "Time per pass against memory bandwidth"),
                          ("gpu", "Time per pass against memory bandwidth on a GPU")):
        data = load(folder, name)
        if data:
            run = next((r for r in data["runs"] if r["size"] in ([1280, 720], [1920, 1080])), data["runs"][0])
            text = "Bandwidth bound: the time to move all bound images and buffers once at the measured bandwidth. A pass "\
                   "that reads only a part of them can be faster; one that reads them many times is far above it.\n\n"
            parts.append(section(heading, text + roofline(run, data["bandwidth_bytes_per_s"]), notes))
    if notes.get("What was found"):
        parts.append(section("What was found", "", notes))
    parts.append(section("Made by", commands(folder), notes))
    parts.append(section("Targets that were met or not measured", targets.table(missed=False), notes))
    parts.append(section("Targets that were missed", targets.table(missed=True), notes))
    with open(PAGE + ".new", "w", encoding="utf-8") as file:
        file.write("\n\n".join(parts) + "\n")
    os.replace(PAGE + ".new", PAGE)


if __name__ == "__main__":
    main()
