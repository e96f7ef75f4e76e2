"""The images and table of docs/methods/reflections.md: one scene, nine reflection techniques; called by methods.py."""
import json

from methods import Frame, Render, Truth, cached, options, run

SCENE = "mirror-hall"
# Reflections of direct light only, one bounce, and textures without mip levels, all as in the reference.
BASE = "diffuse.rays=0 trace_screen.light=direct materials.mips=false "
OFF = BASE + "trace_screen.enabled=false "
PLANAR = "planar.enabled=true planar.count=2 "
CUBE = "probes.enabled=true probes.bounces=0 "
WAYS = {
    "duplicate": ("duplicated geometry", OFF + PLANAR + "planar.form=duplicate"),
    "camera": ("fixed camera", OFF + PLANAR + "planar.form=camera"),
    "planar": ("planar reflection", OFF + PLANAR),
    "cube": ("cube map", OFF + CUBE + "probes.parallax=none"),
    "box": ("parallax-corrected probe", OFF + CUBE + "probes.parallax=box"),
    "depth": ("probe with distances", OFF + CUBE),
    "screen": ("SSR only", BASE),
    "hybrid": ("hybrid", BASE + PLANAR + CUBE + "trace_scene.enabled=true"),
    "traced": ("ray traced", OFF + "trace_scene.enabled=true trace_scene.light=path trace_scene.bounces=0"),
}
WITHOUT = "diffuse.rays=0 specular.rays=0"
VIEW = "mirrors"  # one probe in the middle of the hall; its box is the hall's walls
MIRRORS = (150, 60, 160, 90)  # the end of the mirror wall, the red ball, the floor
ROUNDS = 3


class Way(Frame):
    """A first frame, and its cost: the lowest of three medians over frames 2 to 5 [ms]."""

    def __init__(self, settings):
        self.arguments = options(SCENE, settings, VIEW, "320x180", "plain")
        aov = ["--aov", "indirect_specular"]
        self.png, self.exr = cached("render", self.arguments + aov, [".png", ".exr"])
        times = [cached("render", self.arguments + ["--frames", str(5 + turn)], [".json"])[0] for turn in range(ROUNDS)]
        self.ms = min(json.load(open(path))["frame_ms"] for path in times)


def on_mirrors(frame, truth, mask):
    """Metrics of `reflet compare` for the reflections, where the camera sees metal."""
    layer = ":indirect_specular"
    return json.loads(run(["compare", frame.exr + layer, truth.exr + layer, "--mask", mask, "--json"]))


def reflections(page):
    truth = Truth(SCENE, "--bounces 1 --filter center", view=VIEW)
    without = Way(WITHOUT)
    mask = Render(SCENE, view=VIEW, show="metallic").png
    rows = []
    for name, (title, settings) in WAYS.items():
        frame = Way(settings)
        page.picture(name, frame, MIRRORS, 2)
        figures = on_mirrors(frame, truth, mask)
        rows.append([title, "%.3f" % figures["relative_mse"], "%+.0f %%" % (100 * figures["bias"]),
                     "%.3f" % figures["flip"], "%.0f" % (frame.ms - without.ms)])
    page.table("ways", ["method", "relative MSE", "bias", "FLIP", "milliseconds"], rows)
    page.picture("truth", truth, MIRRORS, 2)
    page.picture("source", Render(SCENE, WAYS["hybrid"][1], view=VIEW, show="specular_source"), MIRRORS, 2)


PAGES = {"reflections": reflections}
