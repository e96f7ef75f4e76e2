"""Reads the data sets and images of Reflet as NumPy arrays, and runs its program. docs/python.md is the guide."""

from .dataset import Dataset, Frame, open_dataset
from .exr import Exr, read_exr, write_exr
from .layers import check, positions, recombine, reproject, static_motion, tone_map
from .program import RefletError, compare, program, reference, render

__version__ = "0.2.0"

__all__ = ["Dataset", "Exr", "Frame", "RefletError", "check", "compare", "open_dataset", "positions", "program",
           "read_exr", "recombine", "reference", "render", "reproject", "static_motion", "tone_map", "write_exr"]
