"""Tests of the Python package on a small data set, with the program of $REFLET_PROGRAM or of the build."""

import json
import os
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib
from pathlib import Path

import numpy as np

PYTHON = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(PYTHON))
import reflet  # noqa: E402


def dataset(folder, *more):
    subprocess.run([reflet.program(), "dataset", "builtin:cubes", "builtin:cornell", "-o", folder, "--size", "48x27",
                    "--frames", "4", "--burst", "2", "--spp", "16", "--noisy", "1,4", "--seed", "7", *more],
                   check=True, capture_output=True)


def read_png(path):
    """8-bit RGB."""
    data, at, body = Path(path).read_bytes(), 8, b""
    while at < len(data):
        size, kind = struct.unpack_from(">I4s", data, at)
        if kind == b"IHDR":
            width, height = struct.unpack_from(">II", data, at + 8)
            channels = {2: 3, 6: 4}[data[at + 17]]
        body += data[at + 8:at + 8 + size] if kind == b"IDAT" else b""
        at += 12 + size
    lines = np.frombuffer(zlib.decompress(body), np.uint8).reshape(height, 1 + width * channels)
    out = np.zeros((height + 1, width + 1, channels), np.int64)  # a border of zeros
    for y in range(height):
        line = lines[y, 1:].reshape(width, channels).astype(np.int64)
        for x in range(width):
            a, b, c = out[y + 1, x], out[y, x + 1], out[y, x]
            p = a + b - c
            near = np.abs(p - a), np.abs(p - b), np.abs(p - c)
            paeth = np.where((near[0] <= near[1]) & (near[0] <= near[2]), a, np.where(near[1] <= near[2], b, c))
            guess = (0, a, b, (a + b) // 2, paeth)[lines[y, 0]]
            out[y + 1, x + 1] = (line[x] + guess) & 255
    return out[1:, 1:, :3]


class DatasetTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp(prefix="reflet-test-")
        dataset(cls.folder + "/half")
        dataset(cls.folder + "/float", "--float")
        dataset(cls.folder + "/oidn", "--layout", "oidn", "--ldr")
        cls.data = reflet.open_dataset(cls.folder + "/half")

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def test_frames_are_named_arrays(self):
        self.assertEqual((len(self.data), self.data.missing), (4, 0))
        frame = self.data[1]
        self.assertEqual(frame["final"].shape, (27, 48, 3))
        self.assertEqual(frame["depth"].shape, (27, 48))
        self.assertEqual(frame["motion"].shape, (27, 48, 2))
        self.assertEqual(frame["final"].dtype, np.float32)
        self.assertEqual(set(frame.noisy), {"spp1", "spp4"})
        self.assertEqual(set(frame.noisy["spp1"]),
                         {"final", "direct", "indirect_diffuse", "indirect_specular", "albedo"})
        self.assertEqual({layer["name"] for layer in self.data.manifest["layers"]}, set(frame))
        self.assertEqual(self.data.previous(frame).name, self.data[0].name)
        self.assertIsNone(self.data.previous(self.data[0]))

    def test_the_contract_holds_and_damage_is_found(self):
        for frame in self.data:
            errors = reflet.check(frame)
            self.assertEqual(errors["finite"], 0)
            self.assertLess(errors["sum"], 2e-3)
            self.assertLess(errors["noisy_sum"], 2e-3)
            self.assertLess(errors["motion"], 0.02)
            self.assertLess(errors["normal"], 2e-3)
            self.assertEqual(frame.damage(), "")
        for frame in reflet.open_dataset(self.folder + "/float"):
            self.assertLess(reflet.check(frame)["sum"], 1e-5)
        copy = self.folder + "/copy"
        shutil.copytree(self.folder + "/half", copy)
        file = Path(copy) / self.data[2].record["files"][0]["file"]
        content = bytearray(file.read_bytes())
        content[-100] ^= 1
        file.write_bytes(content)
        self.assertIn("damaged", reflet.open_dataset(copy)[2].damage())
        ran = subprocess.run([sys.executable, "-m", "reflet", "check", copy], cwd=PYTHON, capture_output=True, text=True,
                             check=False)
        self.assertEqual(ran.returncode, 1)
        self.assertIn("4 frames, 0 missing, 1 bad", ran.stdout)

    def test_half_floats_are_those_of_the_floats(self):
        exact = reflet.open_dataset(self.folder + "/float")[0]
        self.assertTrue(np.allclose(self.data[0]["final"], exact["final"], rtol=1e-3, atol=1e-6))
        self.assertTrue(np.array_equal(self.data[0]["depth"], exact["depth"]))

    def test_the_layout_of_open_image_denoise_has_the_same_images(self):
        frame = reflet.open_dataset(self.folder + "/oidn")[0]
        self.assertTrue(np.array_equal(frame["final"], self.data[0]["final"]))
        self.assertTrue(np.array_equal(frame["normal"], self.data[0]["normal"]))
        self.assertTrue(np.array_equal(frame.noisy["spp4"]["albedo"], self.data[0].noisy["spp4"]["albedo"]))
        # Their tools encode what is in .ldr.exr as sRGB, and take `exposure` as a factor.
        linear = frame["displayed"]
        encoded = np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * np.maximum(linear, 1e-9) ** (1 / 2.4) - 0.055)
        shown = reflet.tone_map(frame["final"] * frame.record["exposure"])
        self.assertLess(np.abs(shown - encoded).max(), 2.5 / 255)
        self.assertAlmostEqual(np.log2(frame.record["exposure"]), frame.exposure, places=5)
        self.assertEqual(frame.damage(), "")

    def test_a_frame_reprojects_to_the_one_before(self):
        frame, before = self.data[1], self.data[0]
        image, same = reflet.reproject(frame, before)
        self.assertGreater(same.mean(), 0.6)
        moved = np.abs(reflet.tone_map(image) - reflet.tone_map(frame["final"]))[same].mean()
        still = np.abs(reflet.tone_map(before["final"]) - reflet.tone_map(frame["final"])).mean()
        self.assertLess(moved, 0.8 * still)
        # Positions are the same points of the world.
        there, same = reflet.reproject(frame, before, np.nan_to_num(reflet.positions(before)))
        away = np.linalg.norm(there - reflet.positions(frame), axis=-1)[same & (frame["depth"] > 0)]
        self.assertLess(np.median(away / frame["depth"][same & (frame["depth"] > 0)]), 0.005)

    def test_background_that_was_behind_the_camera_is_masked(self):
        folder = Path(self.folder) / "turn"
        folder.mkdir()
        path = folder / "path.json"
        # Up to the sky: turned by 45 degrees, then back and around.
        path.write_text(json.dumps({"keyframes": [
            {"time": time, "position": [0, 30, 0], "target": [x, 40, z], "easing": "step", "fov_y": 60}
            for time, x, z in ((0, 0, -10), (1, 7, -7), (2, -7, 7))]}))
        subprocess.run([reflet.program(), "dataset", "builtin:cubes", "-o", folder / "data", "--size", "48x27",
                        "--frames", "3", "--cameras", "path", "--path", path, "--fps", "1", "--spp", "1", "--noisy", "1"],
                       check=True, capture_output=True)
        data = reflet.open_dataset(folder / "data")
        shares = []
        for number in (1, 2):
            self.assertFalse((data[number]["depth"] > 0).any())
            shares.append(reflet.reproject(data[number], data[number - 1])[1].mean())
        self.assertGreater(shares[0], 0.4)
        self.assertLess(shares[0], 0.7)
        self.assertEqual(shares[1], 0)

    def test_the_header_has_the_camera(self):
        frame = self.data[1]
        header = reflet.read_exr(Path(frame.folder) / frame.record["files"][0]["file"]).attributes
        point = np.append(reflet.positions(frame)[13, 24], 1)
        seen = header["worldToNDC"] @ point
        self.assertTrue(np.allclose(seen[:2] / seen[3], ((24.5) / 48, 13.5 / 27), atol=1e-4))
        self.assertAlmostEqual((header["worldToCamera"] @ point)[2], frame["depth"][13, 24], places=3)

    def test_the_camera_of_a_record_is_one_of_a_view_file(self):
        frame = self.data[2]
        view = Path(self.folder) / "view.json"
        view.write_text(json.dumps({"camera": frame.record["camera"]}))
        again = reflet.reference("builtin:" + frame.scene, size=(48, 27), spp=1, options=["--view-file", str(view)])
        off = np.abs(again["depth"] - frame["depth"]) > 1e-3 * (1 + frame["depth"])
        self.assertLess(off.mean(), 0.01)


