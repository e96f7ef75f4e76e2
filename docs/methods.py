#!/usr/bin/env python3
"""Makes the images, tables and commands of docs/methods/: docs/methods.py [PAGE...]; without arguments, all pages.

Needs a built program (./demo.sh) and Python's standard library. The contents of each page are defined in
the other methods_*.py files. Tables and commands are written into the pages between
<!-- table:NAME --> or <!-- commands --> and <!-- end -->; the prose around them is written by hand. References and
renders are cached in out/methods/. Renders of an older program are made anew, references are not: delete that folder
after these have changed.
"""
import hashlib
import json
import os
import re
import shlex
import struct
import subprocess
import sys
import zlib
from itertools import accumulate

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
REFLET = "build/bin/reflet"
CACHE = "out/methods"
LAYERS = "direct,indirect_diffuse,indirect_specular,depth"
SPP = 256


# PNG as the program writes it: 8 bits, RGB or RGBA, not interlaced. An image is (width, height, rows of RGB bytes).

def unfilter(kind, line, above, step):
    """Reverses the PNG filter of a row in place."""
    for i in range(len(line)):
        left = line[i - step] if i >= step else 0
        up = above[i]
        corner = above[i - step] if i >= step else 0
        if kind == 1:
            line[i] = (line[i] + left) & 255
        elif kind == 2:
            line[i] = (line[i] + up) & 255
        elif kind == 3:
            line[i] = (line[i] + (left + up) // 2) & 255
        elif kind == 4:
            far = [abs(up - corner), abs(left - corner), abs(left + up - 2 * corner)]
            line[i] = (line[i] + (left, up, corner)[far.index(min(far))]) & 255


def read_png(path):
    data = open(path, "rb").read()
    at, packed = 8, b""
    while at < len(data):
        length, kind = struct.unpack_from(">I4s", data, at)
        if kind == b"IHDR":
            width, height, bits, color = struct.unpack_from(">IIBB", data, at + 8)
        if kind == b"IDAT":
            packed += data[at + 8:at + 8 + length]
        at += length + 12
    assert bits == 8 and color in (2, 6), path
    step = 3 if color == 2 else 4
    raw, rows, above = zlib.decompress(packed), [], bytes(width * step)
    for y in range(height):
        start = y * (width * step + 1)
        line = bytearray(raw[start + 1:start + 1 + width * step])
        unfilter(raw[start], line, above, step)
        above = line
        rows.append(b"".join(line[x:x + 3] for x in range(0, len(line), step)))
    return width, height, rows


def write_png(path, picture):
    width, height, rows = picture

    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    def filtered(y, kind):  # 1: difference to the left pixel, 2: to the row above
        above = rows[y - 1] if y else bytes(3 * width)
        before = bytes(3) + rows[y] if kind == 1 else above
        return bytes([kind]) + (bytes((a - b) & 255 for a, b in zip(rows[y], before)) if kind else rows[y])

    def size(line):
        return sum(min(v, 256 - v) for v in line[1:])

    raw = b"".join(min((filtered(y, kind) for kind in (0, 1, 2)), key=size) for y in range(height))
    with open(path, "wb") as f:
        f.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0))
                + chunk(b"IDAT", zlib.compress(raw, 9)) + chunk(b"IEND", b""))


# EXR as the program writes it: 32-bit floats, ZIP in blocks of 16 rows.

