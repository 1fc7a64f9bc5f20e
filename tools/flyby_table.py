#!/usr/bin/env python3
"""Flies over a terrain with every technique of duskline-viewer, made smaller to 512 cells a side and at its own size, and prints
the tables of docs/viewer.md: the paper's beside ours, and what every technique costs and gets wrong. Needs gdal_translate, and
neither window nor display.

usage: tools/flyby_table.py VIEWER DEM [FRAMES [AT_MOST_S [WxH]]]

    FRAMES      of each flight, else 1000
    AT_MOST_S   seconds for each flight (--at-most), else as long as it takes
    WxH         pixels, else 1024x768
"""

import json
import os
import pathlib
import subprocess
import sys
import tempfile

SMALL = "512"
ALTITUDE_DEG = "5"  # of the light: shadows that matter

# V. Sakalauskas, Hybrid Terrain Shadow Ray Casting, WSCG 2008, table 1: frames a second on a GeForce 7900 GTX, least, most and
# mean, over Hawaii at 512 x 512 and at 2048 x 2048. To each the flight that does the same here, and whether its light rests.
PAPER = [
    ("no shadow", ("none", False), (57.49, 80.82, 69.08), (28.64, 37.29, 30.94)),
    ("full scan", ("full-scan", False), (4.13, 15.63, 8.18), (1.25, 4.70, 2.32)),
    ("binary search", ("smap-binary", False), (31.08, 39.29, 34.53), (2.10, 2.14, 2.12)),
    ("quad search", ("smap-quad", False), (32.45, 40.00, 35.80), (5.04, 5.21, 5.10)),
    ("parallel quad", ("smap-parallel", False), (37.85, 47.72, 42.61), (9.27, 10.57, 10.02)),
    ("precomputed", ("smap-parallel", True), (50.44, 65.05, 58.65), (21.07, 35.18, 26.24)),
]


def fly(viewer, dem, frames, at_most, size, report):
    limit = ["--at-most", at_most] if at_most else []
    subprocess.run([viewer, dem, "--flyby", frames, "--technique", "all", "--altitude", ALTITUDE_DEG, "--size", size, *limit,
                    "--report", report, "--quiet"], check=True)
    return json.loads(pathlib.Path(report).read_text())


def flights_of(report):
    return {(flight["technique"], flight["light_at_rest"]): flight for flight in report["flights"]}


def row(cells):
    return "| " + " | ".join(cells) + " |"


def table(head, rows):
    return "\n".join([row(head), "|" + "---|" * len(head), *map(row, rows)])


def rates(flight):
    fps = flight["fps"]
    return [f"{fps[key]:.2f}" for key in ("least", "most", "mean")]


def paper_table(report, column):
    """The paper's rows for a size, its figures beside those of the report."""
    flights = flights_of(report)
    head = [f"{report['columns']} x {report['rows']}", "paper: least fps", "most", "mean", "here: least fps", "most", "mean",
            "frames"]
    return table(head, ([line[0], *(f"{fps:.2f}" for fps in line[column]), *rates(flights[line[1]]),
                         str(flights[line[1]]["frames"])] for line in PAPER))


def milliseconds(flight, key):
    return f"{flight[key]:.1f}" if key in flight else ""


def all_table(report):
    head = [f"{report['columns']} x {report['rows']}", "least fps", "most", "mean", "build, ms", "look up, ms", "draw in all, ms",
            "cells wrong", "Black", "frames"]
    return table(head, ([flight["technique"] + (", light at rest" if flight["light_at_rest"] else ""), *rates(flight),
                         milliseconds(flight, "mean_cast_ms"), milliseconds(flight, "mean_look_up_ms"),
                         milliseconds(flight, "mean_draw_ms"), f"{100 * flight['wrong_share']:.4f} %",
                         f"{100 * flight['black_share']:.2f} %" if "black_share" in flight else "", str(flight["frames"])]
                        for flight in report["flights"]))


def processor():
    names = [line.split(":", 1)[1].strip() for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines()
             if line.startswith("model name")]
    return f"{names[0] if names else 'processor of unknown name'}, {os.cpu_count()} cores"


def main(viewer, dem, frames="1000", at_most="", size="1024x768"):
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        resized = str(folder / "small.tif")
        subprocess.run(["gdal_translate", "-q", "-outsize", SMALL, SMALL, "-r", "average", dem, resized], check=True)
        small = fly(viewer, resized, frames, at_most, size, str(folder / "small.json"))
        large = fly(viewer, dem, frames, at_most, size, str(folder / "large.json"))
    print(f"{large['renderer']}, OpenGL {large['opengl']}; {processor()}; {size} pixels, flights of {frames} frames"
          + (f", at most {at_most} s each" if at_most else "") + f", light {large['altitude_deg']:g} degrees high\n")
    print("\n\n".join([paper_table(small, 2), paper_table(large, 3), all_table(small), all_table(large)]))


if __name__ == "__main__":
    if not 3 <= len(sys.argv) <= 6:
        sys.exit(__doc__.strip())
    main(*sys.argv[1:])
