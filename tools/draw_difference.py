#!/usr/bin/env python3
"""Draws a part of a mask, and in red the cells in which another mask differs from it.

usage: tools/draw_difference.py TRUTH.pgm OTHER.pgm X Y SIDE ZOOM OUT.ppm
  TRUTH, OTHER  masks as `duskline shadow --of PNM` writes them: 0 in shadow, 1 in the light
  X Y SIDE      first column, first row, width and height of the part, in cells
  ZOOM          pixels to a cell
"""

import sys

LIT, SHADE = (244, 240, 230), (74, 88, 104)
WRONGLY_LIT, WRONGLY_SHADED = (240, 120, 60), (200, 30, 40)


def read(path):
    data = open(path, "rb").read()
    magic, width, height, _ = data.split(None, 4)[:4]
    if magic != b"P5":
        sys.exit(f"draw_difference: {path} is no PGM file")
    width, height = int(width), int(height)
    return width, data[len(data) - width * height :]


def colour(truth, other):
    if truth == other:
        return LIT if truth == 1 else SHADE
    return WRONGLY_LIT if other == 1 else WRONGLY_SHADED


def main(truth_path, other_path, x, y, side, zoom, out):
    x, y, side, zoom = int(x), int(y), int(side), int(zoom)
    width, truth = read(truth_path)
    _, other = read(other_path)
    with open(out, "wb") as ppm:
        ppm.write(f"P6\n{side * zoom} {side * zoom}\n255\n".encode())
        for row in range(y, y + side):
            cells = range(row * width + x, row * width + x + side)
            line = b"".join(bytes(colour(truth[i], other[i])) * zoom for i in cells)
            ppm.write(line * zoom)
    wrong = sum(a != b for a, b in zip(truth, other))
    print(f"{100 * wrong / len(truth):.3f} % of the cells differ")


if __name__ == "__main__":
    if len(sys.argv) != 8:
        sys.exit(__doc__)
    main(*sys.argv[1:])
