#!/usr/bin/env python3
"""Prints the tables of docs/performance.md and docs/accuracy.md: what `duskline bench` says of several elevation
models under several suns.

usage: tools/bench_table.py DEM... [--table speed|accuracy|casters] [--light AZIMUTH,ALTITUDE]... [--casters A,B]
                            [--runs N] [-j N] [--pictures FOLDER] [--duskline PATH] [-- OPTIONS]

  --table speed             how long every caster takes, beside its error; else
  --table accuracy          where the answers differ, without times
  --table casters           one row for each terrain and sun: the share of cells in which each caster differs
  --light AZIMUTH,ALTITUDE  degrees; else 203 and 100.3, 20 and 5 degrees high, and 90.5, 20
  --casters A,B             which to measure; else as `duskline bench` chooses
  --runs N, -j N            as `duskline bench` takes them
  --pictures FOLDER         also draw there what every caster that is not exact gets wrong, as
                            TERRAIN_AZIMUTH_ALTITUDE_CASTER.png: red where it lights shadow, blue where it darkens
                            light (see compare_masks.py, which needs gdal-bin)
  --duskline PATH           the command; else that of build/release, or the one on the PATH
  OPTIONS                   more for `duskline bench`, such as --flat
"""

import argparse
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile

import compare_masks

BUILT = pathlib.Path(__file__).parents[1] / "build" / "release" / "apps" / "duskline" / "duskline"
LIGHTS = ["203,20", "203,5", "100.3,20", "100.3,5", "90.5,20"]


def digits(number):
    """Three digits, and all before the point."""
    return f"{number:.{2 if number < 9.995 else 1 if number < 99.95 else 0}f}"


def or_dash(number, text=str):
    return "-" if number is None else text(number)


def share(part, whole):
    return f"{100 * part / max(whole, 1):.4f} %"


# Heading of a column, and what a caster's row says there, from the whole bench and the caster's part of it.
SCENE = {
    "terrain": lambda bench, caster: pathlib.Path(bench["input"]).stem,
    "cells": lambda bench, caster: f"{bench['columns']} x {bench['rows']}",
    "azimuth": lambda bench, caster: f"{bench['azimuth_deg']:g}",
    "altitude": lambda bench, caster: f"{bench['altitude_deg']:g}",
}
TABLES = {
    "speed": SCENE
    | {
        "caster": lambda bench, caster: f"`{caster['name']}`",
        "ms": lambda bench, caster: digits(caster["median_ms"]),
        "x memcpy": lambda bench, caster: digits(caster["times_memcpy"]),
        "Mcells/s": lambda bench, caster: digits(caster["cells_per_s"] / 1e6),
        "cells that differ": lambda bench, caster: share(caster["differing"], bench["cells"]),
        "farthest": lambda bench, caster: or_dash(caster["farthest_from_edge_cells"]),
        "peak, MiB": lambda bench, caster: or_dash(caster["peak_bytes"], lambda b: digits(b / 2**20)),
    },
    "accuracy": SCENE
    | {
        "in shadow": lambda bench, caster: f"{100 * bench['shadow'] / max(bench['cells'], 1):.2f} %",
        "caster": lambda bench, caster: f"`{caster['name']}`",
        "cells that differ": lambda bench, caster: f"{caster['differing']} ({share(caster['differing'], bench['cells'])})",
        "beside an edge": lambda bench, caster: str(caster["beside_edge"]),
        "farther away": lambda bench, caster: str(caster["differing"] - caster["beside_edge"]),
        "farthest": lambda bench, caster: or_dash(caster["farthest_from_edge_cells"]),
    },
}


def row(columns):
    return "| " + " | ".join(columns) + " |"


def shares_by_caster(bench):
    """The columns of the table that has a column for each caster, for one terrain and sun."""
    scene = ("terrain", "azimuth", "altitude", "in shadow")
    columns = {name: TABLES["accuracy"][name](bench, None) for name in scene}
    return columns | {f"`{each['name']}`": share(each["differing"], bench["cells"]) for each in bench["casters"]}


