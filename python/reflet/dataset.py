"""Data sets of `reflet dataset`."""

import json
import zlib
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from .exr import read_exr

_OIDN = {"hdr": "final", "alb": "albedo", "nrm": "normal", "ldr": "displayed"}


class Frame(Mapping):
    """Named arrays of one frame, read when the first is asked for.

    frame["final"] and the other layers of the clean image; frame.noisy["spp4"]["final"] those of a noisy one.
    Colours are height x width x 3, depths height x width, motion height x width x 2; all float32.
    """

    def __init__(self, folder, record):
        self.folder = Path(folder)
        self.record = record
        self._clean = None
        self._noisy = None

    name = property(lambda self: self.record["name"])
    scene = property(lambda self: self.record["scene"])
    # Data sets of program 0.2.0 have stops in `exposure`, which is a factor now.
    exposure = property(lambda self: self.record.get("exposure_stops", self.record["exposure"]), doc="Stops for tone_map.")

    def matrix(self, name):
        """world_to_view, view_to_clip, previous_world_to_view or previous_view_to_clip, for column vectors."""
        return np.array(self.record[name])

    @property
    def noisy(self):
        """The noisy versions by name, each a dict of layers."""
        self._read()
        return self._noisy

    def _read(self):
        if self._clean is not None:
            return
        self._clean, self._noisy = {}, {noisy["name"]: {} for noisy in self.record["noisy"]}
        for file in self.record["files"]:
            layers = read_exr(self.folder / file["file"])
            version, _, feature = file["file"][len(self.name):].removesuffix(".exr").partition(".")
            if feature:  # the layout of Open Image Denoise
                name = version[1:]
                into = self._clean if name == "ref" else self._noisy[f"spp{int(name[:-3])}"]
                into[_OIDN[feature]] = layers[""]
                continue
            for full, image in layers.items():
                of, _, layer = full.rpartition(".")
                if full:
                    (self._noisy[of] if of else self._clean)[layer] = image

    def __getitem__(self, layer):
        self._read()
        return self._clean[layer]

    def __iter__(self):
        self._read()
        return iter(self._clean)

    def __len__(self):
        self._read()
        return len(self._clean)

    def damage(self):
        """What is wrong with the files, as a text; empty: their sizes and checksums are those of the record."""
        for file in self.record["files"]:
            path = self.folder / file["file"]
            if not path.is_file():
                return f"{path} is missing"
            data = path.read_bytes()
            if len(data) != file["bytes"] or f"{zlib.crc32(data):08x}" != file["crc32"]:
                return f"{path} is damaged"
        return ""

    def __repr__(self):
        return f"<reflet frame {self.name}>"


class Dataset(Sequence):
    """The frames of a folder, in order. `manifest` says how they were made; `missing` counts frames not made yet."""

    def __init__(self, folder):
        self.folder = Path(folder)
        self.manifest = json.loads((self.folder / "manifest.json").read_text())
        if self.manifest.get("kind") != "reflet dataset":
            raise ValueError(f"{folder}: not a data set of Reflet")
        index = self.folder / "frames.jsonl"
        if index.is_file():
            records = [json.loads(line) for line in index.read_text().splitlines()]
        else:  # it is being made
            records = [json.loads(path.read_text()) for path in self.folder.glob("*/*.json")]
        records.sort(key=lambda record: record["frame"])
        self.missing = self.manifest["frames"] - len(records)
        self._frames = [Frame(folder, record) for record in records]
        self._by_name = {frame.name: frame for frame in self._frames}

    def __len__(self):
        return len(self._frames)

    def __getitem__(self, index):
        # A copy: a frame keeps its arrays, and a data set must not fill the memory.
        if isinstance(index, slice):
            return [Frame(f.folder, f.record) for f in self._frames[index]]
        return Frame(self.folder, self._frames[index].record)

    def previous(self, frame):
        """The frame before it in its burst, or None."""
        name = frame.record["previous"]
        return Frame(self.folder, self._by_name[name].record) if name in self._by_name else None


def open_dataset(folder):
    """The data set in a folder, also one that is not complete. Raises OSError and ValueError."""
    return Dataset(folder)
