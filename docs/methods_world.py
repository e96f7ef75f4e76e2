"""The images and tables of docs/methods/radiance-cache.md and reflected-suns.md, called by methods.py."""
from methods import Frame, Truth, cached, options


class Settled(Frame):
    """The picture of a preset, at rest."""

    def __init__(self, scene, preset, settings="", more=()):
        self.arguments = options(scene, settings, None, "320x180", preset)
        self.png, self.exr = cached("render", self.arguments + list(more), [".png", ".exr"])


def figures(frame, truth):
    f = frame.against(truth)
    return ["%.4f" % f["relative_mse"], "%+.1f %%" % (100 * f["bias"]), "%.3f" % f["flip"]]


LEFT = (0, 20, 140, 79)  # cave: where nearly all light has bounced several times


def radiance_cache(page):
    truth = Truth("cave", "")
    page.picture("truth", truth, LEFT, 2)
    rows = []
    for settings, name in (("radiance_cache.enabled=false", "off"), ("", "on"),
                           ("radiance_cache.cell_size=0.01", None), ("radiance_cache.cell_size=0.1", None),
                           ("radiance_cache.cell_size=0.4", None),
                           ("trace_scene.light=path trace_scene.bounces=16", None)):
        frame = Settled("cave", "hybrid", settings)
        if name:
            page.picture(name, frame, LEFT, 2)
        rows.append(["`%s`" % settings if settings else "`hybrid`"] + figures(frame, truth)
                    + figures(Settled("cave", "hybrid", settings, ["--frames", "1"]), truth)[:2])
    page.table("errors", ["settings", "relative MSE", "bias", "FLIP", "first frame: relative MSE", "bias"], rows)


WALL = (150, 20, 170, 96)  # moving: the wall and the cylinder over the mirror floor


def reflected_suns(page):
    rows = []
    for scene in ("moving", "mirror-hall"):
        truth = Truth(scene, "")
        if scene == "moving":
            page.picture("truth", truth, WALL, 2)
        for preset in ("balanced", "hybrid"):
            for settings, name in (("direct.reflected_suns=0", "off"), ("", "on")):
                frame = Settled(scene, preset, settings)
                if scene == "moving" and preset == "hybrid":
                    page.picture(name, frame, WALL, 2)
                rows.append([scene, "`%s`%s" % (preset, ", `%s`" % settings if settings else "")]
                            + figures(frame, truth))
    page.table("errors", ["scene", "preset", "relative MSE", "bias", "FLIP"], rows)


PAGES = {"radiance-cache": radiance_cache, "reflected-suns": reflected_suns}
