"""The images and tables of the page motion-blur of docs/methods/, called by methods.py."""
import hashlib
import json
import os
import statistics

from methods import CACHE, Frame, cached, read_png, run, write_png

SCENE = "builtin:moving"
WHEN = "--time 0.5 --fps 6 --size 320x180"
LIGHT = "--bounces 1 --spp 96"
PATH = "docs/methods/views/track-path.json"
BOX = ((100, 85, 150, 80), 2)
CUBE = ((60, 30, 107, 60), 3)
WALL = ((100, 60, 150, 80), 2)


class OneFrame(Frame):
    """The first frame of a sequence, since only sequences have a camera path."""

    def __init__(self, command, arguments):
        self.kind = command
        self.arguments = arguments
        key = hashlib.sha256("\n".join([command] + arguments).encode()).hexdigest()[:16]
        base = "%s/%s-%s" % (CACHE, command, key)
        self.png, self.exr = base + "_0000.png", base + "_0000.exr"
        if not (os.path.exists(self.png) and os.path.exists(self.exr)):
            run([command] + arguments + ["-o", base + "_####.png", "-o", base + "_####.exr"])
        self.arguments = arguments + ["--frames", "1"]


class Effect(Frame):
    """The effect on a picture of the reference."""
    kind = "motion-blur"

    def __init__(self, sharp, path, settings):
        self.arguments = [SCENE] + WHEN.split()[:4] + ["--picture", sharp.exr]
        self.arguments += ["--path", path] if path else []
        for setting in settings.split():
            self.arguments += ["--set", setting]
        self.png, self.exr = cached("motion-blur", self.arguments, [".png", ".exr"])
        self.arguments[self.arguments.index(sharp.exr)] = "sharp.exr"  # as the page's commands call it


def reference(path, shutter, seed=0):
    arguments = [SCENE] + WHEN.split() + LIGHT.split() + ["--seed", str(seed)]
    arguments += ["--path", path] if path else []
    arguments += ["--shutter", str(shutter)] if shutter else []
    return OneFrame("reference", arguments)


def changed_mask(name, sharp, blurred):
    """White where the shutter changes the picture by more than 8/255."""
    path = "%s/motion-%s.png" % (CACHE, name)
    width, height, a = read_png(sharp.png)
    b = read_png(blurred.png)[2]
    rows = []
    for y in range(height):
        row = bytearray()
        for x in range(0, 3 * width, 3):
            differs = max(abs(p - q) for p, q in zip(a[y][x:x + 3], b[y][x:x + 3])) > 8
            row += b"\xff\xff\xff" if differs else bytes(3)
        rows.append(bytes(row))
    write_png(path, (width, height, rows))
    return path


def error(frame, truth, mask):
    more = ["--mask", mask] if mask else []
    return "%.4f" % json.loads(run(["compare", frame.exr, truth.exr, "--json"] + more))["relative_mse"]


def milliseconds(samples):
    """Time of each pass of the effect: the median of some runs' medians."""
    times = {}
    for turn in range(2):
        arguments = ["builtin:moving", "--preset", "balanced", "--size", "640x360", "--path", "orbit", "--frames", str(8 + turn)]
        arguments += ["--segment", "0", "--warmup", "0", "--set", "motion_blur.enabled=true", "--set", "motion_blur.samples=%d" % samples]
        base = "%s/motion-cost-%d-%d" % (CACHE, samples, turn)
        if not os.path.exists(base + ".json"):
            run(["render"] + arguments + ["-o", base + "_####.png", "--timings", base + ".json"])
        for name, ms in json.load(open(base + ".json"))["passes"].items():
            times.setdefault(name, []).append(ms)
    return {name: statistics.median(values) for name, values in times.items() if name.startswith("motion_blur.")}


def motion_blur(page):
    rows = []
    for name, path, windows in (("still", None, {"box": BOX, "cube": CUBE}), ("tracking", PATH, {"wall": WALL})):
        sharp = reference(path, 0)
        for shutter in (0.5, 1.0):
            truth = reference(path, shutter, seed=1)
            mask = changed_mask("%s-%g" % (name, shutter), sharp, truth)
            frames = [("no effect", sharp)]
            for samples in (8, 16, 32, 64):
                settings = "motion_blur.shutter=%g motion_blur.samples=%d motion_blur.max_length=0.5" % (shutter, samples)
                frames.append(("`samples=%d`" % samples, Effect(sharp, path, settings)))
            for what, frame in frames:
                rows.append([name, "%g" % shutter, what, error(frame, truth, None), error(frame, truth, mask)])
            if shutter == 1.0:
                for part, window in windows.items():
                    for kind, frame in (("sharp", sharp), ("effect", frames[2][1]), ("shutter", truth)):
                        page.picture("%s-%s" % (part, kind), frame, *window)
                        if frame.kind == "reference":  # sequences have a number in their names
                            page.commands[-1] = page.commands[-1].replace(".png", "_####.png")
            else:
                same = reference(path, 0, seed=1)
                rows.append([name, "0", "reference with another seed", error(same, sharp, None), error(same, sharp, mask)])
    header = ["camera", "shutter", "image", "relative MSE", "where the shutter changes the image by over 8/255"]
    lines = ["| %s |" % " | ".join(header), "|---|--:|---|--:|--:|"] + ["| %s |" % " | ".join(row) for row in rows]
    page.replace("table:error", "\n".join(lines))
    passes = {n: milliseconds(n) for n in (8, 16, 32)}
    rows = [["`%s`" % name] + ["%.1f" % passes[n][name] for n in passes] for name in passes[16]]
    rows.append(["all"] + ["%.1f" % sum(passes[n].values()) for n in passes])
    page.table("cost", ["pass"] + ["`samples=%d`" % n for n in passes], rows)


PAGES = {"motion-blur": motion_blur}
