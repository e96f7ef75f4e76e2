#!/usr/bin/env python3
"""street.py DIRECT REFLET REFERENCE OUT.png: three pictures of one size as slanted bands of one, with lines between."""
import sys

from methods import read_png, write_png

SLANT, LINE = 40, 2  # pixels: how far a border moves from the top to the bottom; its width


def main():
    pictures = [read_png(path) for path in sys.argv[1:4]]
    width, height, _ = pictures[0]
    assert all(p[:2] == (width, height) for p in pictures), "pictures of several sizes"
    rows = []
    for y in range(height):
        move = round(SLANT * (0.5 - y / (height - 1)))
        borders = [0] + [width * i // 3 + move for i in (1, 2)] + [width]
        parts = [picture[2][y][3 * a:3 * b] for picture, a, b in zip(pictures, borders, borders[1:])]
        line = bytearray(b"".join(parts))
        for border in borders[1:3]:
            line[3 * border - 3 * LINE // 2:3 * border + 3 * LINE // 2] = b"\xff" * 3 * LINE
        rows.append(bytes(line))
    write_png(sys.argv[4], (width, height, rows))


main()
