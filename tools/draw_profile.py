#!/usr/bin/env python3
"""Draws a section through terrain along its light: the ground, and the shadow over it.

usage: tools/draw_profile.py GROUND SHADOW ALTITUDE OUT.svg
  GROUND, SHADOW  heights and shadow heights as gdal_translate -of XYZ writes them; the first row is drawn, whose
                  light comes from its beginning
  ALTITUDE        of the light, degrees
"""

import math
import sys

WIDTH, HEIGHT, MARGIN = 900, 260, 12
RISE = 5  # heights are drawn that many times too high


def read(path):
    points = [[float(word) for word in line.split()] for line in open(path)]
    row = [point for point in points if point[1] == points[0][1]][::2]
    return [point[0] for point in row], [point[2] for point in row]


def path_of(points):
    return " ".join(f"{x:.1f},{y:.1f}" for x, y in points)


def section(xs, ground, shadow, altitude):
    scale = (WIDTH - 2 * MARGIN) / (xs[-1] - xs[0])
    base = HEIGHT - 34

    def at(x, height):
        return MARGIN + (x - xs[0]) * scale, base - height * RISE * scale

    left, right = at(xs[0], 0), at(xs[-1], 0)
    roof = [at(x, max(g, s)) for x, g, s in zip(xs, ground, shadow)]
    soil = [at(x, g) for x, g in zip(xs, ground)]
    peak = max(range(len(xs)), key=lambda i: ground[i])
    px, py = at(xs[peak], ground[peak])
    slope = math.tan(math.radians(altitude)) * RISE
    yield f'<polygon class="shade" points="{path_of(roof + soil[::-1])}"/>'
    yield f'<polygon class="soil" points="{path_of([left] + soil + [right])}"/>'
    for lift in (0, 14, 28):
        back = min(px - MARGIN, (py - lift - 6) / slope)
        yield f'<line class="light" x1="{px - back:.1f}" y1="{py - lift - back * slope:.1f}" x2="{px:.1f}" y2="{py - lift:.1f}"/>'
    yield f'<polyline class="roof" points="{path_of(roof)}"/>'
    ten = 10000 * scale
    yield f'<line class="scale" x1="{MARGIN}" y1="{base + 18}" x2="{MARGIN + ten:.1f}" y2="{base + 18}"/>'
    yield f'<text x="{MARGIN + ten + 8:.1f}" y="{base + 22}">10 km, heights {RISE} times</text>'


STYLE = """.soil{fill:#8d8070}.shade{fill:#5b7390}.roof{fill:none;stroke:#1f3a5a;stroke-width:1.5}
.light{stroke:#d9962b;stroke-width:1.5}.scale{stroke:#555;stroke-width:2}
text{font:12px sans-serif;fill:#555}"""


def main(ground_path, shadow_path, altitude, out):
    xs, ground = read(ground_path)
    _, shadow = read(shadow_path)
    with open(out, "w") as svg:
        svg.write(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}">\n<style>{STYLE}</style>\n')
        svg.write(f'<rect width="{WIDTH}" height="{HEIGHT}" fill="#fbf9f5"/>\n')
        svg.write("\n".join(section(xs, ground, shadow, float(altitude))))
        svg.write("\n</svg>\n")


if __name__ == "__main__":
    if len(sys.argv) != 5:
        sys.exit(__doc__)
    main(*sys.argv[1:])
