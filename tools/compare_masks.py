#!/usr/bin/env python3
"""Says in how many cells two shadow masks differ, and how far from a shadow edge.

usage: tools/compare_masks.py TRUTH OTHER [--list N] [--picture PNG] [--part X,Y,COLUMNS,ROWS] [--zoom N] [--json]

  TRUTH, OTHER   masks of one size, as `duskline shadow` writes them: 0 shadow, 1 (or 255 in a
                 picture) lit; 255 in a TIFF no data
  --list N       also print the first N cells that differ, row and column from 0
  --picture PNG  draw TRUTH in grey; red where OTHER lights its shadow, blue where it darkens its light
  --part X,Y,COLUMNS,ROWS
                 draw only this part, from column X and row Y on
  --zoom N       draw every cell as N x N pixels
  --json         print one JSON object instead

A cell is at distance 1 when one of its eight neighbours in TRUTH has the other answer, at distance 2 when
one of theirs has, and so on. Exit status: 0 the same, 1 different, 2 not comparable. Needs GDAL's command
line (gdal-bin).
"""

import argparse
import json
import pathlib
import re
import subprocess
import sys
import tempfile

SHADOW, LIT, NO_DATA = 0, 1, 255

COLOURS = {
    "lit": (235, 235, 230),
    "shadow": (120, 125, 140),
    "no data": (255, 255, 255),
    "false light": (215, 30, 30),
    "false shadow": (25, 75, 220),
}


class Mask:
    """Bytes, row after row: 0 shadow, 1 lit, 255 no data."""

    def __init__(self, columns, values):
        self.columns = columns
        self.rows = len(values) // columns if columns else 0
        self.values = values

    def at(self, row, column):
        return self.values[row * self.columns + column]

    def part(self, x, y, columns, rows):
        """A mask of its own; none when it reaches out of this one."""
        if min(x, y) < 0 or min(columns, rows) < 1 or x + columns > self.columns or y + rows > self.rows:
            return None
        return Mask(columns, b"".join(self.row_part(row, x, x + columns - 1) for row in range(y, y + rows)))

    def row_part(self, row, first, last):
        """Columns first to last, both included, as far as they are in the mask; empty outside its rows."""
        if not 0 <= row < self.rows:
            return b""
        start = row * self.columns
        return self.values[start + max(first, 0) : start + min(last, self.columns - 1) + 1]

    def column_part(self, column, first, last):
        if not 0 <= column < self.columns:
            return b""
        first, last = max(first, 0), min(last, self.rows - 1)
        return self.values[first * self.columns + column : last * self.columns + column + 1 : self.columns]

    def edge_distance(self, row, column):
        """Cells to the nearest one with the other answer; 0 when there is none."""
        own = self.at(row, column)
        other = {SHADOW: LIT, LIT: SHADOW}.get(own)
        if other is None:
            return 0
        for distance in range(1, max(self.rows, self.columns)):
            top, bottom = row - distance, row + distance
            left, right = column - distance, column + distance
            ring = (
                self.row_part(top, left, right),
                self.row_part(bottom, left, right),
                self.column_part(left, top, bottom),
                self.column_part(right, top, bottom),
            )
            if any(other in part for part in ring):
                return distance
        return 0


def differing_cells(truth, other):
    """Indices of the bytes in which the two differ, in order."""
    both = int.from_bytes(truth.values, "big") ^ int.from_bytes(other.values, "big")
    return [match.start() for match in re.finditer(rb"[^\0]", both.to_bytes(len(truth.values), "big"))]


def compare(truth, other):
    """What is said about two masks of one size."""
    result = {
        "cells": len(truth.values),
        "no_data": truth.values.count(NO_DATA),
        "shadow": truth.values.count(SHADOW),
        "differ": 0,
        "false_light": 0,
        "false_shadow": 0,
        "distances": {},
    }
    for index in differing_cells(truth, other):
        row, column = divmod(index, truth.columns)
        pair = truth.values[index], other.values[index]
        result["differ"] += 1
        result["false_light"] += pair == (SHADOW, LIT)
        result["false_shadow"] += pair == (LIT, SHADOW)
        distance = truth.edge_distance(row, column)
        result["distances"][distance] = result["distances"].get(distance, 0) + 1
    result["distances"] = dict(sorted(result["distances"].items()))
    return result


def run_gdal(*command):
    try:
        return subprocess.run(command, check=True, capture_output=True, text=True).stdout
    except FileNotFoundError:
        stop(f"{command[0]} is not installed (Debian: gdal-bin)")
    except subprocess.CalledProcessError as error:
        reasons = error.stderr.strip().splitlines() or [f"{command[0]} failed"]
        stop(re.sub(r"^ERROR \d+: ", "", reasons[0]))


