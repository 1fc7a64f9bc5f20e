#!/usr/bin/env python3
"""Says how far casters are from the truth on elevation models, as the table of docs/accuracy.md.

usage: tools/measure_accuracy.py DEM... [--caster NAME]... [--light AZIMUTH,ALTITUDE]... [--duskline PATH]

  --caster NAME             which to measure; else sweep
  --light AZIMUTH,ALTITUDE  degrees; else 203 and 100.3, 20 and 5 degrees high, and 90.5, 20
  --duskline PATH           the command; else that of build/release, or the one on the PATH

The truth is `fast-ray`. The ground is taken as flat. Needs GDAL's command line (gdal-bin).
"""

import argparse
import pathlib
import shutil
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).parent))
sys.dont_write_bytecode = True
from compare_masks import compare, read_mask  # noqa: E402

BUILT = pathlib.Path(__file__).parents[1] / "build" / "release" / "apps" / "duskline" / "duskline"
LIGHTS = ["203,20", "203,5", "100.3,20", "100.3,5", "90.5,20"]
HEADER = """\
| terrain | azimuth | altitude | in shadow | caster | cells that differ | beside an edge | farther away | farthest |
|---|---|---|---|---|---|---|---|---|"""


def cast(duskline, dem, light, caster, folder):
    azimuth, altitude = light.split(",")
    output = str(pathlib.Path(folder) / f"{caster}.tif")
    command = [duskline, "shadow", dem, output, "--azimuth", azimuth, "--altitude", altitude]
    command += ["--flat", "--caster", caster, "--overwrite", "--quiet"]
    if subprocess.run(command).returncode != 0:
        sys.exit(2)
    return read_mask(output)


def table_row(dem, light, caster, result):
    cells = result["cells"]
    distances = result["distances"]
    beside = distances.get(1, 0)
    azimuth, altitude = light.split(",")
    columns = [
        pathlib.Path(dem).stem,
        azimuth,
        altitude,
        f"{100 * result['shadow'] / cells:.2f} %",
        caster,
        f"{result['differ']} ({100 * result['differ'] / cells:.4f} %)",
        beside,
        result["differ"] - beside,
        max(distances, default=0),
    ]
    return "| " + " | ".join(map(str, columns)) + " |"


def main():
    parser = argparse.ArgumentParser(usage=__doc__.split("usage: ")[1].split("\n")[0], add_help=False)
    parser.add_argument("-h", "--help", action="store_true")
    parser.add_argument("dems", nargs="*")
    parser.add_argument("--caster", action="append", default=[])
    parser.add_argument("--light", action="append", default=[])
    parser.add_argument("--duskline", default=BUILT if BUILT.exists() else shutil.which("duskline"))
    options = parser.parse_args()
    if options.help:
        print(__doc__.strip())
        return 0
    if not options.dems:
        parser.error("an elevation model is needed")
    if not options.duskline:
        parser.error("no duskline in build/release or on the PATH; say where it is with --duskline")

    print(HEADER, flush=True)
    for dem in options.dems:
        for light in options.light or LIGHTS:
            with tempfile.TemporaryDirectory() as folder:
                truth = cast(options.duskline, dem, light, "fast-ray", folder)
                for caster in options.caster or ["sweep"]:
                    mask = cast(options.duskline, dem, light, caster, folder)
                    print(table_row(dem, light, caster, compare(truth, mask)), flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
