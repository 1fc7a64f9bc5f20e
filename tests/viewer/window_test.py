#!/usr/bin/env python3
"""Opens duskline-viewer in a window of a virtual display and uses it as hands would: drags the sun, raises the ground and lets it
move, changes the technique, shows things, takes screenshots, leaves. Skipped (77) where there is no Xvfb or xdotool.

usage: window_test.py VIEWER
"""

import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "window"))
from virtual_display import PATIENCE_S, Display, expect_refusal, skip_without_display  # noqa: E402


def write_hill(path):
    rows = [" ".join(f"{200 * math.exp(-((x - 30) ** 2 + (y - 30) ** 2) / 60):.2f}" for x in range(60)) for y in range(60)]
    path.write_text("ncols 60\nnrows 60\nxllcorner 0\nyllcorner 0\ncellsize 20\n" + "\n".join(rows) + "\n")


def use(display, viewer, folder):
    def saved_state():
        return json.loads(display.new_file("F2", folder, "duskline-state-*.json", "a saved state").read_text())

    def screenshot():
        return display.new_file("F12", folder, "duskline-0*.png", "a screenshot").read_bytes()

    def press(key):
        display.do("keydown", key)
        time.sleep(1.0)
        display.do("keyup", key)
        time.sleep(0.3)

    display.focus_window(500, 300)
    first = saved_state()
    assert first["technique"] == "exact", first

    # Shift and drag: the sun moves clockwise and up.
    display.drag(8, -5, 10, "shift")
    dragged = saved_state()
    assert dragged["light"]["altitude_deg"] > first["light"]["altitude_deg"] + 1, (first, dragged)
    assert dragged["light"]["azimuth_deg"] != first["light"]["azimuth_deg"]
    assert dragged["camera"] == first["camera"], (first, dragged)

    # Drag: the camera turns around the hill, the sun stays.
    display.drag(10, 0, 5)
    turned = saved_state()
    assert turned["camera"]["heading_deg"] != dragged["camera"]["heading_deg"]
    assert turned["light"] == dragged["light"]

    # Ctrl and drag: the ground rises under the pointer, and nothing else moves.
    level = screenshot()
    assert len(level) > 5000, f"{len(level)} bytes are an empty picture"
    assert screenshot() == level
    display.do("keydown", "ctrl", "mousedown", 1)
    time.sleep(2.0)
    display.do("mouseup", 1, "keyup", "ctrl")
    time.sleep(0.5)
    assert saved_state() == turned
    assert screenshot() != level

    # Tab: every technique in turn, and the first again.
    techniques = ["exact"]
    while techniques[-1] != "exact" or len(techniques) == 1:
        press("Tab")
        techniques.append(saved_state()["technique"])
        assert len(techniques) < 30, techniques
    assert len(set(techniques)) == len(techniques) - 1, techniques
    assert {"none", "sweep", "full-scan", "smap-quad"} < set(techniques), techniques

    # O: things appear. M: the ground moves, time passes, the picture with it.
    bare = screenshot()
    press("o")
    assert saved_state()["objects"]
    assert screenshot() != bare
    press("m")
    moving = saved_state()
    assert moving["animation"] == "crater", moving
    time.sleep(1.0)
    assert saved_state()["animation_s"] > moving["animation_s"]
    assert len(screenshot()) > 5000

    display.do("keydown", "Escape")
    code = viewer.wait(PATIENCE_S)
    assert code == 0, f"left with {code}"


def look(program, display, folder):
    viewer = subprocess.Popen([program, "hill.asc", "--size", "640x480"], cwd=folder, env=display.environment)
    try:
        use(display, viewer, folder)
    finally:
        viewer.kill()
        viewer.wait()


def main(program):
    skip_without_display()
    with tempfile.TemporaryDirectory() as name, Display() as display:
        folder = pathlib.Path(name)
        write_hill(folder / "hill.asc")
        look(program, display, folder)
        expect_refusal(program, ["hill.asc"], display, folder,
                       "duskline-viewer: no window with OpenGL 4.3 can be opened")
    print("the sun was dragged, the ground raised and set in motion, techniques changed, things shown, pictures taken")


if __name__ == "__main__":
    main(os.path.abspath(sys.argv[1]))
