"""Looks at the picture of examples/shadow_in_a_renderer: towers are reddish, lit and in the shadow, and so is the ground.

usage: check_towers.py PICTURE.ppm      exits with 77 when there is no picture (no device for OpenGL)
"""

import pathlib
import sys

file = pathlib.Path(sys.argv[1])
if not file.exists():
    sys.exit(77)
header, size, most, pixels = file.read_bytes().split(b"\n", 3)
width, height = map(int, size.split())
assert (header, most, len(pixels)) == (b"P6", b"255", 3 * width * height), "no picture of that size"

counts = {"lit tower": 0, "dark tower": 0, "lit ground": 0, "dark ground": 0}
for i in range(0, len(pixels), 3):
    red, green, blue = pixels[i : i + 3]
    if red > 1.15 * green:
        counts["lit tower" if red > 130 else "dark tower"] += 1
    elif green > blue:
        counts["lit ground" if green > 150 else "dark ground"] += 1
print(counts)
sys.exit(0 if all(count > 100 for count in counts.values()) else "something is missing in the picture")
