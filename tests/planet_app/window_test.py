#!/usr/bin/env python3
"""Opens duskline-planet in a window of a virtual display and uses it as hands would: every technique, made-up ground marked, a clock
that runs, a flight, a dragged sun, screenshots; says how much memory that took, and leaves. Mesa's complaints about wrong
calls of OpenGL count as failures. Skipped (77) where there is no Xvfb or xdotool.

usage: window_test.py PLANET
"""

import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "window"))
from virtual_display import PATIENCE_S, Display, expect_refusal, skip_without_display, wait_until  # noqa: E402

# A small planet, small shadow maps and coarse meshes, so that frames are quick in software; the sun stands in the evening.
PLANET = ["hills.asc", "--radius", "60"]
LOOK = ["--at", "10,20,15000", "--heading", "30", "--pitch", "-60", "--time", "2026-06-21T16:20Z", "--square", "30",
        "--size", "240x180", "--shadow-map", "size=512", "--technique", "none"]
MOST_MEGABYTES = 1000


def write_hills(folder):
    """Cones of 2.5 km, 20 degrees apart."""
    def height(x, y):
        return 2500 * max(0, 1 - math.hypot((x + 5) % 10 - 5, (y + 5) % 10 - 5) / 2.5)
    rows = [" ".join(f"{height(x, y):.1f}" for x in range(180)) for y in range(90)]
    head = "ncols 180\nnrows 90\nxllcorner -180\nyllcorner -90\ncellsize 2\n"
    (folder / "hills.asc").write_text(head + "\n".join(rows) + "\n")
    (folder / "hills.prj").write_text('GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563]],'
                                      'PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433]]\n')


def use(display, planet, folder):
    def screenshot():
        return display.new_file("F12", folder, "duskline-planet-*.png", "a screenshot").read_bytes()

    def still():
        """The picture when all tiles and shadows have come."""
        pictures = [screenshot()]

        def stands():
            pictures.append(screenshot())
            return pictures[-1] == pictures[-2]
        wait_until(stands, "a picture that stands still")
        assert len(pictures[-1]) > 3000, f"{len(pictures[-1])} bytes are an empty picture"
        return pictures[-1]

    def press(key):
        """The frame that sees F12 pressed has seen what was pressed before."""
        display.do("keydown", key)
        try:
            return screenshot()
        finally:
            display.do("keyup", key)
            time.sleep(0.5)

    display.focus_window(120, 90)
    press("F10")  # the panel, which would take the mouse
    by_technique = {"none": still()}
    for technique in ("shadow-map", "fronts"):
        press("Tab")
        by_technique[technique] = still()
    assert len(set(by_technique.values())) == 3, [len(picture) for picture in by_technique.values()]
    press("Tab")
    assert still() == by_technique["none"]

    press("m")
    assert still() != by_technique["none"], "made-up ground is not marked"
    press("m")
    assert still() == by_technique["none"]

    press("space")
    running = screenshot()
    assert screenshot() != running, "the clock does not run"
    press("space")
    evening = still()
    assert evening != by_technique["none"]

    display.drag(0, -8, 6, "shift")
    dragged = still()
    assert dragged != evening, "the sun was not dragged"
    press("w")
    assert still() != dragged, "the camera does not fly"

    megabytes = int(re.search(r"VmHWM:\s*(\d+) kB", pathlib.Path(f"/proc/{planet.pid}/status").read_text())[1]) / 1000
    assert megabytes < MOST_MEGABYTES, f"{megabytes:.0f} MB"

    display.do("keydown", "Escape")
    code = planet.wait(PATIENCE_S)
    display.do("keyup", "Escape")
    assert code == 0, f"left with {code}"
    return megabytes


def look(program, display, folder):
    complaints = folder / "complaints.txt"
    with complaints.open("w") as errors:
        planet = subprocess.Popen([program, *PLANET, *LOOK], cwd=folder, stderr=errors,
                                  env={**display.environment, "MESA_DEBUG": "1"})
        try:
            megabytes = use(display, planet, folder)
        finally:
            planet.kill()
            planet.wait()
    assert "error" not in complaints.read_text().lower(), complaints.read_text()
    return megabytes


def main(program):
    skip_without_display()
    with tempfile.TemporaryDirectory() as name, Display() as display:
        folder = pathlib.Path(name)
        write_hills(folder)
        megabytes = look(program, display, folder)
        expect_refusal(program, PLANET, display, folder, "duskline-planet: no window with OpenGL 4.3 can be opened")
    print(f"every technique, made-up ground, a clock, a flight and a dragged sun, in at most {megabytes:.0f} MB")


if __name__ == "__main__":
    main(os.path.abspath(sys.argv[1]))
