#!/usr/bin/env python3
"""Models milliseconds on GPUs that are not here: docs/gpu_model.py STATS.json --markdown | --json | PRESET.

STATS.json is written by `REFLET_GPU_STATISTICS=STATS.json build/bin/gpu_compiler_tests`: instructions of every loop by
the compiler for NAVI21, dispatches and bound images of steady 1920x1080 frames. With --markdown it prints docs/gpu-model.md, with --json
src/measure/qualify/model.json, with a preset every pass of it.

A pass costs the largest of four times, a quarter of the others that compete with it, and the time of a barrier:
issue of vector instructions, issue of memory instructions, bytes over bandwidth, and latency that the waves do not hide.
"""
import json
import re
import sys

# units: that issue vector instructions; lanes: of one instruction, per cycle; memory: instructions of 64 lanes per cycle,
# of the whole device; barrier: seconds between dependent passes.
GPUS = {
    "RX 6800 XT": {"units": 144, "clock": 2.25e9, "cycles": 2.0, "slow": 8.0, "memory": 72 / 16, "bytes": 0.9e12,
                   "latency": 260, "barrier": 3.0e-6, "waves": lambda stat: stat["Subgroups per SIMD"] / 2},
    "RTX 3060": {"units": 112, "clock": 1.78e9, "cycles": 2.4, "slow": 8.0, "memory": 28 / 16, "bytes": 0.3e12,
                 "latency": 260, "barrier": 2.2e-6, "waves": lambda stat: min(512 / max(stat["VGPRs"], 16), 12) / 2},
    "H100": {"units": 528, "clock": 1.75e9, "cycles": 2.4, "slow": 8.0, "memory": 132 / 16, "bytes": 1.645e12,
             "latency": 330, "barrier": 2.2e-6, "waves": lambda stat: min(512 / max(stat["VGPRs"], 16), 16) / 2},
}
# Trips of loops, in the order in which they begin, where a pass is no fixed number of them. Of the march: the most steps
# of 64 rays that go together, measured on the CPU device (quality, 960x540, mean of cave, cubes, gloss, colonnade and moving):
# 101 of reflections, 63 of diffuse rays; in phases 32, 32, 64 and 31, 32, 32. Of blurs: the most taps of 64 pixels that go together,
# in the same scenes (quality, 480x270, frame 14, mean of its three passes). Of lists: what a picture with a penumbra in a
# quarter of its tiles and half of it out of focus has.
TRIPS = {
    "specular.trace_at_once": [1, 3, 1, 32], "specular.trace_at_once.32": [1, 1, 3, 1, 32], "specular.trace_at_once.64": [1, 1, 3, 64],
    "diffuse.trace_at_once": [1, 1, 31], "diffuse.trace_at_once.32": [1, 1, 1, 32], "diffuse.trace_at_once.64": [1, 1, 32],
    "specular.trace_screen": [1, 1, 32], "specular.trace_screen.32": [1, 1, 32], "specular.trace_screen.64": [1, 64],
    "shadow_visibility": [1, 1, 12, 6, 6],
    "diffuse.denoise_gather": [4, 0.3], "specular.denoise_gather": [2.5, 0.3, 4, 0.3], "ao.denoise_gather": [4, 0.3],
    "diffuse.denoise_blur": [4.0], "specular.denoise_blur": [6.2], "ao.denoise_blur": [4.8],
    "temporal": [4, 4, 3], "temporal.upscale": [4, 3], "ao.slices_at_once": [2, 6, 6], "diffuse.slices_at_once": [2, 8, 8], "tiles": [8, 8], "dof.coc": [2.7], "dof.highlights": [5.1, 6],
    "dof.composite.5": [3, 2], "dof.composite.6": [4, 4], "dof.composite.7": [4, 4, 3, 2],
    "dof.reach": [11], "dof.gather": [6, 46, 46, 4], "dof.gather_large": [6, 46, 46], "exposure.smooth": [16] + [20] * 10,
    "exposure.meter": [5, 5],
}
# Dispatches whose size only the device knows: pixels of the traced grid or of the picture that they get.
# Of rays 0.33 and 0.1 go on in the later phases of reflections, 0.36 and 0.08 of diffuse ones (in a quarter of the pixels).
SHARES = {"shadow_clean": 0.25, "specular.trace_screen": 0.4, "specular.trace_screen.32": 0.13, "specular.trace_screen.64": 0.04,
          "specular.trace_at_once.32": 0.33, "specular.trace_at_once.64": 0.1, "diffuse.trace_at_once.32": 0.09,
          "diffuse.trace_at_once.64": 0.02, "specular.generate_rays": 0.4,
          "specular.answer_environment": 0.17, "dof.reflected_images": 0.15, "dof.highlights": 0.0125,
          "dof.gather_large": 0.01, "dof.gather": 0.08, "dof.composite.4": 0.1, "dof.composite.5": 0.008, "dof.composite.6": 0.05,
          "dof.composite.7": 0.005, "dof.composite.8": 0.087}
