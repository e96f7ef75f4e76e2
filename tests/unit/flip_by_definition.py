#!/usr/bin/env python3
"""A slow reference implementation of FLIP and HDR-FLIP: two-dimensional filters, double precision, pixel by pixel.

The numbers in flip_test.cpp, AgreesWithTheDefinition..., are what this prints. It shares nothing with src/compare but
the papers. Needs Python 3 alone and takes a few seconds.
"""
from math import ceil, cos, exp, hypot, log2, pi, sin, sqrt

WIDTH, HEIGHT, PPD = 24, 16, 30.0

TO_XYZ = [[10135552 / 24577794, 8788810 / 24577794, 4435075 / 24577794],
          [2613072 / 12288897, 8788810 / 12288897, 887015 / 12288897],
          [1425312 / 73733382, 8788810 / 73733382, 70074185 / 73733382]]
WHITE = [sum(row) for row in TO_XYZ]


def times(matrix, v):
    return [sum(m * x for m, x in zip(row, v)) for row in matrix]


def solve(matrix, v):
    """Cramer's rule."""
    def det(m):
        return sum(m[0][i] * (m[1][(i + 1) % 3] * m[2][(i + 2) % 3] - m[1][(i + 2) % 3] * m[2][(i + 1) % 3])
                   for i in range(3))
    result = []
    for column in range(3):
        changed = [[v[r] if c == column else matrix[r][c] for c in range(3)] for r in range(3)]
        result.append(det(changed) / det(matrix))
    return result


def opponent(rgb):
    x, y, z = (c / w for c, w in zip(times(TO_XYZ, rgb), WHITE))
    return [116 * y - 16, 500 * (x - y), 200 * (y - z)]


def from_opponent(color):
    y = (color[0] + 16) / 116
    return solve(TO_XYZ, [WHITE[0] * (y + color[1] / 500), WHITE[1] * y, WHITE[2] * (y - color[2] / 200)])


def hunt_lab(rgb):
    def curve(t):
        return t ** (1 / 3) if t > (6 / 29) ** 3 else t / (3 * (6 / 29) ** 2) + 4 / 29
    x, y, z = (curve(c / w) for c, w in zip(times(TO_XYZ, rgb), WHITE))
    lightness = 116 * y - 16
    return [lightness, 0.01 * lightness * 500 * (x - y), 0.01 * lightness * 200 * (y - z)]


def convolve(image, kernel):
    """image[y][x] over a square kernel of (dx, dy) -> weight; borders repeat."""
    def at(x, y):
        return image[min(max(y, 0), HEIGHT - 1)][min(max(x, 0), WIDTH - 1)]
    return [[sum(w * at(x + dx, y + dy) for (dx, dy), w in kernel.items()) for x in range(WIDTH)]
            for y in range(HEIGHT)]


def square(radius, weight):
    return {(x, y): weight(x, y) for x in range(-radius, radius + 1) for y in range(-radius, radius + 1)}


def eye_filter(a1, b1, a2, b2):
    def weight(x, y):
        d2 = (x * x + y * y) / PPD ** 2
        return a1 * sqrt(pi / b1) * exp(-pi ** 2 * d2 / b1) + a2 * sqrt(pi / b2) * exp(-pi ** 2 * d2 / b2)
    kernel = square(ceil(3 * sqrt(0.04 / (2 * pi ** 2)) * PPD), weight)
    total = sum(kernel.values())
    return {k: w / total for k, w in kernel.items()}


def detectors(along):
    """Edge and point detectors; along is 0 for x and 1 for y."""
    deviation = 0.5 * 0.082 * PPD
    def gauss(x, y):
        return exp(-(x * x + y * y) / (2 * deviation ** 2))
    def edge(x, y):
        return -(x, y)[along] * gauss(x, y)
    def point(x, y):
        return ((x, y)[along] ** 2 / deviation ** 2 - 1) * gauss(x, y)
    result = []
    for weight in (edge, point):
        kernel = square(ceil(3 * deviation), weight)
        positive = sum(w for w in kernel.values() if w > 0)
        negative = -sum(w for w in kernel.values() if w < 0)
        result.append({k: w / (positive if w > 0 else negative) for k, w in kernel.items()})
    return result


