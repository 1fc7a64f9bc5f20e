#!/usr/bin/env python3
"""Prints the tables of docs/planet.md from reports of `duskline-planet --flydown`: what every technique costs on the way down and
gets wrong, in all and by height over the ground.

usage: tools/descent_table.py REPORT.json...

    REPORT.json   written by --report; of several the flights are put together, and must be of the same size, frames and way
"""

import json
import pathlib
import sys

WAY = ("width", "height", "frames", "from_km", "to_m", "renderer")


def row(cells):
    return "| " + " | ".join(cells) + " |"


def table(head, rows):
    return "\n".join([row(head), "|" + "---|" * len(head), *map(row, rows)])


def milliseconds(figures, key):
    return f"{figures[key]:.1f}" if key in figures else ""


def share(figures, key):
    return f"{100 * figures['errors'][key]:.2f} %" if "errors" in figures else ""


def costs(figures):
    return [milliseconds(figures, key) for key in ("mean_frame_ms", "mean_load_ms", "mean_cast_ms", "mean_draw_ms", "shadow_ms")]


def all_table(flights):
    head = ["technique", "frame, ms", "load", "cast", "draw", "more than `none`", "pixels wrong", "apart from edges"]
    return table(head, ([f"`{flight['technique']}`", *costs(flight), share(flight, "wrong_share"),
                         share(flight, "wrong_apart_share")] for flight in flights))


def band_names(flights):
    return [band["band"] for band in flights[0]["bands"]]


def band_table(flights, cell):
    names = band_names(flights)
    cells = [{band["band"]: cell(band) for band in flight["bands"]} for flight in flights]
    return table(["technique", *names], ([f"`{flight['technique']}`", *(found.get(name, "") for name in names)]
                                         for flight, found in zip(flights, cells)))


def wrong(band):
    return f"{share(band, 'wrong_share')} ({share(band, 'wrong_apart_share')})" if "errors" in band else ""


def cost(band):
    return "{} + {}".format(milliseconds(band, "mean_cast_ms"), milliseconds(band, "mean_draw_ms"))


def main(names):
    reports = [json.loads(pathlib.Path(name).read_text()) for name in names]
    first = reports[0]
    for name, report in zip(names, reports):
        if any(report[key] != first[key] for key in WAY):
            sys.exit(f"descent_table: {name} is of another way or size than {names[0]}")
    flights = [flight for report in reports for flight in report["descents"]]
    print(f"{first['renderer']}; {first['width']} x {first['height']} pixels, {first['frames']} frames from {first['from_km']:g} km to "
          f"{first['to_m']:g} m; shadows of {first['error_frames']} frames compared\n")
    print(all_table(flights))
    print("\nPixels wrong (of all, those apart from edges):\n")
    print(band_table(flights, wrong))
    print("\nMilliseconds to find shadows + to draw:\n")
    print(band_table(flights, cost))


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__.strip())
    main(sys.argv[1:])
