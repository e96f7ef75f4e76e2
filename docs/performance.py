#!/usr/bin/env python3
"""Writes docs/performance.md from what docs/performance.sh measured: docs/performance.py [out/performance].

Text by hand stands in docs/performance-notes.md: what is under a heading there goes under the same heading of the page.
"""
import json
import os
import shutil
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
PAGE = os.path.join(ROOT, "docs", "performance.md")
NOTES = os.path.join(ROOT, "docs", "performance-notes.md")
PICTURE = os.path.join("pictures", "performance.svg")

# The course's original program on such a machine at 1280x720 with 32 rays, milliseconds; see methods/games202.md. If our
# own form of it is slower, this counts.
ORIGINAL_MS = 3300.0
ORIGINAL_MIRROR_MS = 120.0


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
    """Rows of the table at the top."""

    def __init__(self):
        self.rows = []

    def add(self, what, limit, value, met):
        state = "—" if met is None else "met" if met else "**missed**"
        self.rows.append(f"| {what} | {limit} | {value} | {state} |")

    def missing(self, what, limit):
        self.add(what, limit, "not measured", None)

    def table(self):
        return "\n".join(["| target | limit | measured | |", "|---|---|---|---|", *self.rows])


def against_games202(folder, targets):
    for name, scene in (("games202-cube1", "cube1"), ("games202", "cave")):
        data = load(folder, name)
        frame = f"whole frame of `{scene}`, steady, over `games202` with 32 rays"
        first = f"first frame of `{scene}` over the same"
        if data is None:
            targets.missing(frame, "1/30 of the time, no more error")
            targets.missing(first, "1/8 of the time, no more error")
            continue
        pair, (own, other) = data["comparisons"][0], data["runs"]
        for what, state, limit in ((frame, "steady", 30), (first, "first", 8)):
            # The faster of our form of it and of the original.
            base = min(submitted(other, state), ORIGINAL_MS)
            times = base / submitted(own, state)
            error = own[state]["error"]["relative_mse"], other[state]["error"]["relative_mse"]
            targets.add(what, f"1/{limit} of the time, no more error",
                        f"1/{times:.1f} of {base:.0f} ms ({ms(submitted(own, state))} ms; 1/"
                        f"{1 / ratio(pair, state):.1f} in turn); error {error[0]:.5f} against {error[1]:.5f}",
                        times >= limit and error[0] <= error[1])


def group_ms(run, group, state="steady"):
    return run[state]["groups"].get(group, {}).get("median", 0.0)


def mirror(folder, targets):
    what, limit = "mirror over the whole screen, over the course's", "no more time, 1/4 of the error"
    data = load(folder, "mirror")
    if data is None:
        targets.missing(what, limit)
        return
    own, other = data["runs"]
    times = group_ms(own, "specular"), group_ms(other, "specular")
    errors = own["steady"]["error"]["relative_mse"], other["steady"]["error"]["relative_mse"]
    targets.add(what, limit, f"{ms(times[0])} ms against {ms(times[1])} ms (original program: {ORIGINAL_MIRROR_MS:.0f} ms "
                f"for its whole frame); error {errors[0]:.5f} against {errors[1]:.5f}",
                times[0] <= times[1] and 4 * errors[0] <= errors[1])


def shadow(folder, targets):
    data = load(folder, "shadow")
    if data is None:
        targets.missing("PCSS with cleaning over the hard shadow", "60 ms more")
        return
    for pair in data["comparisons"]:
        more = pair["steady"]["submitted"]["difference_ms"]["median"]
        targets.add(f"PCSS with cleaning over the hard shadow, `{short(pair['scene'])}`", "60 ms more",
                    f"{ms(more)} ms more", more <= 60)


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
    what = "effects with 100 and with 1,000,000 triangles"
    if few is None or many is None:
        targets.missing(what, "within 5 %")
        return
    a, b = (group_ms(data["runs"][0], "effects") for data in (few, many))
    targets.add(what, "within 5 %", f"{ms(a)} and {ms(b)} ms; {100 * (b / a - 1):+.1f} %", abs(b / a - 1) <= 0.05)


