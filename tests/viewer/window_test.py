#!/usr/bin/env python3
"""Opens duskline-viewer in a window of a virtual display and uses it as hands would: drags the sun, raises the ground and lets it
move, changes the technique, shows things, takes screenshots, leaves. Skipped (77) where there is no Xvfb or xdotool.

usage: window_test.py VIEWER
"""

import json
import math
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time

PATIENCE_S = 60


def wait_until(condition, what):
    end = time.monotonic() + PATIENCE_S
    while time.monotonic() < end:
        found = condition()
        if found:
            return found
        time.sleep(0.1)
    sys.exit(f"window_test: waited in vain for {what}")


class Display:
    """A virtual display of its own, and hands on it."""

    def __init__(self):
        read_end, write_end = os.pipe()
        self.server = subprocess.Popen(
            ["Xvfb", "-displayfd", str(write_end), "-screen", "0", "800x600x24", "-nolisten", "tcp"],
            pass_fds=[write_end], stderr=subprocess.DEVNULL)
        os.close(write_end)
        self.name = ":" + os.fdopen(read_end).readline().strip()
        self.environment = {**os.environ, "DISPLAY": self.name}
        self.environment.pop("WAYLAND_DISPLAY", None)

    def do(self, *words):
        return subprocess.run(["xdotool", *map(str, words)], env=self.environment, capture_output=True, text=True).stdout

    def hold(self, key, condition, what):
        """A frame may take long; a key that is let go too early was never down."""
        self.do("keydown", key)
        try:
            return wait_until(condition, what)
        finally:
            self.do("keyup", key)
            time.sleep(0.5)

    def close(self):
        self.server.terminate()
        self.server.wait()


def write_hill(path):
    rows = [" ".join(f"{200 * math.exp(-((x - 30) ** 2 + (y - 30) ** 2) / 60):.2f}" for x in range(60)) for y in range(60)]
    path.write_text("ncols 60\nnrows 60\nxllcorner 0\nyllcorner 0\ncellsize 20\n" + "\n".join(rows) + "\n")


def use(display, viewer, folder):
    def saved_state():
        before = set(folder.glob("duskline-state-*.json"))
        new = display.hold("F2", lambda: set(folder.glob("duskline-state-*.json")) - before, "a saved state")
        return json.loads(new.pop().read_text())

    def screenshot():
        before = set(folder.glob("duskline-0*.png"))
        new = display.hold("F12", lambda: set(folder.glob("duskline-0*.png")) - before, "a screenshot")
        return new.pop().read_bytes()

    def press(key):
        display.do("keydown", key)
        time.sleep(1.0)
        display.do("keyup", key)
        time.sleep(0.3)

    window = wait_until(lambda: display.do("search", "--name", "Duskline: ").split(), "the window")[0]
    display.do("windowfocus", window)
    display.do("mousemove", 500, 300)
    first = saved_state()
    assert first["technique"] == "exact", first

    # Shift and drag: the sun moves clockwise and up.
    display.do("keydown", "shift", "mousedown", 1)
    time.sleep(1.0)
    for _ in range(10):
        display.do("mousemove_relative", "--", 8, -5)
        time.sleep(0.2)
    display.do("mouseup", 1, "keyup", "shift")
    time.sleep(0.5)
    dragged = saved_state()
    assert dragged["light"]["altitude_deg"] > first["light"]["altitude_deg"] + 1, (first, dragged)
    assert dragged["light"]["azimuth_deg"] != first["light"]["azimuth_deg"]
    assert dragged["camera"] == first["camera"], (first, dragged)

    # Drag: the camera turns around the hill, the sun stays.
    display.do("mousedown", 1)
    time.sleep(1.0)
    for _ in range(5):
        display.do("mousemove_relative", "--", 10, 0)
        time.sleep(0.2)
    display.do("mouseup", 1)
    time.sleep(0.5)
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


def expect_refusal(program, display, folder):
    """An OpenGL that is too old is one line and exit code 5; drivers other than Mesa's do not take the order."""
    environment = {**display.environment, "MESA_GL_VERSION_OVERRIDE": "4.2"}
    refused = subprocess.run([program, "hill.asc"], cwd=folder, env=environment, capture_output=True, text=True, timeout=PATIENCE_S)
    assert refused.returncode == 5, refused
    assert refused.stderr.startswith("duskline-viewer: no window with OpenGL 4.3 can be opened"), refused.stderr
    assert refused.stderr.count("\n") == 1, refused.stderr


def look(program, display, folder):
    viewer = subprocess.Popen([program, "hill.asc", "--size", "640x480"], cwd=folder, env=display.environment)
    try:
        use(display, viewer, folder)
    finally:
        viewer.kill()
        viewer.wait()


def main(program):
    for needed in ("Xvfb", "xdotool"):
        if not shutil.which(needed):
            print(f"skipped: no {needed} here")
            sys.exit(77)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        write_hill(folder / "hill.asc")
        display = Display()
        try:
            look(program, display, folder)
            expect_refusal(program, display, folder)
        finally:
            display.close()
    print("the sun was dragged, the ground raised and set in motion, techniques changed, things shown, pictures taken")


if __name__ == "__main__":
    main(os.path.abspath(sys.argv[1]))