def unzip_exr(block, size):
    """Decompresses a block: undoes the byte differences, then interleaves the even and odd bytes."""
    if len(block) == size:  # stored uncompressed where compression would not make it smaller
        return block
    packed = zlib.decompress(block)
    apart = bytes(accumulate(packed, lambda a, b: (a + b - 128) & 255))
    together = bytearray(size)
    together[0::2], together[1::2] = apart[:(size + 1) // 2], apart[(size + 1) // 2:]
    return together


def read_values(path, channel):
    """One channel: its width, height and rows of numbers."""
    data = open(path, "rb").read()
    at, attributes = 8, {}
    while data[at]:
        name, kind = data[at:at + 512].split(b"\0", 2)[:2]
        at += len(name) + len(kind) + 2
        size, = struct.unpack_from("<i", data, at)
        attributes[name] = data[at + 4:at + 4 + size]
        at += 4 + size
    right, bottom = struct.unpack("<4i", attributes[b"dataWindow"])[2:]
    width, height = right + 1, bottom + 1
    names = re.findall(rb"([^\x00]+)\x00\x02\x00\x00\x00.{12}", attributes[b"channels"], re.S)
    first, row, rows = names.index(channel.encode()), 4 * width * len(names), []
    for offset in struct.unpack_from("<%dQ" % ((height + 15) // 16), data, at + 1):
        y, size = struct.unpack_from("<ii", data, offset)
        block = unzip_exr(data[offset + 8:offset + 8 + size], row * min(16, height - y))
        for start in range(4 * width * first, len(block), row):
            rows.append(struct.unpack_from("<%df" % width, block, start))
    return width, height, rows


def read_exr(path, channel):
    """One channel, clamped to 0 to 1, as a grey image."""
    width, height, rows = read_values(path, channel)
    return width, height, [b"".join(bytes([round(255 * min(max(v, 0.0), 1.0))] * 3) for v in row) for row in rows]


def crop(picture, x, y, width, height, zoom):
    """A window of the image, each pixel repeated zoom x zoom times."""
    rows = []
    for line in picture[2][y:y + height]:
        part = b"".join(line[3 * i:3 * i + 3] * zoom for i in range(x, x + width))
        rows += [part] * zoom
    return width * zoom, height * zoom, rows


# The program.

def run(arguments):
    done = subprocess.run([REFLET] + arguments, capture_output=True, text=True)
    if done.returncode:
        sys.exit("%s %s\n%s" % (REFLET, shlex.join(arguments), done.stderr))
    return done.stdout


def cached(kind, arguments, outputs):
    """Runs the program once per set of arguments and build of it. Returns the paths of the outputs."""
    key = hashlib.sha256("\n".join([kind] + arguments).encode()).hexdigest()[:16]
    base = "%s/%s-%s" % (CACHE, kind, key)
    paths = [base + end for end in outputs]
    built = 0 if kind == "reference" else os.path.getmtime(REFLET)
    if not all(os.path.exists(p) and os.path.getmtime(p) > built for p in paths):
        for path in filter(os.path.exists, paths):
            os.remove(path)
        files = []
        for path in paths:
            files += ["--timings" if path.endswith(".json") else "-o", path]
        run([kind] + arguments + files)
    return paths


def options(scene, settings, view, size, preset):
    """Command-line arguments. A reference has no preset."""
    arguments = [scene if "/" in scene else "builtin:" + scene]
    arguments += ["--preset", preset] if preset else []
    arguments += ["--size", size]
    arguments += ["--view-file", "docs/methods/views/%s.json" % view] if view else []
    for setting in settings.split():
        arguments += ["--set", setting]
    return arguments


class Frame:
    """An image with layers: self.png and self.exr, made with self.arguments."""

    def against(self, truth, layer="final", mask=None):
        """Metrics of `reflet compare`; mask: an image of the pixels to compare."""
        mine = "" if layer == "final" else ":" + layer
        return json.loads(run(["compare", self.exr + mine, truth.exr + ":" + layer, "--json"]
                              + (["--mask", mask] if mask else [])))


class Render(Frame):
    """A rendered frame: final image, layers, steps and hits."""

    def __init__(self, scene, settings="", view=None, size="320x180", preset=None, show=None):
        self.arguments = options(scene, settings, view, size, preset or "plain")
        self.arguments += ["--show", show] if show else []
        more = ["--aov", LAYERS, "--set", "trace_screen.count_steps=true"]
        self.png, self.exr, timings = cached("render", self.arguments + more, [".png", ".exr", ".json"])
        self.rays = json.load(open(timings)).get("rays", {})


class Truth(Frame):
    """A path-traced reference frame."""

    def __init__(self, scene, kind="--bounces 1", settings="", view=None, size="320x180", spp=SPP):
        self.arguments = options(scene, settings, view, size, None) + kind.split() + ["--spp", str(spp)]
        self.png, self.exr = cached("reference", self.arguments, [".png", ".exr"])


# The pages.

class Page:
    def __init__(self, name):
        self.name = name
        self.path = "docs/methods/%s.md" % name
        self.commands = []

    def picture(self, name, frame, window=None, zoom=3, layer=None):
        """Writes pictures/PAGE-NAME.png: the whole frame, or a window (x, y, width, height) of it, enlarged. layer: the
        EXR layer to show instead of the PNG, in grey."""
        path = "docs/methods/pictures/%s-%s.png" % (self.name, name)
        whole = read_exr(frame.exr, layer + ".Y") if layer else read_png(frame.png)
        write_png(path, crop(whole, *window, zoom) if window else whole)
        if os.path.getsize(path) > 100 * 1024:
            sys.exit("%s has over 100 KiB" % path)
        kind = getattr(frame, "kind", "reference" if isinstance(frame, Truth) else "render")
        parts = (["layer " + layer] if layer else []) + (["%dx%d from (%d, %d)" % (window[2:] + window[:2])] if window else [])
        aov = " --aov " + layer if layer and kind == "render" else ""
        note = " # then " + ", ".join(parts) if parts else ""
        self.commands.append("%s %s%s -o %s.%s%s" % (kind, shlex.join(frame.arguments), aov, name, "exr" if layer else "png", note))

    def table(self, name, header, rows):
        """Writes a table: the first column is text, the others are figures."""
        lines = ["| %s |" % " | ".join(header), "|---|" + "--:|" * (len(header) - 1)]
        lines += ["| %s |" % " | ".join(row) for row in rows]
        self.replace("table:" + name, "\n".join(lines))

    def replace(self, marker, text):
        page = open(self.path).read() if os.path.exists(self.path) else ""
        begin, end = "<!-- %s -->" % marker, "<!-- end -->"
        pattern = re.compile(re.escape(begin) + ".*?" + re.escape(end), re.S)
        block = "%s\n\n%s\n\n%s" % (begin, text, end)
        if not pattern.search(page):
            sys.exit("%s has no %s\n%s" % (self.path, begin, text))
        with open(self.path, "w") as f:
            f.write(pattern.sub(lambda _: block, page, count=1))

    def finish(self):
        self.replace("commands", "\n".join("    %s %s" % (REFLET, c) for c in self.commands))


def main():
    import methods_pages
    os.chdir(ROOT)
    os.makedirs(CACHE, exist_ok=True)
    os.makedirs("docs/methods/pictures", exist_ok=True)
    for name in sys.argv[1:] or methods_pages.PAGES:
        if name not in methods_pages.PAGES:
            sys.exit("no page %s; there are: %s" % (name, ", ".join(methods_pages.PAGES)))
        page = Page(name)
        methods_pages.PAGES[name](page)
        page.finish()
        print(page.path)


if __name__ == "__main__":
    sys.modules["methods"] = sys.modules["__main__"]  # methods_pages imports this module
    main()
