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
PRESET_SCENES = ("cave", "street")  # of the measurements presets-SCENE

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
    """Rows of a table of targets, by whether the target was missed (not measured: it was not)."""

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
    for scene in ("cube1", "cave"):
        data = load(folder, "games202-" + scene)
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
    for scaling in data["scaling"] if data else ():
        targets.add(f"cost per pixel, 640x360 to 3840x2160, `{short(scaling['scene'])}`", "within 15 %",
                    f"{', '.join(f'{ns:.0f}' for ns in scaling['ns_per_pixel'])} ns; {100 * scaling['spread']:.0f} %",
                    scaling["spread"] <= 0.15)
    few, many = load(folder, "triangles-100"), load(folder, "triangles-1000000")
    what = "all passes but geometry, with 100 and with 1,000,000 triangles"
    if few is None or many is None:
        targets.missing(what, "within 5 %")
        return
    a, b = (group_ms(data["runs"][0], "effects") for data in (few, many))
    targets.add(what, "within 5 %", f"{ms(a)} and {ms(b)} ms; {100 * (b / a - 1):+.1f} %", abs(b / a - 1) <= 0.05)


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
        text += (f"\n\nLarger images, from submission to fence, `{runs[0]['variant']}`:\n\n"
                 "| scene | size | ms per frame |\n|---|---|--:|\n"
                 + "\n".join(f"| {short(r['scene'])} | {r['size'][0]}x{r['size'][1]} | {ms(submitted(r))} |" for r in runs))
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
    (("games202-cube1", "games202-cave"), "Whole frames against the GAMES202 method",
     "Diffuse light of Lambert surfaces, against the reference with all bounces. The preset `games202` is the "
     "method of [the GAMES202 assignment](methods/games202.md) with 32 rays."),
    (("mirror",), "Reflections", "A mirror that fills the screen, without sky; errors are those of the layer "
     "`indirect_specular` against the reference with all bounces."),
    (("shadow",), "Soft shadows", "Direct light only: PCSS with its denoiser, against hard shadows."),
    (("sizes",), "Cost per pixel", "Two scenes at four sizes."),
    (("triangles-100", "triangles-1000000"), "Triangles", "The same room with 100 and with 1,000,000 triangles."),
    (("rest",), "At rest", "A static camera, frame 32, against the same settings with 256 rays per pixel, averaged over "
     "frames and not denoised."),
)


def error_against_time(folder, notes):
    """Table and plot of all presets for each scene of PRESET_SCENES; copies the plots to docs/pictures."""
    parts = []
    for scene in PRESET_SCENES:
        if not (data := load(folder, "presets-" + scene)):
            continue
        if not parts:
            size = data["runs"][0]["size"]
            parts.append(f"{data['device']} ({data['driver']}), {size[0]}x{size[1]}; error of frame 32 against the reference "
                         "with all bounces.")
        picture = f"pictures/performance-{scene}.svg"
        plot = os.path.join(folder, f"presets-{scene}.svg")
        if os.path.exists(plot):
            shutil.copyfile(plot, os.path.join(ROOT, "docs", picture))
        parts.append(f"![Error against time, {scene}]({picture})\n\n{frames_table(data)}")
    return [section("Error against time", "\n\n".join(parts), notes)] if parts else []


def main():
    folder = sys.argv[1] if len(sys.argv) > 1 else os.path.join(ROOT, "out", "performance")
    notes = read_notes()
    targets = Targets()
    for add in (against_games202, mirror, shadow, pixels_and_triangles):
        add(folder, targets)
    parts = ["# Performance", "What a frame costs and how far it is from the reference.",
             section("Cost and error of the presets", overview(folder), notes),
             "## Measurements\n\nMade by `docs/performance.sh`; the hand-written text is in `performance-notes.md`. In all tables "
             "below, *submitted* is the host's time from submission to fence and *device* the time by the "
             "device's timestamps. On llvmpipe the timestamps miss clears, copies and the start of draws, so use *submitted* there. "
             "*First* is a frame without history, *steady* the state after a warm-up. `reflet bench --help` explains the other "
             "columns; see also [bench.md](bench.md)."]
    parts += error_against_time(folder, notes)
    for names, heading, text in SECTIONS:
        data = [d for d in (load(folder, name) for name in names) if d]
        if data:
            parts.append(section(heading, "\n\n".join([text] + [frames_table(d) for d in data]), notes))
    if data := load(folder, "sizes"):
        runs = [run for run in data["runs"] if run["size"] == [1280, 720]]
        text = "Bandwidth bound: the time to move all bound images and buffers once at the measured bandwidth. A pass "\
               "that reads only a part of them can be faster; one that reads them many times is far above it."
        parts.append(section("Time per pass against memory bandwidth",
                             "\n\n".join([text] + [roofline(run, data["bandwidth_bytes_per_s"]) for run in runs]), notes))
    parts.append(section("Optimisations on llvmpipe", "", notes))
    parts.append(section("Made by", commands(folder), notes))
    parts.append(section("Targets that were met or not measured", targets.table(missed=False), notes))
    parts.append(section("Targets that were missed", targets.table(missed=True), notes))
    with open(PAGE + ".new", "w", encoding="utf-8") as file:
        file.write("\n\n".join(parts) + "\n")
    os.replace(PAGE + ".new", PAGE)


if __name__ == "__main__":
    main()
