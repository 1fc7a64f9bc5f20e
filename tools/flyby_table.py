#!/usr/bin/env python3
"""Flies over a terrain with every technique of duskline-viewer, at its own size and made smaller to 512 cells a side, and
prints the table of docs/realtime.md. Needs gdal_translate, and neither window nor display.

usage: tools/flyby_table.py VIEWER DEM [FRAMES [WxH]]      FRAMES: of each flight, else 1000; WxH: else 1024x768
"""

import json
import pathlib
import subprocess
import sys
import tempfile

SMALL = "512"
ALTITUDE_DEG = "5"  # of the light: shadows that matter


def figures(viewer, dem, frames, size, report):
    subprocess.run([viewer, dem, "--flyby", frames, "--technique", "all", "--altitude", ALTITUDE_DEG, "--size", size,
                    "--report", report, "--quiet"], check=True)
    return json.loads(pathlib.Path(report).read_text())


def cells_of(report):
    return f"{report['columns']} x {report['rows']}"


def row(small, large):
    """One technique on both terrains."""
    name = small["technique"] + (", light at rest" if small["light_at_rest"] else "")
    parts = [f"| {name} "]
    for flight in (small, large):
        fps = flight["fps"]
        parts.append(f"| {fps['least']:.2f} | {fps['most']:.2f} | {fps['mean']:.2f} | {flight['mean_cast_ms']:.1f} "
                     f"| {flight['mean_draw_ms']:.1f} | {100 * flight['wrong_share']:.4f} % ")
    return "".join(parts) + "|"


def table(small, large):
    columns = " | least fps | most | mean | cast, ms | draw, ms | cells wrong" * 2
    return "\n".join([f"| {cells_of(small)}, then {cells_of(large)}{columns} |", "|---|" + "---|" * 12,
                      *map(row, small["flights"], large["flights"])])


def main(viewer, dem, frames="1000", size="1024x768"):
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        resized = str(folder / "small.tif")
        subprocess.run(["gdal_translate", "-q", "-outsize", SMALL, SMALL, "-r", "average", dem, resized], check=True)
        small = figures(viewer, resized, frames, size, str(folder / "small.json"))
        large = figures(viewer, dem, frames, size, str(folder / "large.json"))
    print(f"{large['renderer']}, OpenGL {large['opengl']}; {size} pixels, {frames} frames, light "
          f"{large['altitude_deg']:g} degrees high\n")
    print(table(small, large))


if __name__ == "__main__":
    if not 3 <= len(sys.argv) <= 5:
        sys.exit(__doc__.strip())
    main(*sys.argv[1:])
