#!/usr/bin/env python3
"""Steps that waves of 64 rays make for each ray, without and with phases (trace_screen.compaction): docs/wave_steps.py.

From pictures of steps per ray on any device: `quality`, 960x540, one tile of 8x8 pixels a wave; rays that go on are taken
in the order of the tiles. The figures are in docs/methods/hierarchical-depth.md and docs/gpu_model.py. Needs a built program.
"""
import os
import subprocess
import tempfile

from methods import read_png

SCENES = ("cave", "cubes", "gloss", "colonnade", "moving")
SIZE = (960, 540)


def tiles(scene, lobe, folder):
    """Steps of the rays of each tile; the picture's white is 128 steps."""
    path = os.path.join(folder, f"{scene}-{lobe}.png")
    subprocess.run(["build/bin/reflet", "render", "builtin:" + scene, "--preset", "quality", "--size", f"{SIZE[0]}x{SIZE[1]}", "--frames",
                    "3", "--show", lobe + "_steps", "-o", path, "--quiet"], check=True)
    rows = read_png(path)[2]
    steps = [[round(row[3 * x] * 128 / 255) for x in range(SIZE[0])] for row in rows]
    return [[steps[y + i][x + j] for i in range(8) for j in range(8)]
            for y in range(0, SIZE[1] // 8 * 8, 8) for x in range(0, SIZE[0] // 8 * 8, 8)]


def wave_steps(waves, ends):
    """Steps of all lanes, if rays that have not ended after `ends` steps go on in new waves."""
    made, total = 0, 0
    for end in (*ends, 10000):
        total += 64 * sum(max(min(max(wave), end) - made, 0) for wave in waves)
        left = [steps for wave in waves for steps in wave if steps > end]
        waves = [left[i:i + 64] for i in range(0, len(left), 64)]
        made = end
    return total


def main():
    print("| rays | mean | waves of 64 | phases: 32 | 32, 64 |\n|---|--:|--:|--:|--:|")
    with tempfile.TemporaryDirectory() as folder:
        for lobe in ("specular", "diffuse"):
            sums = [0.0] * 4
            for scene in SCENES:
                waves = tiles(scene, lobe, folder)
                rays = sum(steps > 0 for wave in waves for steps in wave)
                values = [sum(map(sum, waves))] + [wave_steps(waves, ends) for ends in ((), (32,), (32, 64))]
                sums = [s + v / rays / len(SCENES) for s, v in zip(sums, values)]
            print(f"| {lobe} | " + " | ".join(f"{s:.0f}" for s in sums) + " |")


if __name__ == "__main__":
    main()
