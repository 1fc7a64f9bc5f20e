#!/usr/bin/env python3
"""Prints the tables of docs/planet.md from reports of `duskline-planet --flydown`: what every technique costs on the way down and
gets wrong, in all and by height over the ground.

usage: tools/descent_table.py REPORT.json...

    REPORT.json   written by --report; of several the flights are put together, and must be of the same size, frames and way;
                  times of loading are those of the first
"""

import json
import pathlib
import sys

WAY = ("width", "height", "frames", "from_km", "to_m", "renderer")


def row(cells):
    return "| " + " | ".join(cells) + " |"


def table(head, rows):
    return "\n".join([row(head), "|" + "---|" * len(head), *map(row, rows)])


def milliseconds(figures, times, which):
    return f"{figures[times][which]:.1f}" if times in figures else ""


def share(figures, key):
    return f"{100 * figures['errors'][key]:.2f} %" if "errors" in figures else ""


TIMES = [("frame_ms", "median"), ("frame_ms", "p99"), ("cast_ms", "median"), ("cast_ms", "mean"), ("cast_ms", "p99"),
         ("draw_ms", "median"), ("draw_ms", "p99"), ("shadow_ms", "median"), ("shadow_ms", "p99")]


def all_table(flights):
    head = ["technique", "frame, ms", "99 %", "cast", "mean", "99 %", "draw", "99 %", "more than `none`", "99 %"]
    return table(head, ([f"`{flight['technique']}`", *(milliseconds(flight, *key) for key in TIMES)] for flight in flights))


def band_names(flights):
    return [band["band"] for band in flights[0]["bands"]]


def band_table(flights, cell):
    names = band_names(flights)
    cells = [{band["band"]: cell(band) for band in flight["bands"]} for flight in flights]
    return table(["technique", *names], ([f"`{flight['technique']}`", *(found.get(name, "") for name in names)]
                                         for flight, found in zip(flights, cells)))


def wrong(band):
    return f"{share(band, 'wrong_share')} ({share(band, 'wrong_apart_share')})" if "errors" in band else ""


def more(band):
    return "{} ({})".format(milliseconds(band, "shadow_ms", "median"), milliseconds(band, "shadow_ms", "p99")) if "shadow_ms" in band else ""


def drawing(band):
    return "{} ({})".format(milliseconds(band, "draw_ms", "median"), milliseconds(band, "draw_ms", "p99"))


def loading_table(report):
    """How many frames there are, and what choosing and reading tiles took in them."""
    return table(["", *(band["band"] for band in report["bands"])],
                 [["frames", *(str(band["frames"]) for band in report["bands"])],
                  ["load, ms", *("{} ({})".format(milliseconds(band, "load_ms", "median"), milliseconds(band, "load_ms", "p99"))
                                 for band in report["bands"])]])


def error_table(flights):
    """By band, and in all."""
    rows = band_table(flights, wrong).splitlines()
    extra = ["in all", "---", *(wrong(flight) for flight in flights)]
    return "\n".join(line + (f"{cell}|" if cell == "---" else f" {cell} |") for line, cell in zip(rows, extra))


def main(names):
    reports = [json.loads(pathlib.Path(name).read_text()) for name in names]
    first = reports[0]
    for name, report in zip(names, reports):
        if any(report[key] != first[key] for key in WAY):
            sys.exit(f"descent_table: {name} is of another way or size than {names[0]}")
    flights = [flight for report in reports for flight in report["descents"]]
    print(f"{first['renderer']}; {first['width']} x {first['height']} pixels, {first['frames']} frames from {first['from_km']:g} km to "
          f"{first['to_m']:g} m; shadows of {first['error_frames']} frames compared\n")
    print("Times. Medians, and what 99 of 100 frames do not exceed; maps are not drawn in every frame, so the mean says what they take:\n")
    print(all_table(flights))
    print("\nTiles, chosen and read once a frame for all: median (99 %):\n")
    print(loading_table(first))
    print("\nMilliseconds more than `none` in the same frames, median (99 %):\n")
    print(band_table([flight for flight in flights if flight["technique"] != "none"], more))
    print("\nMilliseconds to draw, median (99 %):\n")
    print(band_table(flights, drawing))
    if any("errors" in flight for flight in flights):
        print("\nErrors. Pixels wrong (of all, those apart from edges):\n")
        print(error_table(flights))


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__.strip())
    main(sys.argv[1:])
