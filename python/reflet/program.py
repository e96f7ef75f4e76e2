"""Runs the program `reflet`: rendering, path tracing, comparing."""

import json
import os
import shutil
import subprocess
import tempfile
from pathlib import Path

from .exr import read_exr, write_exr


class RefletError(RuntimeError):
    """The program failed; the text is what it said."""


def program():
    """The program's file: $REFLET_PROGRAM, `reflet` of the PATH, or that of the build beside this package."""
    built = Path(__file__).resolve().parents[2] / "build/bin/reflet"
    found = os.environ.get("REFLET_PROGRAM") or shutil.which("reflet") or (str(built) if built.is_file() else None)
    if not found:
        raise RefletError("there is no program `reflet`: install it, or set REFLET_PROGRAM")
    return found


def _run(arguments):
    done = subprocess.run([program(), *map(str, arguments)], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise RefletError(done.stderr.strip())
    return done.stdout


def _image(command, scene, size, more, settings):
    with tempfile.TemporaryDirectory(prefix="reflet-") as folder:
        file = os.path.join(folder, "image.exr")
        sets = [word for key, value in settings.items() for word in ("--set", f"{key.replace('__', '.')}={_text(value)}")]
        _run([command, scene, "-o", file, "--size", f"{size[0]}x{size[1]}", *more, *sets])
        return read_exr(file)


def _text(value):
    return str(value).lower() if isinstance(value, bool) else str(value)


def render(scene, size=(640, 360), layers=("direct", "indirect_diffuse", "indirect_specular", "albedo", "normal",
                                           "depth"), preset="balanced", frames=None, options=(), **settings):
    """Renders a scene: layers by name, with the image itself as "" (Exr).

    scene: a file, or "builtin:NAME". layers: any of `reflet list shows`. frames: None, as many as the preset's history
    needs. options: further words of the command line. settings: with __ for the dot, as in diffuse__rays=4.
    Raises RefletError.
    """
    more = ["--preset", preset, *(["--aov", ",".join(layers)] if layers else []), *options]
    if frames is not None:
        more += ["--frames", frames]
    return _image("render", scene, size, more, settings)


def reference(scene, size=(640, 360), spp=64, seed=0, options=(), **settings):
    """Path traces a scene: all layers of `reflet reference` by name (Exr). Raises RefletError."""
    return _image("reference", scene, size, ["--spp", spp, "--seed", seed, *options], settings)


def compare(image, truth):
    """The metrics of `reflet compare` of two images of radiance, by name: flip, psnr, relative_mse and others."""
    with tempfile.TemporaryDirectory(prefix="reflet-") as folder:
        files = [os.path.join(folder, name) for name in ("image.exr", "truth.exr")]
        for file, pixels in zip(files, (image, truth)):
            write_exr(file, {"": pixels})
        return json.loads(_run(["compare", *files, "--json"]))
