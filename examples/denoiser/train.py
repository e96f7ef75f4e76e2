#!/usr/bin/env python3
"""Trains a small denoiser on a data set of Reflet, with NumPy alone, and compares it with the box filter.

Each pixel gets a kernel of 7x7 weights: exp(-sum of theta_k d_k), normalized, where the d_k are squared differences to the
neighbour in place, normal, albedo, depth and colour. What is learned is how the five theta follow from the pixel's
surroundings: theta = softplus(features W). That is a kernel-predicting filter (Bako et al. 2017) whose network is one
layer, small enough to derive by hand, and trained in a minute.

    reflet dataset builtin:cubes builtin:cave builtin:cornell builtin:gloss builtin:moving -o data --frames 64 \
        --spp 128 --noise 0.05 --noisy 4 --seed 1
    PYTHONPATH=python python3 examples/denoiser/train.py data
"""

import argparse
import time

import numpy as np

import reflet

RADIUS = 3
OFFSETS = [(dy, dx) for dy in range(-RADIUS, RADIUS + 1) for dx in range(-RADIUS, RADIUS + 1)]
PLACE = np.array([dx * dx + dy * dy for dy, dx in OFFSETS], np.float32) / RADIUS ** 2
FLOOR = 0.05  # of the relative error


def luminance(colour):
    return colour @ np.array([0.2126, 0.7152, 0.0722], np.float32)


def box(image, radius):
    """Mean over (2 radius + 1)², edges repeated."""
    padded = np.pad(image, [(radius, radius), (radius, radius)] + [(0, 0)] * (image.ndim - 2), mode="edge")
    height, width = image.shape[:2]
    size = 2 * radius + 1
    return sum(padded[y:y + height, x:x + width] for y in range(size) for x in range(size)) / size ** 2


class Pair:
    """A noisy and a clean image, and what the filter looks at: guides to compare neighbours by, features of a pixel."""

    def __init__(self, frame, version):
        noisy = frame.noisy[version]
        self.noisy, self.clean = noisy["final"], frame["final"]
        self.albedo = noisy["albedo"] + 0.02  # divided out, so that textures are not blurred; 1 of emission and sky
        self.albedo = np.where(frame["depth"][..., None] > 0, self.albedo, 1.0).astype(np.float32)
        # A bright sample must not outweigh all others.
        lit = np.minimum(self.noisy / self.albedo, 20.0)
        self.lit = lit
        depth = np.log(frame["depth"] + 0.1)
        compressed = np.log1p(box(lit, 1))  # less noisy than a pixel
        self.guides = [(frame["normal"], 1.0), (noisy["albedo"], 4.0), (depth[..., None], 30.0), (compressed, 2.0)]
        light = luminance(lit)
        mean, square = box(light, RADIUS), box(light ** 2, RADIUS)
        spread = np.sqrt(np.maximum(square - mean ** 2, 0)) / (mean + 0.01)
        edges = [np.sqrt(np.maximum((box(g ** 2, 1) - box(g, 1) ** 2).sum(-1), 0)) for g, _ in self.guides[:3]]
        features = [np.ones_like(mean), np.log(mean + 0.01), spread, *edges]
        self.features = np.stack(features, -1).astype(np.float32)
        pad = [(RADIUS, RADIUS), (RADIUS, RADIUS), (0, 0)]
        self.padded = [np.pad(lit, pad, mode="edge")] + [np.pad(g, pad, mode="edge") for g, _ in self.guides]

    def neighbours(self, y, x):
        """Colours (n x 49 x 3) and differences (n x 49 x 5) of pixels."""
        ys = y[:, None] + np.array([dy for dy, _ in OFFSETS]) + RADIUS
        xs = x[:, None] + np.array([dx for _, dx in OFFSETS]) + RADIUS
        differences = [np.broadcast_to(PLACE, ys.shape)]
        for (guide, scale), padded in zip(self.guides, self.padded[1:]):
            differences.append(scale * ((padded[ys, xs] - guide[y, x][:, None]) ** 2).sum(-1))
        return self.padded[0][ys, xs], np.stack(differences, -1)


def softplus(x):
    return np.logaddexp(0, x)