MOST_BYTES = 320  # per thread: passes over small mips bind whole images
GROUPS = ("import", "shadow", "diffuse", "specular", "composite", "temporal", "dof", "exposure", "tonemap")
# docs/gpu.md: medians of builtin:cave on an H100, of the program's frames, quality, ms; and the model's passes for them.
MEASURED = {"specular.trace_screen": ("specular.trace_at_once", 1.941), "diffuse.trace_screen": ("diffuse.trace_at_once", 1.048),
            "specular.denoise_blur": ("specular.denoise_blur", 0.329), "specular.denoise_gather": ("specular.denoise_gather", 0.128),
            "temporal": ("temporal", 0.121), "shadow_visibility": ("shadow_visibility", 0.064),
            "diffuse.denoise_blur": ("diffuse.denoise_blur", 0.112)}


def by_label(table, label):
    """The entry of the longest name that the label contains."""
    names = [name for name in table if name in label]
    return table[max(names, key=len)] if names else None


def counts(kernel, label):
    """Instructions of a thread's whole run."""
    trips = by_label(TRIPS, label) or []
    loops, times, total = kernel["loops"], [], {}
    for i, loop in enumerate(loops):
        own = 1.0 if i == 0 else (trips[i - 1] if i <= len(trips) else 4.0)
        times.append(own * (times[loop["parent"]] if loop["parent"] >= 0 else 1.0))
        for name, value in loop.items():
            if name != "parent":
                total[name] = total.get(name, 0.0) + value * times[-1]
    return total


def seconds(gpu, one, kernel, pixels):
    label = one["label"]
    x, y, z = one["groups"]
    side = kernel["local_size"]
    threads = x * y * z * side[0] * side[1] * side[2] or (by_label(SHARES, label) or 0.2) * pixels
    waves = max(threads / 64, 1.0)
    n = counts(kernel, label)
    size = min(sum(image["bytes"] for image in one["images"]), MOST_BYTES * threads)
    vector = gpu["cycles"] * n["vector"] + gpu["slow"] * n["transcendental"]
    resident = max(gpu["waves"](kernel["statistics"]), 1.0)
    alone = 1.15 * gpu["cycles"] * n["vector"] + 10 * n["transcendental"] + n["scalar"] + gpu["latency"] * n["memory_waits"]
    times = {"vector": vector * waves / gpu["units"] / gpu["clock"], "memory": n["memory"] * waves / gpu["memory"] / gpu["clock"],
             "bytes": size / gpu["bytes"], "latency": alone * max(waves / gpu["units"] / resident, 1.0) / gpu["clock"]}
    bound = max(times, key=times.get)
    others = sum(v for k, v in times.items() if k not in (bound, "latency"))
    return times[bound] + 0.25 * others + gpu["barrier"], bound


def frame(stats, preset, gpu):
    """[(label, seconds, what bounds it)]"""
    recorded = stats["frames"][preset]
    pixels = (1920 * 1080) if preset in ("quality", "options", "horizon") else 960 * 540
    for p in recorded["passes"]:
        if "list=" in p["kernel"] and p["label"] == "dof.composite":  # a dispatch for each list of tiles
            p["label"] += "." + p["kernel"].split("list=")[1]
    rows = [(p["label"], *seconds(gpu, p, stats["kernels"][p["kernel"]], (1920 * 1080 if p["label"].startswith("dof") else pixels)))
            for p in recorded["passes"]]
    return rows + [("clears", recorded["cleared_bytes"] / gpu["bytes"], "bytes")]


def group(label):
    first = label.split(".")[0]
    return {"shadow_visibility": "shadow", "shadow_clean": "shadow", "shadow_range": "shadow"}.get(first, first)


