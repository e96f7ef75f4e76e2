#!/usr/bin/env python3
"""Prints the section "Shadows" of docs/accuracy.md; called by docs/accuracy.sh. Needs a built program (./demo.sh) and
Python's standard library. Times are device times. Each round runs every variant once; a pass's time is the median over
the frames after the first, and then the lowest of the rounds, because other load can only add to it."""
import json
import os
import subprocess

REFLET = "build/bin/reflet"
WORK = "out/accuracy-shadows"
SCENES = ("colonnade", "cubes")
SUNS = (0.53, 5)
ROUNDS = 3
FRAMES = 5
LAYERS = ("sun_visibility_raw", "sun_visibility")  # before and after the denoiser
SHARES = ("shadow_map", "shadow_range", "shadow_visibility", "shadow_clean", "contact_shadow")


def reflet(*arguments):
    return subprocess.run([REFLET, *arguments], check=True, capture_output=True, text=True).stdout


def render(scene, sun, size, settings, *more):
    chosen = [word for setting in settings for word in ("--set", setting)]
    reflet("render", f"builtin:{scene}", "--view-file", f"{WORK}/sun-{sun}.json", "--size", size, "--preset", "direct",
           "-o", f"{WORK}/picture.exr", "--aov", ",".join(LAYERS), *chosen, *more)


def make_truths():
    for sun in SUNS:
        with open(f"{WORK}/sun-{sun}.json", "w") as file:
            json.dump({"sun": {"angular_diameter": sun}}, file)
        for scene in SCENES:
            reflet("reference", f"builtin:{scene}", "--view-file", f"{WORK}/sun-{sun}.json", "--size", "320x180",
                   "--spp", "256", "--bounces", "0", "--filter", "center", "-o", f"{WORK}/{scene}-{sun}.exr")


def errors(scene, sun, settings):
    """Metrics of the first frame, raw and denoised."""
    render(scene, sun, "320x180", settings)
    return [json.loads(reflet("compare", f"{WORK}/picture.exr:{layer}", f"{WORK}/{scene}-{sun}.exr:sun_visibility",
                              "--json")) for layer in LAYERS]


def times(scene, sun, size, variants):
    """Milliseconds by variant, then by pass of SHARES."""
    runs = {name: [] for name in variants}
    for _ in range(ROUNDS):
        for name, settings in variants.items():
            render(scene, sun, size, settings, "--frames", str(FRAMES), "--timings", f"{WORK}/times.json")
            with open(f"{WORK}/times.json") as file:
                passes = json.load(file)["passes"]
            runs[name].append([sum(ms for key, ms in passes.items() if key.split(".")[0] == share)
                               for share in SHARES])
    return {name: dict(zip(SHARES, map(min, zip(*rounds)))) for name, rounds in runs.items()}


def filtered(kind, samples):
    return [f"shadow.filter={kind}", f"shadow.samples={samples}"]


def error_and_time():
    variants = {("hard", ""): ["shadow.filter=hard"]}
    variants |= {(kind, n): filtered(kind, n) for kind in ("pcf", "pcss") for n in (8, 16, 32, 64)}
    print("| scene | sun | filter | samples | raw: relative MSE | FLIP | bias | denoised: relative MSE | FLIP | bias | "
          "raw: ms | × hard | denoised: ms | × hard |")
    print("|---|--:|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|")
    for scene in SCENES:
        for sun in SUNS:
            measured = times(scene, sun, "320x180", variants)
            hard = sum(measured["hard", ""].values())
            for (kind, samples), settings in variants.items():
                raw, denoised = ([f"{e['relative_mse']:.5f}", f"{e['flip']:.4f}", f"{100 * e['bias']:+.2f} %"]
                                for e in errors(scene, sun, settings))
                ms = measured[kind, samples]
                whole = sum(ms.values())
                costs = [f"{t:.1f} | {t / hard:.2f}" for t in (whole - ms["shadow_clean"], whole)]
                if kind == "hard":  # nothing to denoise
                    denoised, costs[1] = [""] * 3, " | "
                print(f"| {scene} | {sun}° | {kind} | {samples} |", " | ".join(raw + denoised + costs), "|")