def read_mask(path):
    facts = json.loads(run_gdal("gdalinfo", "-json", path))
    with tempfile.TemporaryDirectory() as folder:
        raw = pathlib.Path(folder) / "mask"
        run_gdal("gdal_translate", "-q", "-of", "ENVI", "-ot", "Byte", "-b", "1", path, str(raw))
        values = raw.read_bytes()
    if facts["driverShortName"] in ("PNG", "JPEG"):  # 0 shadow, 255 lit, 128 no data
        values = values.translate(bytes([SHADOW] + [NO_DATA] * 254 + [LIT]))
    if other := sorted(set(values) - {SHADOW, LIT, NO_DATA}):
        stop(f"'{path}' is no shadow mask: it holds {other[0]}, and not only 0, 1 and 255")
    return Mask(facts["size"][0], values)


def colours(truth, other):
    names = {SHADOW: "shadow", LIT: "lit", NO_DATA: "no data"}
    pixels = bytearray(b"".join(map(lambda value: bytes(COLOURS[names[value]]), truth.values)))
    for index in differing_cells(truth, other):
        name = "false light" if other.values[index] == LIT else "false shadow"
        pixels[3 * index : 3 * index + 3] = bytes(COLOURS[name])
    return bytes(pixels)


def zoomed(pixels, columns, zoom):
    """Rows of `columns` pixels of three bytes, every pixel `zoom` times across and down."""
    rows = (pixels[start : start + 3 * columns] for start in range(0, len(pixels), 3 * columns))
    return b"".join(b"".join(row[i : i + 3] * zoom for i in range(0, len(row), 3)) * zoom for row in rows)


def draw(truth, other, path, zoom):
    with tempfile.TemporaryDirectory() as folder:
        ppm = pathlib.Path(folder) / "difference.ppm"
        header = f"P6 {truth.columns * zoom} {truth.rows * zoom} 255\n".encode()
        ppm.write_bytes(header + zoomed(colours(truth, other), truth.columns, zoom))
        run_gdal("gdal_translate", "-q", "-of", "PNG", "--config", "GDAL_PAM_ENABLED", "NO", str(ppm), path)


def in_words(result):
    def share(count):
        return f"{100 * count / max(result['cells'], 1):.4f} %"

    lines = [
        f"{result['differ']} of {result['cells']} cells differ ({share(result['differ'])}): "
        f"{result['false_light']} lit that should be in shadow, "
        f"{result['false_shadow']} in shadow that should be lit"
    ]
    for distance, count in result["distances"].items():
        where = f"{distance} cell{'s' if distance > 1 else ''} from a shadow edge" if distance else "no edge"
        lines.append(f"  {count:8d}  {where}")
    return "\n".join(lines)


def stop(why):
    print(f"compare_masks: {why}", file=sys.stderr)
    sys.exit(2)


def window(text):
    numbers = tuple(map(int, text.split(",")))
    if len(numbers) != 4:
        raise ValueError
    return numbers


def main():
    parser = argparse.ArgumentParser(usage=__doc__.split("usage: ")[1].split("\n")[0], add_help=False)
    parser.add_argument("-h", "--help", action="store_true")
    parser.add_argument("masks", nargs="*")
    parser.add_argument("--list", type=int, default=0)
    parser.add_argument("--picture")
    parser.add_argument("--part", type=window)
    parser.add_argument("--zoom", type=int, default=1)
    parser.add_argument("--json", action="store_true")
    options = parser.parse_args()
    if options.help:
        print(__doc__.strip())
        return 0
    if len(options.masks) != 2:
        parser.error("two masks are needed")

    truth, other = map(read_mask, options.masks)
    if (truth.rows, truth.columns) != (other.rows, other.columns):
        stop(f"{truth.rows} x {truth.columns} cells cannot be compared with {other.rows} x {other.columns}")
    result = compare(truth, other)
    print(json.dumps(result) if options.json else in_words(result))
    for index in differing_cells(truth, other)[: options.list]:
        row, column = divmod(index, truth.columns)
        print(f"  row {row}, column {column}: {truth.at(row, column)}, and {other.at(row, column)} in the other")
    if options.picture:
        parts = [mask.part(*options.part) if options.part else mask for mask in (truth, other)]
        if None in parts:
            stop(f"--part reaches out of the masks, which have {truth.columns} columns and {truth.rows} rows")
        draw(*parts, options.picture, max(options.zoom, 1))
    return 1 if result["differ"] else 0


if __name__ == "__main__":
    sys.exit(main())