def heading(table, bench):
    columns = shares_by_caster(bench) if table == "casters" else TABLES[table]
    return [row(columns), "|" + "---|" * len(columns)]


def rows(table, bench):
    """What `duskline bench --json` printed, one row for each caster or one for all."""
    if table == "casters":
        return [row(shares_by_caster(bench).values())]
    return [row(column(bench, caster) for column in TABLES[table].values()) for caster in bench["casters"]]


def machine(bench):
    """What the times depend on besides terrain and light."""
    return f"{bench['threads']} thread{'s' if bench['threads'] > 1 else ''}, kernels `{bench['kernel']}`"


def run_bench(options, dem, light):
    azimuth, altitude = light.split(",")
    command = [options.duskline, "bench", dem, "--azimuth", azimuth, "--altitude", altitude, "--json"]
    for option in ("casters", "runs", "threads"):
        if value := getattr(options, option):
            command += [f"--{option}", value]
    finished = subprocess.run([*command, *options.more], stdout=subprocess.PIPE, text=True)
    if finished.returncode != 0:
        sys.exit(finished.returncode)
    return json.loads(finished.stdout)


def cast(options, bench, caster, path):
    light = ["--azimuth", str(bench["azimuth_deg"]), "--altitude", str(bench["altitude_deg"])]
    command = [options.duskline, "shadow", bench["input"], path, "--caster", caster, *light, "--quiet", *options.more]
    subprocess.run(command, check=True)
    return compare_masks.read_mask(path)


def draw_mistakes(options, bench):
    """A picture of the wrong cells of every caster that has some."""
    folder = pathlib.Path(options.pictures)
    folder.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as scratch:
        truth = cast(options, bench, bench["truth"], f"{scratch}/truth.tif")
        for name in (each["name"] for each in bench["casters"] if each["differing"]):
            other = cast(options, bench, name, f"{scratch}/{name}.tif")
            light = f"{bench['azimuth_deg']:g}_{bench['altitude_deg']:g}"
            picture = folder / f"{pathlib.Path(bench['input']).stem}_{light}_{name}.png"
            compare_masks.draw(truth, other, str(picture), 1)


def parsed(words):
    more = []
    if "--" in words:
        words, more = words[: words.index("--")], words[words.index("--") + 1 :]
    parser = argparse.ArgumentParser(usage=__doc__.split("usage: ")[1].split("\n\n")[0], add_help=False)
    parser.add_argument("-h", "--help", action="store_true")
    parser.add_argument("dems", nargs="*")
    parser.add_argument("--table", choices=[*TABLES, "casters"], default="speed")
    parser.add_argument("--light", action="append", default=[])
    parser.add_argument("--casters")
    parser.add_argument("--runs")
    parser.add_argument("-j", "--threads")
    parser.add_argument("--pictures")
    parser.add_argument("--duskline", default=BUILT if BUILT.exists() else shutil.which("duskline"))
    options = parser.parse_args(words)
    options.more = more
    if options.help:
        print(__doc__.strip())
        sys.exit(0)
    if not options.dems:
        parser.error("an elevation model is needed")
    if wrong := [light for light in options.light if light.count(",") != 1]:
        parser.error(f"--light takes AZIMUTH,ALTITUDE, got '{wrong[0]}'")
    if not options.duskline:
        parser.error("no duskline in build/release or on the PATH; say where it is with --duskline")
    return options


def main():
    options = parsed(sys.argv[1:])
    bench = None
    for dem in options.dems:
        for light in options.light or LIGHTS:
            is_first = bench is None
            bench = run_bench(options, dem, light)
            print("\n".join([*(heading(options.table, bench) if is_first else []), *rows(options.table, bench)]), flush=True)
            if options.pictures:
                draw_mistakes(options, bench)
    if options.table == "speed":
        print(f"\n{machine(bench)}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