def resolutions():
    """Relative MSE of 16 samples raw and denoised, and of 64 raw."""
    sizes = (512, 1024, 2048, 4096, 8192)
    print("| scene | sun | pcss |", " | ".join(f"{n} texels" for n in sizes), "|")
    print("|---|--:|---|" + "--:|" * len(sizes))
    for scene in SCENES:
        for sun in SUNS:
            some, denoised, more = [], [], []
            for size in sizes:
                few = errors(scene, sun, filtered("pcss", 16) + [f"shadow.resolution={size}"])
                many = errors(scene, sun, filtered("pcss", 64) + [f"shadow.resolution={size}"])
                for row, e in ((some, few[0]), (denoised, few[1]), (more, many[0])):
                    row.append(f"{e['relative_mse']:.5f}")
            for name, row in (("16 raw", some), ("16 denoised", denoised), ("64 raw", more)):
                print(f"| {scene} | {sun}° | {name} |", " | ".join(row), "|")


def costs():
    raw = "shadow.denoise=false"
    soft = filtered("pcss", 16)
    variants = {
        "hard": ["shadow.filter=hard"],
        "pcf 16": filtered("pcf", 16) + [raw],
        "pcss 16, `shadow.early_out=false`": soft + [raw, "shadow.early_out=false"],
        "pcss 16": soft + [raw],
        "pcss 16, denoised": soft,
        "pcss 16, denoised, `shadow.cascades=2`": soft + ["shadow.cascades=2"],
        "pcss 16, denoised, `shadow.cascades=4`": soft + ["shadow.cascades=4"],
        "pcss 16, denoised, `contact.distance=0.2`": soft + ["contact.distance=0.2"],
    }
    print("| scene | variant |", " | ".join(f"`{share}`" for share in SHARES), "| all | × hard |")
    print("|---|---|" + "--:|" * (len(SHARES) + 2))
    for scene in SCENES:
        measured = times(scene, 0.53, "1280x720", variants)
        hard = sum(measured["hard"].values())
        for name, ms in measured.items():
            whole = sum(ms.values())
            each = " | ".join(f"{ms[share]:.1f}" if ms[share] > 0 else "" for share in SHARES)
            print(f"| {scene} | {name} | {each} | {whole:.1f} | {whole / hard:.2f} |")


def device():
    with open(f"{WORK}/times.json") as file:
        return json.load(file)["device"]


os.chdir(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
os.makedirs(WORK, exist_ok=True)
make_truths()
render("cubes", 0.53, "320x180", [], "--timings", f"{WORK}/times.json")
print(f"""## Shadows

Sun visibility against `reflet reference --bounces 0 --filter center` with the same sun disk and 256 samples. All other
settings are those of `direct`: one shadow map of 2048 × 2048 texels, a radius of 5 cm for PCF, 16 samples in PCSS's blocker search. Times on
{device()}: the lowest of {ROUNDS} medians over {FRAMES - 1} frames, with the variants interleaved,
on a machine with other load. Between two runs of these tables, times of the same row differed by up to 1.8 times in the
first table and by up to a quarter in the last.

### Error and time

320x180 pixels; errors of a first frame, without history. Time: all passes named `shadow_…`, including rendering the map.
""")
error_and_time()
print("""
### Error by map resolution

Relative MSE of PCSS by the resolution of the shadow map.
""")
resolutions()
print("""
At 2048 texels, 16 denoised samples are about as close to the reference as 64 raw samples, and no closer: hardly any
of the error is noise. A finer map removes most of the error in `colonnade`. A pixel that is lit and should be dark has a hundredfold
weight in relative MSE: one pixel of 320x180 adds 0.0017, which is nearly all of the remaining error of `cubes` under the small sun.
tests/pass/shadow_truth_test.cpp measures what the denoiser does to noise alone.

### Cost by pass

Milliseconds per pass at 1280x720, sun of 0.53°.
""")
costs()
print("""
`shadow_map` and `shadow_range` do not depend on the image size: in small images they are most of the cost of PCSS. Here
`shadow.early_out` saves about as much in `shadow_visibility` as its pass `shadow_range` costs.""")
