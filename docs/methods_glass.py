"""The images and table of docs/methods/glass.md, called by methods.py."""
from methods import Frame, Truth, cached, options

SCENE = "glass"
PIECES = (38, 45, 184, 96)  # block, balls, bottle


class Glass(Frame):
    """The picture of a preset, at rest."""

    def __init__(self, preset, settings=""):
        self.arguments = options(SCENE, settings, None, "320x180", preset)
        self.png, self.exr = cached("render", self.arguments, [".png", ".exr"])


def glass(page):
    truth = Truth(SCENE, "")
    page.picture("truth", truth, PIECES, 2)
    rows = []
    for preset, settings, name in (("balanced", "transmission.layers=0", "opaque"), ("balanced", "", "balanced"),
                                   ("hybrid", "transmission.layers=0", None), ("hybrid", "transmission.layers=1", "one"),
                                   ("hybrid", "transmission.exit_steps=0", "slab"), ("hybrid", "", "hybrid")):
        frame = Glass(preset, settings)
        if name:
            page.picture(name, frame, PIECES, 2)
        figures = frame.against(truth)
        rows.append(["`%s`%s" % (preset, ", `%s`" % settings if settings else ""), "%.4f" % figures["relative_mse"],
                     "%+.1f %%" % (100 * figures["bias"]), "%.3f" % figures["flip"]])
    page.table("errors", ["preset", "relative MSE to the reference", "bias", "FLIP"], rows)


PAGES = {"glass": glass}
