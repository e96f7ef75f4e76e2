"""OpenEXR files as Reflet writes them: one part of scan lines, without compression or with ZIP.

Debian 12 has no Python module of OpenEXR, and OpenImageIO's brings 100 packages for these 150 lines. The format is that
of "OpenEXR File Layout", Academy Software Foundation, 2021.
"""

import struct
import zlib

import numpy as np

_MAGIC = 20000630
_TYPES = (np.dtype("<u4"), np.dtype("<f2"), np.dtype("<f4"))
_LINES = {0: 1, 2: 1, 3: 16}  # of a chunk, by the number of the compression: none, ZIPS, ZIP


class Exr(dict):
    """Layers by name, float32 arrays of height x width x channels, or height x width where there is one channel.

    The unnamed layer is "". `attributes` has the header; matrices are for column vectors: p' = M p.
    """

    def __init__(self, layers, attributes):
        super().__init__(layers)
        self.attributes = attributes


def _name(data, at):
    end = data.index(b"\0", at)
    return data[at:end].decode(), end + 1


def _channels(value):
    at, found = 0, []
    while value[at]:
        name, at = _name(value, at)
        kind, _, x, y = struct.unpack_from("<iIii", value, at)
        if (x, y) != (1, 1):
            raise ValueError(f"channel {name} is subsampled")
        found.append((name, _TYPES[kind]))
        at += 16
    return found


def _header(data):
    magic, version = struct.unpack_from("<II", data, 0)
    if magic != _MAGIC:
        raise ValueError("not an OpenEXR file")
    if version & 0x1A00:
        raise ValueError("tiles, deep data and several parts are not supported")
    at, values = 8, {}
    while data[at]:
        name, at = _name(data, at)
        kind, at = _name(data, at)
        size = struct.unpack_from("<i", data, at)[0]
        values[name] = (kind, data[at + 4:at + 4 + size])
        at += 4 + size
    return values, at + 1


def _attribute(kind, value):
    if kind == "m44f":
        return np.frombuffer(value, "<f4").reshape(4, 4).T.copy()
    if kind in ("box2i", "v2i"):
        return struct.unpack(f"<{len(value) // 4}i", value)
    if kind == "float":
        return struct.unpack("<f", value)[0]
    return value.decode(errors="replace") if kind == "string" else value


def _unzip(block, size):
    if len(block) == size:  # it did not become smaller
        return block
    steps = np.frombuffer(zlib.decompress(block), np.uint8)
    if len(steps) != size:
        raise ValueError("a chunk has another size than its lines")
    # Each byte is stored as the difference to the one before it, plus 128.
    coded = np.cumsum(steps, dtype=np.uint32)
    coded -= 128 * np.arange(size, dtype=np.uint32)
    half = (size + 1) // 2
    plain = np.empty(size, np.uint8)
    plain[0::2] = coded[:half].astype(np.uint8)
    plain[1::2] = coded[half:].astype(np.uint8)
    return plain.tobytes()


def _rank(channel):
    return ("RGBA".find(channel) if channel in "RGBA" else 4, channel)


def _grouped(planes):
    names = {}
    for full in planes:
        layer, _, channel = full.rpartition(".")
        names.setdefault(layer, []).append(channel)
    layers = {}
    for layer, channels in names.items():
        prefix = layer + "." if layer else ""
        own = [planes[prefix + channel] for channel in sorted(channels, key=_rank)]
        layers[layer] = own[0] if len(own) == 1 else np.stack(own, axis=-1)
    return layers


def read_exr(path):
    """All layers of a file, as Exr. Raises OSError, and ValueError for what is no such file."""
    with open(path, "rb") as file:
        data = file.read()
    try:
        return _decode(data)
    except (IndexError, KeyError, struct.error, zlib.error) as error:
        raise ValueError(f"{path}: damaged, or of a kind that is not supported") from error
    except ValueError as error:
        raise ValueError(f"{path}: {error}") from error


def _decode(data):
    header, at = _header(data)
    channels = _channels(header["channels"][1])
    left, top, right, bottom = struct.unpack("<4i", header["dataWindow"][1])
    width, height = right - left + 1, bottom - top + 1
    lines = _LINES[header["compression"][1][0]]
    line_bytes = width * sum(kind.itemsize for _, kind in channels)
    planes = {name: np.empty((height, width), np.float32) for name, _ in channels}
    offsets = struct.unpack_from(f"<{(height + lines - 1) // lines}Q", data, at)
    for offset in offsets:
        y, size = struct.unpack_from("<ii", data, offset)
        first = y - top
        count = min(lines, height - first)
        block = _unzip(data[offset + 8:offset + 8 + size], count * line_bytes)
        rows = np.frombuffer(block, np.uint8).reshape(count, line_bytes)
        begin = 0
        for name, kind in channels:
            end = begin + width * kind.itemsize
            planes[name][first:first + count] = np.ascontiguousarray(rows[:, begin:end]).view(kind)
            begin = end
    attributes = {name: _attribute(*value) for name, value in header.items() if name != "channels"}
    return Exr(_grouped(planes), attributes)


def write_exr(path, layers):
    """Writes arrays by layer name as 32-bit floats, without compression: for other programs to read."""
    planes = {}
    for layer, image in layers.items():
        image = np.asarray(image, np.float32)
        image = image[..., None] if image.ndim == 2 else image
        names = {1: "Y", 2: "XY", 3: "RGB", 4: "RGBA"}[image.shape[2]]
        for i, channel in enumerate(names):
            planes[f"{layer}.{channel}" if layer else channel] = image[..., i]
    height, width = next(iter(planes.values())).shape
    names = sorted(planes)

    def attribute(name, kind, value):
        return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(value)) + value

    channels = b"".join(n.encode() + b"\0" + struct.pack("<iIii", 2, 0, 1, 1) for n in names) + b"\0"
    box = struct.pack("<4i", 0, 0, width - 1, height - 1)
    head = struct.pack("<II", _MAGIC, 2) + attribute("channels", "chlist", channels)
    head += attribute("compression", "compression", b"\0") + attribute("dataWindow", "box2i", box)
    head += attribute("displayWindow", "box2i", box) + attribute("lineOrder", "lineOrder", b"\0")
    head += attribute("pixelAspectRatio", "float", struct.pack("<f", 1))
    head += attribute("screenWindowCenter", "v2f", struct.pack("<2f", 0, 0))
    head += attribute("screenWindowWidth", "float", struct.pack("<f", 1)) + b"\0"
    line = 8 + 4 * width * len(names)
    start = len(head) + 8 * height
    rows = np.stack([planes[n] for n in names], axis=1).astype("<f4")  # height x channels x width
    with open(path, "wb") as file:
        file.write(head + struct.pack(f"<{height}Q", *(start + y * line for y in range(height))))
        for y in range(height):
            file.write(struct.pack("<ii", y, line - 8) + rows[y].tobytes())