def page(stats):
    print("# Modelled times of GPUs\n\nMade by `docs/gpu_model.py STATS.json --markdown`. **Nothing on this page is measured, except the "
          "last table's measured column.**\nInstructions, registers and occupancy are those of Mesa's compiler for NAVI21 "
          f"({stats['driver']}); dispatches and images are those of steady 1920x1080 frames of the library.\n"
          "Loop trips, sizes of lists, clocks and bandwidths are assumptions, at the head of the script. NVIDIA's numbers come from AMD's "
          "instruction counts.\n")
    names = ("RX 6800 XT", "RTX 3060")
    presets = [p for p in ("fast", "balanced", "quality") if p in stats["frames"]]
    sums = {(p, n): frame(stats, p, GPUS[n]) for p in presets for n in names}
    print("| ms | " + " | ".join(f"`{p}` {n}" for p in presets for n in names) + " |\n|---|" + "--:|" * len(sums))
    labels = {group(row[0]) for rows in sums.values() for row in rows}
    for name in [g for g in GROUPS if g in labels] + sorted(labels - set(GROUPS)):
        print(f"| {name} | " + " | ".join(f"{1e3 * sum(r[1] for r in rows if group(r[0]) == name):.2f}" for rows in sums.values()) + " |")
    print("| **total** | " + " | ".join(f"{1e3 * sum(r[1] for r in rows):.2f}" for rows in sums.values()) + " |")
    print("\nAmbient occlusion alone, at full size with 2 slices of 6 steps to each side:\n\n| ms | " + " | ".join(names)
          + " |\n|---|--:|--:|")
    for method, preset in (("horizon", "horizon"), ("bitmask", "options")):
        for what, parts in (("slices", ("ao.slices_at_once",)), ("denoising", ("ao.denoise", "ao.classify", "ao.finish"))):
            times = [sum(r[1] for r in frame(stats, preset, GPUS[n]) if r[0].startswith(parts)) for n in names]
            print(f"| `{method}`, {what} | " + " | ".join(f"{1e3 * t:.2f}" for t in times) + " |")
    print("\n## How wrong it is\n\nThe same model of an H100 beside what [gpu.md](gpu.md) has measured: `quality`, `builtin:cave`. The program's frames are not "
          "the library's: the program has planar reflections and probes, and its scene decides how far rays go. The measured column is older "
          "than two optimisations of the ray march (one load per step; rays compacted in phases), so the first two passes look about twice "
          "as slow as modelled.\n\n"
          "| pass | measured, ms | modelled, ms | modelled / measured |\n|---|--:|--:|--:|")
    rows = frame(stats, "quality", GPUS["H100"])
    for name, (ours, measured) in MEASURED.items():
        modelled = 1e3 * sum(r[1] for r in rows if re.sub(r"\.\d+$", "", r[0]) == ours)
        print(f"| `{name}` | {measured:.3f} | {modelled:.3f} | {modelled / measured:.2f} |")
    print("\n## Replace it by a measurement\n\nOn a machine with the GPU:\n\n    reflet qualify -o qualify        # times of all passes, in qualify.md and "
          "qualify.json; attach both to an issue\n    docs/performance.sh gpu          # then docs/gpu.py writes gpu.md")


def stored(stats):
    """By preset and pass of the program's name: milliseconds on each GPU."""
    presets = {}
    for preset in ("fast", "balanced", "quality"):
        passes = presets[preset] = {}
        for i, name in enumerate(("RX 6800 XT", "RTX 3060")):
            for label, time, _ in frame(stats, preset, GPUS[name]):
                label = re.sub(r"(trace_\w+)\.\d+$", r"\1", label).replace("trace_at_once", "trace_screen")
                passes.setdefault(label, [0.0, 0.0])[i] += 1e3 * time
    rounded = {p: {k: [round(v, 3) for v in ms] for k, ms in passes.items()} for p, passes in presets.items()}
    print("{\n" + ",\n".join(f'"{p}": ' + json.dumps(passes) for p, passes in rounded.items()) + "\n}")


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    with open(sys.argv[1], encoding="utf-8") as file:
        stats = json.load(file)
    if sys.argv[2] == "--markdown":
        return page(stats)
    if sys.argv[2] == "--json":
        return stored(stats)
    for name, gpu in GPUS.items():
        rows = frame(stats, sys.argv[2], gpu)
        print(f"{name}: {1e3 * sum(r[1] for r in rows):.2f} ms")
        for label, time, bound in rows:
            print(f"  {label:30} {1e3 * time:7.3f} ms  {bound}")


if __name__ == "__main__":
    main()