class ProgramTest(unittest.TestCase):
    def test_the_version_is_that_of_the_program(self):
        said = subprocess.run([reflet.program(), "--version"], capture_output=True, text=True, check=True).stdout
        self.assertEqual(re.search(r"\d+\.\d+\.\d+", said)[0], reflet.__version__)

    def test_images_render_without_files(self):
        image = reflet.render("builtin:cubes", size=(32, 18), preset="plain", frames=1, diffuse__rays=2,
                              layers=("direct", "indirect_diffuse", "indirect_specular"))
        self.assertEqual(image[""].shape, (18, 32, 3))
        scale = image[""].max(axis=-1, keepdims=True) + 0.01
        self.assertLess((np.abs(reflet.recombine(image) - image[""]) / scale).max(), 2e-3)
        with self.assertRaisesRegex(reflet.RefletError, "diffuse.ray"):
            reflet.render("builtin:cubes", size=(32, 18), diffuse__ray=2)

    def test_compare_and_tone_map_are_the_programs(self):
        with tempfile.TemporaryDirectory() as folder:
            files = [os.path.join(folder, name) for name in ("a.exr", "a.png")]
            subprocess.run([reflet.program(), "reference", "builtin:gloss", "--size", "48x27", "--spp", "4", "-o", files[0],
                            "-o", files[1]], check=True, capture_output=True)
            image = reflet.read_exr(files[0])[""]
            self.assertLess(np.abs(255 * reflet.tone_map(image) - read_png(files[1])).max(), 1.01)
        self.assertEqual(reflet.compare(image, image)["flip"], 0)
        self.assertGreater(reflet.compare(image, 1.5 * image)["flip"], 0.02)

    def test_exr_files_that_are_none_are_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "a.exr")
            image = np.random.default_rng(1).random((5, 7, 3), np.float32)
            reflet.write_exr(file, {"": image, "depth": image[..., 0]})
            self.assertTrue(np.array_equal(reflet.read_exr(file)[""], image))
            self.assertTrue(np.array_equal(reflet.read_exr(file)["depth"], image[..., 0]))
            whole = Path(file).read_bytes()
            for content in (b"", b"text", whole[:100], whole[:-40]):
                Path(file).write_bytes(content)
                with self.assertRaises(ValueError):
                    reflet.read_exr(file)


if __name__ == "__main__":
    unittest.main()
