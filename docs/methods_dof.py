"""The images and tables of the page depth-of-field of docs/methods/, called by methods.py."""
import json
import statistics

from methods import Frame, Truth, cached, options, read_png, run, write_png

SIZE = "640x360"
SCENE = "builtin:lens"
MASKS = "out/methods/dof-%s.png"
WINDOW = ((170, 110, 280, 158), 1)
LAMPS = ((230, 0, 160, 90), 3)


class Defocus(Frame):
    """The effect on a picture of the reference."""
    kind = "defocus"

    def __init__(self, truth, settings=""):
        self.arguments = [SCENE, "--picture", truth.exr]
        for setting in settings.split():
            self.arguments += ["--set", setting]
        self.png, self.exr = cached("defocus", self.arguments, [".png", ".exr"])
        self.arguments[2] = "pinhole.exr"  # as the page's commands call it


def error(frame, truth, mask):
    more = ["--mask", MASKS % mask] if mask else []
    return "%.4f" % json.loads(run(["compare", frame.exr, truth.exr, "--json"] + more))["relative_mse"]


def along(line, reach):
    """Whether a true value is within `reach` places."""
    out, last = [], -reach - 1
    for i, value in enumerate(line):
        last = i if value else last
        out.append(i - last <= reach)
    return out


def dilated(rows, reach):
    """Whether a true pixel is within `reach` pixels, along each axis."""
    for _ in range(2):
        rows = [[a or b for a, b in zip(along(r, reach), along(r[::-1], reach)[::-1])] for r in rows]
        rows = [list(column) for column in zip(*rows)]
    return rows


def make_masks(truth):
    """Far: blurred, behind the plane of focus. Near: within reach of what is in front of it. Lamps: within a disk of bright pixels
    of the reference; the other two are told with and without them."""
    view = options("lens", "", None, SIZE, "plain")
    coc, = cached("render", view + ["--show", "circle_of_confusion"], [".png"])
    width, height, rows = read_png(coc)
    red = [[line[3 * x] > 15 for x in range(width)] for line in rows]  # over 1 pixel
    blue = [[line[3 * x + 2] > 15 for x in range(width)] for line in rows]
    _, _, shown = read_png(truth.png)
    bright = [[max(line[3 * x:3 * x + 3]) > 150 and y < 150 for x in range(width)] for y, line in enumerate(shown)]
    near = dilated(blue, 18)
    lamp = dilated(bright, 12)
    masks = {
        "far": lambda x, y: red[y][x] and not near[y][x],
        "far-dark": lambda x, y: red[y][x] and not near[y][x] and not lamp[y][x],
        "near": lambda x, y: near[y][x],
        "near-dark": lambda x, y: near[y][x] and not lamp[y][x],
    }
    for name, holds in masks.items():
        lines = [b"".join(b"\xff\xff\xff" if holds(x, y) else bytes(3) for x in range(width)) for y in range(height)]
        write_png(MASKS % name, (width, height, lines))
    return list(masks)


def milliseconds(settings):
    """Time of each pass: the median of some runs' medians. A run may give a pass almost no time, where the driver's threads fall
    behind the timestamps."""
    times = {}
    for turn in range(6):
        arguments = options("lens", settings, None, "1280x720", "balanced") + ["--frames", str(6 + turn)]
        _, timings = cached("render", arguments, [".png", ".json"])
        for name, ms in json.load(open(timings))["passes"].items():
            times.setdefault(name, []).append(ms)
    return {name: statistics.median(values) for name, values in times.items()}


def depth_of_field(page):
    lens = Truth("lens", "", size=SIZE, spp=1024)
    pinhole = Truth("lens", "--pinhole", size=SIZE)
    effect = Defocus(pinhole)
    masks = make_masks(lens)
    for name, frame in (("pinhole", pinhole), ("effect", effect), ("lens", lens)):
        page.picture(name, frame, *WINDOW)
    for name, frame in (("effect", effect), ("lens", lens)):
        page.picture("lamps-" + name, frame, *LAMPS)
    rows = []
    for name, frame in [("no effect", pinhole)] + [("`dof.samples=%d`" % n, Defocus(pinhole, "dof.samples=%d" % n)) for n in (24, 48, 150)]:
        rows.append([name] + [error(frame, lens, mask) for mask in [None] + masks])
    page.table("error", ["image", "all", "far", "without lamps", "near", "without lamps"], rows)

    passes = {n: milliseconds("dof.samples=%d" % n) for n in (24, 48, 150)}
    names = [p for p in passes[48] if p.startswith("dof.")]
    rows = [["`%s`" % name] + ["%.1f" % passes[n][name] for n in passes] for name in names]
    rows.append(["all"] + ["%.1f" % sum(passes[n][name] for name in names) for n in passes])
    page.table("cost", ["pass"] + ["`samples=%d`" % n for n in passes], rows)


PAGES = {"depth-of-field": depth_of_field}