def filtered(weights, features, colours, differences):
    """The filter, and what its derivative needs."""
    raw = features @ weights  # n x 5
    theta = softplus(raw)
    logits = -(differences * theta[:, None]).sum(-1)
    kernel = np.exp(logits - logits.max(-1, keepdims=True))
    kernel /= kernel.sum(-1, keepdims=True)
    return (kernel[..., None] * colours).sum(1), kernel, raw


def gradient(weights, features, colours, differences, albedo, clean):
    """Of the mean relative squared error with respect to the weights."""
    lit, kernel, raw = filtered(weights, features, colours, differences)
    error = (lit * albedo - clean) / (clean + FLOOR)
    loss = np.minimum(error ** 2, 1.0)  # what the kernel cannot reach must not lead it
    by_lit = np.where(error ** 2 < 1.0, 2 * error * albedo / (clean + FLOOR), 0) / error.size
    by_logit = kernel * ((colours - lit[:, None]) * by_lit[:, None]).sum(-1)
    by_theta = -(differences * by_logit[..., None]).sum(1)
    by_raw = by_theta / (1 + np.exp(-raw))
    return loss.mean(), features.T @ by_raw


def train(pairs, steps, seed=0):
    random = np.random.default_rng(seed)
    weights = np.zeros((pairs[0].features.shape[-1], 5))
    weights[0] = 2.0  # begins with a narrow kernel, which changes little
    mean = np.zeros_like(weights)
    square = np.zeros_like(weights)
    for step in range(1, steps + 1):  # Adam
        batch = []
        for _ in range(4):
            pair = pairs[random.integers(len(pairs))]
            height, width = pair.clean.shape[:2]
            y, x = random.integers(height, size=1024), random.integers(width, size=1024)
            batch.append((pair.features[y, x], *pair.neighbours(y, x), pair.albedo[y, x], pair.clean[y, x]))
        loss, slope = gradient(weights, *(np.concatenate(part) for part in zip(*batch)))
        mean += 0.1 * (slope - mean)
        square += 0.01 * (slope ** 2 - square)
        rate = 0.05 * min(1.0, 2 - 2 * step / steps)
        weights -= rate * (mean / (1 - 0.9 ** step)) / (np.sqrt(square / (1 - 0.99 ** step)) + 1e-9)
        if step % 100 == 0:
            print(f"step {step}: loss {loss:.4f}")
    return weights


def apply(weights, pair):
    height, width = pair.clean.shape[:2]
    out = np.empty_like(pair.clean)
    for row in range(height):
        y, x = np.full(width, row), np.arange(width)
        out[row] = filtered(weights, pair.features[y, x], *pair.neighbours(y, x))[0] * pair.albedo[y, x]
    return out


def relative_error(image, clean):
    return float((((image - clean) / (clean + FLOOR)) ** 2).mean())


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("data")
    options.add_argument("--version", default="spp4", help="the noisy images to train with")
    options.add_argument("--steps", type=int, default=400)
    options.add_argument("--pairs", type=int, default=64)
    chosen = options.parse_args()

    start = time.monotonic()
    pairs = [Pair(frame, chosen.version) for frame in reflet.open_dataset(chosen.data)[:chosen.pairs]]
    tested = pairs[3::4]
    learned_from = [pair for i, pair in enumerate(pairs) if i % 4 != 3]
    print(f"{len(learned_from)} pairs to learn from, {len(tested)} to test with, read in {time.monotonic() - start:.1f} s")
    start = time.monotonic()
    weights = train(learned_from, chosen.steps)
    print(f"trained in {time.monotonic() - start:.0f} s")

    def boxed(pair, radius):
        return box(pair.noisy, radius)

    best = min(range(1, 6), key=lambda r: np.mean([relative_error(boxed(p, r), p.clean) for p in learned_from]))
    images = {"noisy": [p.noisy for p in tested], f"box {2 * best + 1}x{2 * best + 1}": [boxed(p, best) for p in tested],
              "learned": [apply(weights, p) for p in tested]}
    print(f"{'':10} {'relative MSE':>13} {'FLIP':>7}   over {len(tested)} images that it has not seen")
    for name, filtered_images in images.items():
        error = np.mean([relative_error(i, p.clean) for i, p in zip(filtered_images, tested)])
        flip = np.mean([reflet.compare(i, p.clean)["flip"] for i, p in zip(filtered_images, tested)])
        print(f"{name:10} {error:13.4f} {flip:7.4f}")


if __name__ == "__main__":
    main()