def rest(folder, targets):
    data = load(folder, "rest")
    what, limit = "mean FLIP to the same chain at 1024 rays (measured: 256), frame 32, worst scene", "under 0.02"
    if data is None:
        targets.missing(what, limit)
        return
    flips = {short(run["scene"]): run["steady"]["error"]["displayed_flip"] for run in data["runs"]}
    worst = max(flips, key=flips.get)
    under = sum(flip < 0.02 for flip in flips.values())
    targets.add(what, limit, f"{flips[worst]:.4f} (`{worst}`); under it in {under} of {len(flips)} scenes", under == len(flips))


def motion(folder, targets):
    data = load(folder, "motion")
    flips, flicker = "mean FLIP in motion (60 frames), over that at rest, worst scene", "flicker over the truth's, worst scene"
    if data is None:
        targets.missing(flips, "1.5")
        targets.missing(flicker, "1.3")
        return

    def flip_ratio(run):
        flips = run["motion"]["displayed_flip"]
        return sum(flips) / len(flips) / run["steady"]["error"]["displayed_flip"]

    def flicker_ratio(run):
        return run["motion"]["flicker"] / run["motion"]["truth_flicker"]
    for what, limit, of in ((flips, 1.5, flip_ratio), (flicker, 1.3, flicker_ratio)):
        worst = max(data["runs"], key=of)
        targets.add(what, str(limit), f"{of(worst):.2f} (`{short(worst['scene'])}`)", of(worst) <= limit)


def stop(folder, targets):
    what, limit = "reflections 8 frames after what they show has stopped, from their final value", "within 5 %"
    data = load(folder, "stop")
    if data is None:
        targets.missing(what, limit)
        return
    off = data["runs"][0]["motion"]["rest"][7]
    targets.add(what, limit, f"{100 * off:.1f} % (`{short(data['runs'][0]['scene'])}`)", off <= 0.05)


def motion_table(data):
    lines = ["| scene | FLIP at rest | in motion, mean | most | flicker | of the truth |", "|---|--:|--:|--:|--:|--:|"]
    for run in data["runs"]:
        flips = run["motion"]["displayed_flip"]
        lines.append(f"| {short(run['scene'])} | {run['steady']['error']['displayed_flip']:.4f} | {sum(flips) / len(flips):.4f} | "
                     f"{max(flips):.4f} | {run['motion']['flicker']:.5f} | {run['motion']['truth_flicker']:.5f} |")
    return "\n".join(lines)


def gpu(folder, targets):
    data = load(folder, "gpu")
    limits = (("specular", 0.5), ("diffuse", 0.5))
    if data is None:
        for group, limit in limits:
            targets.missing(f"{group} light with cleaning on a GPU, 1920x1080", f"{limit} ms")
        targets.missing("PCSS with cleaning on a GPU, 1920x1080", "0.2 ms")
        return
    for group, limit in limits:
        worst = max(data["runs"], key=lambda run: group_ms(run, group))
        value = group_ms(worst, group)
        targets.add(f"{group} light with cleaning on {data['device']}, 1920x1080", f"{limit} ms",
                    f"{value:.3f} ms (`{short(worst['scene'])}`)", value <= limit)

    def shadow_ms(run):
        return sum(p["median"] for name, p in run["steady"]["passes"].items()
                   if ("shadow" in name or "visibility" in name) and not p["raster"])
    worst = max(data["runs"], key=shadow_ms)
    targets.add(f"PCSS with cleaning on {data['device']}, 1920x1080", "0.2 ms",
                f"{shadow_ms(worst):.3f} ms (`{short(worst['scene'])}`)", shadow_ms(worst) <= 0.2)


