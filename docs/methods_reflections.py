"""What docs/methods/reflections.md shows: one scene, eight ways to reflect it; run by methods.py."""
import json

from methods import Render, Truth, cached, options
from methods_pages import error, percent

SCENE = "mirror-hall"
# Reflections of direct light alone, one bounce, as in the reference.
BASE = "diffuse.rays=0 trace_screen.light=direct "
OFF = BASE + "trace_screen.enabled=false "
PLANAR = "planar.enabled=true planar.count=2 planar.diffuse=false "
CUBE = "probes.enabled=true specular.maxRoughness=0 specular.rougher=mips "
WAYS = {
    "duplicate": ("duplicated room", OFF + PLANAR + "planar.form=duplicate"),
    "camera": ("extra camera", OFF + PLANAR + "planar.form=camera"),
    "planar": ("planar view", OFF + PLANAR),
    "cube": ("cube map", OFF + CUBE + "probes.parallax=false"),
    "box": ("box-corrected probe", OFF + CUBE),
    "screen": ("SSR alone", BASE),
    "hybrid": ("hybrid", BASE + PLANAR + "probes.enabled=true trace_scene.enabled=true"),
    "traced": ("path traced", OFF + "trace_scene.enabled=true trace_scene.light=path trace_scene.bounces=0"),
}
MIRROR = (213, 60, 107, 60)  # the end of the mirror wall
FLOOR = (150, 115, 107, 60)  # the red ball and its reflection
ROUNDS = 3


class Timed(Render):
    """The fifth frame, and the lowest of three medians over frames 2 to 5 [ms]."""

    def __init__(self, settings):
        self.arguments = options(SCENE, settings, None, "320x180", None)
        self.png, self.exr = cached("render", self.arguments + ["--aov", "indirect_specular,specular_confidence"],
                                    [".png", ".exr"])
        self.ms = min(self.frame_ms(i) for i in range(ROUNDS))

    def frame_ms(self, turn):
        timings, = cached("render", self.arguments + ["--frames", str(5 + turn)], [".json"])
        return json.load(open(timings))["frame_ms"]


def reflections(page):
    truth = Truth(SCENE)
    without = Timed("diffuse.rays=0 specular.rays=0")
    rows = []
    for name, (title, settings) in WAYS.items():
        frame = Timed(settings)
        page.picture(name, frame, MIRROR)
        page.picture(name + "-floor", frame, FLOOR)
        flip = frame.against(truth)["flip"]
        rows.append([title, error(frame, truth, "indirect_specular"), "%.4f" % flip, "%.0f" % (frame.ms - without.ms)])
    page.table("ways", ["way", "relative MSE of the reflections", "FLIP of the picture", "milliseconds"], rows)
    page.picture("truth", truth, MIRROR)
    page.picture("truth-floor", truth, FLOOR)
    page.picture("whole", Timed(WAYS["hybrid"][1]))
    page.picture("source", Render(SCENE, WAYS["hybrid"][1], show="specular_source"))