def perceived(planes):
    blurred = [convolve(p, eye_filter(*s)) for p, s in
               zip(planes, [(1, 0.0047, 0, 1e-5), (1, 0.0053, 0, 1e-5), (34.1, 0.04, 13.5, 0.025)])]
    return [[hunt_lab([min(max(c, 0), 1) for c in from_opponent([p[y][x] for p in blurred])])
             for x in range(WIDTH)] for y in range(HEIGHT)]


def features(planes):
    """(edge, point) per pixel."""
    grey = [[(v + 16) / 116 for v in row] for row in planes[0]]
    (edge_x, point_x), (edge_y, point_y) = [[convolve(grey, k) for k in detectors(along)] for along in (0, 1)]
    return [[(hypot(edge_x[y][x], edge_y[y][x]), hypot(point_x[y][x], point_y[y][x]))
             for x in range(WIDTH)] for y in range(HEIGHT)]


def hyab(a, b):
    return abs(a[0] - b[0]) + hypot(a[1] - b[1], a[2] - b[2])


def flip(a, b):
    """Of images[y][x] = linear RGB in 0..1."""
    planes_a, planes_b = [[[[opponent(p)[c] for p in row] for row in image] for c in range(3)] for image in (a, b)]
    colors_a, colors_b, features_a, features_b = (perceived(planes_a), perceived(planes_b), features(planes_a),
                                                  features(planes_b))
    largest = hyab(hunt_lab([0, 1, 0]), hunt_lab([0, 0, 1])) ** 0.7
    result = []
    for y in range(HEIGHT):
        for x in range(WIDTH):
            e = hyab(colors_a[y][x], colors_b[y][x]) ** 0.7
            color = (0.95 * e / (0.4 * largest) if e < 0.4 * largest
                     else 0.95 + 0.05 * (e - 0.4 * largest) / (0.6 * largest))
            feature = (max(abs(m - n) for m, n in zip(features_a[y][x], features_b[y][x])) / sqrt(2)) ** 0.5
            result.append(color ** (1 - feature))
    return result


def tone(x):
    x *= 0.6
    return min(max((2.51 * x * x + 0.03 * x) / (2.43 * x * x + 0.59 * x + 0.14), 0), 1)


def hdr_flip(picture, reference):
    a, b, c = 0.85 * 2.43 - 2.51, 0.85 * 0.59 - 0.03, 0.85 * 0.14
    bright = (-b - sqrt(b * b - 4 * a * c)) / (2 * a) / 0.6
    luminances = sorted(times(TO_XYZ, p)[1] for row in reference for p in row)
    middle = len(luminances) // 2
    start = log2(bright / luminances[-1])
    stop = log2(bright / (0.5 * (luminances[middle - 1] + luminances[middle])))
    count = max(2, ceil(stop - start))
    flips = []
    for i in range(count):
        factor = 2 ** (start + (stop - start) * i / (count - 1))
        flips.append(flip(*[[[[tone(factor * v) for v in p] for p in row] for row in image]
                            for image in (picture, reference)]))
    print(f"HDR: start {start:.6f} stop {stop:.6f} count {count}")
    return [max(values) for values in zip(*flips)]


def display_pattern(phase):
    """Linear colours in 0..1; that of phase 0 has a dark line."""
    return [[[0.05 if x == 9 and phase == 0 else 0.5 + 0.45 * sin(phase + 0.4 * x * (1 + c) + 0.3 * y) for c in range(3)]
             for x in range(WIDTH)] for y in range(HEIGHT)]


def radiance_pattern(phase):
    return [[[exp(2.5 * cos(phase + 0.3 * x + 0.5 * c) + 0.2 * y) for c in range(3)] for x in range(WIDTH)]
            for y in range(HEIGHT)]


def report(name, values):
    print(f"{name}: mean {sum(values) / len(values):.6f} max {max(values):.6f} "
          f"(9, 5) {values[5 * WIDTH + 9]:.6f} (0, 0) {values[0]:.6f}")


report("FLIP", flip(display_pattern(0.0), display_pattern(0.3)))
report("HDR-FLIP", hdr_flip(radiance_pattern(0.1), radiance_pattern(0.0)))