def frames_table(data):
    lines = ["| scene | variant | submitted, ms (quartiles) | device, ms | first frame, ms | relative MSE: first | steady | "
             "HDR-FLIP, steady | FLIP as shown, steady | memory, MB |", "|---|---|--:|--:|--:|--:|--:|--:|--:|--:|"]
    for run in data["runs"]:
        first = run["first"]
        errors = [state["error"] for state in (first, run["steady"])]
        error = (f"{errors[0]['relative_mse']:.5f} | {errors[1]['relative_mse']:.5f} | {errors[1]['flip']:.4f} | "
                 + (f"{errors[1]['displayed_flip']:.4f}" if "displayed_flip" in errors[1] else "")
                 if errors[1] else " | | | ")
        lines.append(f"| {short(run['scene'])} | {run['variant']} | {spread(run['steady']['submitted_ms'])} | "
                     f"{ms(run['steady']['frame_ms']['median'])} | {ms(submitted(run, 'first'))} | {error} | "
                     f"{run['memory_bytes'] / 1e6:.0f} |")
    return "\n".join(lines)


def roofline(run, bandwidth):
    lines = [f"`{short(run['scene'])}`, {run['variant']}, {run['size'][0]}x{run['size'][1]}; {bandwidth / 1e9:.1f} GB/s.", "",
             "| pass | ms (quartiles) | bound, MB | floor, ms | floor over time |", "|---|--:|--:|--:|--:|"]
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
    """What was typed, for everything that is there."""
    lines = []
    for file in sorted(os.listdir(folder)):
        if file.endswith(".json"):
            data = load(folder, file.removesuffix(".json"))
            lines.append("    " + data["command"])
    return "\n".join(lines)


def main():
    folder = sys.argv[1] if len(sys.argv) > 1 else os.path.join(ROOT, "out", "performance")
    notes = read_notes()
    targets = Targets()
    for add in (against_games202, mirror, shadow, pixels_and_triangles, rest, motion, stop, gpu):
        add(folder, targets)
    presets = load(folder, "presets")
    parts = ["# Performance", "Made by `docs/performance.sh`; what is written by hand stands in `performance-notes.md`. "
             "Device times are timestamps of the device; on llvmpipe they miss clears, copies and the start of draws, so "
             "that *submitted*, from submission to fence by the host's clock, counts there. `reflet bench --help` says "
             "what else the columns are; [bench.md](bench.md) more.",
             section("Targets", targets.table(), notes)]
    if presets:
        svg = os.path.join(folder, "presets.svg")
        if os.path.exists(svg):
            shutil.copyfile(svg, os.path.join(ROOT, "docs", PICTURE))
        parts.append(section("Error against time", f"{presets['device']} ({presets['driver']}), "
                             f"{presets['runs'][0]['size'][0]}x{presets['runs'][0]['size'][1]}, error against the path "
                             "tracer with one bounce between what the camera sees.\n\n"
                             f"![Error against time]({PICTURE})\n\n{frames_table(presets)}", notes))
    for name, heading in (("games202", "Whole frames against the course's method"), ("mirror", "Reflections"),
                          ("shadow", "Soft shadows"), ("sizes", "Cost per pixel"), ("triangles-100", "Triangles"),
                          ("rest", "At rest")):
        data = [load(folder, n) for n in (name, "games202-cube1" if name == "games202" else "",
                                          "triangles-1000000" if name == "triangles-100" else "") if n]
        data = [d for d in data if d]
        if data:
            parts.append(section(heading, "\n\n".join(frames_table(d) for d in data), notes))
    if moved := load(folder, "motion"):
        parts.append(section("In motion", motion_table(moved), notes))
    for name, heading in (("sizes", "Each pass and its floor"), ("gpu", "Each pass and its floor on a GPU")):
        data = load(folder, name)
        if data:
            run = next((r for r in data["runs"] if r["size"] in ([1280, 720], [1920, 1080])), data["runs"][0])
            text = "Floor: the time that moving all bound images and buffers once takes at the measured bandwidth. A pass "\
                   "that reads only a part of them may be faster, one that reads them many times is not near it.\n\n"
            parts.append(section(heading, text + roofline(run, data["bandwidth_bytes_per_s"]), notes))
    if notes.get("What was found"):
        parts.append(section("What was found", "", notes))
    parts.append(section("Made by", commands(folder), notes))
    with open(PAGE + ".new", "w", encoding="utf-8") as file:
        file.write("\n\n".join(parts) + "\n")
    os.replace(PAGE + ".new", PAGE)


if __name__ == "__main__":
    main()
