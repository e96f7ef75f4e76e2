"""The images and tables of docs/methods/glass.md, called by methods.py."""
from methods import CACHE, Frame, Truth, cached, options, read_values, write_png

SCENE = "glass"
PIECES = (38, 45, 184, 96)  # block, balls, bottle
COATED = (212, 105, 56, 52)  # the varnished ball


class Glass(Frame):
    """The picture of a preset, at rest."""

    def __init__(self, preset, settings="", more=()):
        self.arguments = options(SCENE, settings, None, "320x180", preset)
        self.png, self.exr = cached("render", self.arguments + list(more), [".png", ".exr"])


def depth_of(settings):
    """The depth of a frame without any indirect light."""
    return read_values(Glass("direct", settings, ["--aov", "depth"]).exr, "depth.Y")[2]


def mask_of(name, size, keep):
    """Writes an image of the pixels (x, y) to compare. Returns its path."""
    path = "%s/glass-%s.png" % (CACHE, name)
    rows = [b"".join((b"\xff" if keep(x, y) else b"\0") * 3 for x in range(size[0])) for y in range(size[1])]
    write_png(path, (size[0], size[1], rows))
    return path


def masks():
    """Pixels of glass; those of them in which no other glass is behind the nearest; those of clear coats."""
    front, opaque = depth_of("transmission.layers=0"), depth_of("")
    size = len(front[0]), len(front)
    single, all_layers = (read_values(Glass("quality", s).exr, "G")[2] for s in ("transmission.layers=1", ""))
    both = read_values(Glass("hybrid", "").exr, "G")[2]
    bare = read_values(Glass("hybrid", "materials.coats=false").exr, "G")[2]

    def glass(x, y):
        return front[y][x] != opaque[y][x]

    def coat(x, y):
        left, top, width, height = COATED
        return left <= x < left + width and top <= y < top + height and bare[y][x] != both[y][x]

    return (mask_of("all", size, glass),
            mask_of("single", size, lambda x, y: glass(x, y) and single[y][x] == all_layers[y][x]),
            mask_of("coat", size, coat))


def glass(page):
    truth = Truth(SCENE, "")
    page.picture("truth", truth, PIECES, 2)
    everywhere, single, coat = masks()
    rows = []
    for preset, settings, name in (("balanced", "transmission.layers=0", "opaque"), ("balanced", "", "balanced"),
                                   ("quality", "transmission.layers=1", "one"),
                                   ("quality", "transmission.exit_steps=0", "slab"), ("quality", "", None),
                                   ("hybrid", "transmission.layers=0", None), ("hybrid", "", "hybrid")):
        frame = Glass(preset, settings)
        if name:
            page.picture(name, frame, PIECES, 2)
        figures = frame.against(truth)
        rows.append(["`%s`%s" % (preset, ", `%s`" % settings if settings else "")]
                    + ["%.4f" % frame.against(truth, mask=m)["relative_mse"] for m in (everywhere, single)]
                    + ["%.4f" % figures["relative_mse"], "%+.1f %%" % (100 * figures["bias"]), "%.3f" % figures["flip"]])
    page.table("errors", ["preset", "relative MSE: pixels of glass", "of a single layer", "whole image", "bias", "FLIP"],
               rows)
    page.picture("coat-truth", truth, COATED, 4)
    rows = []
    for preset, settings, name in (("balanced", "materials.coats=false", "bare"), ("balanced", "", "coat"),
                                   ("hybrid", "materials.coats=false", None), ("hybrid", "", None)):
        frame = Glass(preset, settings)
        if name:
            page.picture(name, frame, COATED, 4)
        figures = frame.against(truth, mask=coat)
        rows.append(["`%s`%s" % (preset, ", `%s`" % settings if settings else ""), "%.4f" % figures["relative_mse"],
                     "%+.1f %%" % (100 * figures["bias"])])
    page.table("coats", ["preset", "relative MSE: pixels of the coat", "bias"], rows)


PAGES = {"glass": glass}
