#!/usr/bin/env python3
"""Prints the section "Sources" of docs/accuracy.md; called by docs/accuracy.sh. Needs a built program (./demo.sh) and
Python's standard library."""
import json
import os
import subprocess

REFLET = "build/bin/reflet"
WORK = "out/accuracy-sources"
LAYERS = {"mirror-hall": "indirect_specular", "gloss": "indirect_specular", "cubes": "indirect_specular",
          "cave": "indirect_diffuse", "cornell": "indirect_diffuse"}
SCENE_ALONE = ["trace_screen.enabled=false", "trace_scene.enabled=true"]
VARIANTS = {"`screen_only`": ("screen_only", []), "`screen_probes`": ("screen_probes", []),
            "ray tracing only": ("screen_only", SCENE_ALONE), "`hybrid`": ("hybrid", [])}
RAYS = 64
BASE = ["trace_screen.light=direct", "trace_screen.thickness=0.05", "materials.mips=false"]


def reflet(*arguments):
    return subprocess.run([REFLET, *arguments], check=True, capture_output=True, text=True).stdout


def compared(scene, layer, preset, settings):
    """Metrics of `reflet compare` for the layer."""
    rays = [f"diffuse.rays={RAYS if layer == 'indirect_diffuse' else 0}",
            f"specular.rays={RAYS if layer == 'indirect_specular' else 0}"]
    chosen = [word for setting in BASE + settings + rays for word in ("--set", setting)]
    reflet("render", f"builtin:{scene}", "--size", "320x180", "--preset", preset, "-o", f"{WORK}/picture.exr", "--aov", layer,
           *chosen)
    return json.loads(reflet("compare", f"{WORK}/picture.exr:{layer}", f"{WORK}/{scene}.exr:{layer}", "--json"))


os.chdir(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
os.makedirs(WORK, exist_ok=True)
print(f"""## Sources

Relative MSE (and bias) of one bounce of light against the full reference, `reflet reference --bounces 1 --filter center`:
{RAYS} rays per pixel, 320x180, `{" ".join(BASE)}`. Where the screen misses, `screen_only` falls back to the environment,
`screen_probes` to automatically placed cube-map probes, and `hybrid` to planar reflections, ray tracing and these probes.
Ray tracing only is `{" ".join(SCENE_ALONE)}`.
""")
print("| scene | layer |", " | ".join(VARIANTS), "|")
print("|---|---|" + "--:|" * len(VARIANTS))
for name, of in LAYERS.items():
    reflet("reference", f"builtin:{name}", "--size", "320x180", "--spp", "512", "--bounces", "1", "--filter", "center",
           "-o", f"{WORK}/{name}.exr")
    cells = []
    for used, more in VARIANTS.values():
        figures = compared(name, of, used, more)
        cells.append(f"{figures['relative_mse']:.4f} ({100 * figures['bias']:+.1f} %)")
    print(f"| {name} | `{of}` |", " | ".join(cells), "|")
print("""
The remaining error of `hybrid` in `mirror-hall` is sunlight that reaches a rough wall through two mirrors: few rays find it,
here and in the reference, and each has a large weight.""")
