"""A virtual display of its own and hands on it, for tests that open windows. Xvfb is the display, xdotool the hands."""

import itertools
import os
import shutil
import subprocess
import sys
import time

PATIENCE_S = 60


def wait_until(condition, what):
    end = time.monotonic() + PATIENCE_S
    while time.monotonic() < end:
        found = condition()
        if found:
            return found
        time.sleep(0.1)
    sys.exit(f"{sys.argv[0]}: waited in vain for {what}")


def skip_without_display():
    """Ends with 77, which tests count as skipped."""
    for needed in ("Xvfb", "xdotool"):
        if not shutil.which(needed):
            print(f"skipped: no {needed} here")
            sys.exit(77)


class Display:
    def __init__(self):
        read_end, write_end = os.pipe()
        self.server = subprocess.Popen(
            ["Xvfb", "-displayfd", str(write_end), "-screen", "0", "800x600x24", "-nolisten", "tcp"],
            pass_fds=[write_end], stderr=subprocess.DEVNULL)
        os.close(write_end)
        self.name = ":" + os.fdopen(read_end).readline().strip()
        self.environment = {**os.environ, "DISPLAY": self.name}
        self.environment.pop("WAYLAND_DISPLAY", None)

    def __enter__(self):
        return self

    def __exit__(self, *error):
        self.server.terminate()
        self.server.wait()

    def do(self, *words):
        return subprocess.run(["xdotool", *map(str, words)], env=self.environment, capture_output=True, text=True).stdout

    def new_file(self, key, folder, pattern, what):
        """What appears in a folder when a key is pressed: again and again, as a frame may take long, and a key that is down or up
        for less than one was never pressed."""
        before = set(folder.glob(pattern))
        presses = itertools.count(1)

        def appears():
            self.do("keydown", key)
            time.sleep(0.5 * next(presses))
            self.do("keyup", key)
            time.sleep(0.5)
            return set(folder.glob(pattern)) - before
        return max(wait_until(appears, what))

    def drag(self, right, down, moves, *keys):
        """With the left button, and keys held down."""
        for key in keys:
            self.do("keydown", key)
        self.do("mousedown", 1)
        time.sleep(1.0)
        for _ in range(moves):
            self.do("mousemove_relative", "--", right, down)
            time.sleep(0.2)
        self.do("mouseup", 1)
        for key in keys:
            self.do("keyup", key)
        time.sleep(0.5)

    def focus_window(self, column, row):
        """Gives the window of Duskline the keys, and moves the pointer there."""
        window = wait_until(lambda: self.do("search", "--name", "Duskline: ").split(), "the window")[0]

        def has_focus():
            self.do("windowfocus", window)
            return self.do("getwindowfocus").strip() == window
        wait_until(has_focus, "the window's focus")
        self.do("mousemove", column, row)


def expect_refusal(program, arguments, display, folder, message):
    """An OpenGL that is too old is one line and exit code 5; drivers other than Mesa's do not take the order."""
    environment = {**display.environment, "MESA_GL_VERSION_OVERRIDE": "4.2"}
    refused = subprocess.run([program, *arguments], cwd=folder, env=environment, capture_output=True, text=True,
                             timeout=PATIENCE_S)
    assert refused.returncode == 5, refused
    assert refused.stderr.startswith(message), refused.stderr
    assert refused.stderr.count("\n") == 1, refused.stderr
