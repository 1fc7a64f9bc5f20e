#!/usr/bin/env python3
"""Times whole `duskline shadow` processes beside `gdaldem hillshade` on the same file, with the same output options.

usage: tools/bench_process.py DEM... [--rounds N] [--duskline PATH] [-- OPTIONS]

  --rounds N       how often each command runs, after one round that is not counted; else 7
  --duskline PATH  the command; else that of build/release, or the one on the PATH
  OPTIONS          for `duskline shadow`; else --azimuth 315 --altitude 20

All commands run in turn, round after round, so that a machine that slows down slows all of them. Prints medians of
the wall time, of the CPU time (user and system) and of the peak memory, as a table. Needs GDAL's command line
(gdal-bin).
"""

import os
import pathlib
import shutil
import statistics
import subprocess
import sys
import tempfile
import time

BUILT = pathlib.Path(__file__).parents[1] / "build" / "release" / "apps" / "duskline" / "duskline"
OUTPUT_OPTIONS = ["TILED=YES", "COMPRESS=DEFLATE", "NUM_THREADS=ALL_CPUS"]
LIGHT = ["--azimuth", "315", "--altitude", "20"]
COUNTED_ROUNDS = 7


def commands(duskline, dem, output, options):
    """Name and command of each contestant."""

    def creation(flag):
        return [word for option in OUTPUT_OPTIONS for word in (flag, option)]

    def shadow(*more):
        return [duskline, "shadow", dem, output, "--quiet", *options, *creation("--co"), *more]

    hillshade = ["gdaldem", "hillshade", "-q", dem, output, "-az", "315", "-alt", "20", *creation("-co")]
    return {
        "gdaldem hillshade": hillshade,
        "duskline shadow --caster sweep": shadow("--caster", "sweep"),
        "duskline shadow --caster sweep -j 1": shadow("--caster", "sweep", "--threads", "1"),
        "duskline shadow --caster exact": shadow("--caster", "exact"),
        "duskline shadow --caster exact -j 1": shadow("--caster", "exact", "--threads", "1"),
    }


def run(command):
    """Wall seconds, CPU seconds and peak MiB of one process."""
    start = time.perf_counter()
    process = subprocess.Popen(command)
    _, status, usage = os.wait4(process.pid, 0)
    wall_s = time.perf_counter() - start
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        sys.exit(f"bench_process: {' '.join(command)} ended with {process.returncode}")
    return wall_s, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def measure(duskline, dem, rounds, options):
    """The medians of each command's runs."""
    runs = {}
    with tempfile.TemporaryDirectory() as folder:
        output = str(pathlib.Path(folder) / "output.tif")
        for round_ in range(rounds + 1):
            for name, command in commands(duskline, dem, output, options).items():
                measured = run(command)
                os.remove(output)
                if round_ > 0:
                    runs.setdefault(name, []).append(measured)
    return {name: [statistics.median(column) for column in zip(*rows)] for name, rows in runs.items()}


def print_table(dem, medians):
    wall_of_gdaldem_s = next(iter(medians.values()))[0]
    print(f"\n| {pathlib.Path(dem).name} | wall, s | x gdaldem | CPU, s | peak, MiB |")
    print("|---|---|---|---|---|")
    for name, (wall_s, cpu_s, peak_mib) in medians.items():
        print(f"| `{name}` | {wall_s:.3f} | {wall_s / wall_of_gdaldem_s:.2f} | {cpu_s:.3f} | {peak_mib:.0f} |")


def main():
    words = sys.argv[1:]
    if "-h" in words or "--help" in words:
        print(__doc__.strip())
        return 0
    options = LIGHT
    if "--" in words:
        options = words[words.index("--") + 1 :]
        words = words[: words.index("--")]
    rounds, duskline, dems = COUNTED_ROUNDS, BUILT if BUILT.exists() else shutil.which("duskline"), []
    while words:
        word = words.pop(0)
        if word == "--rounds" and words:
            rounds = int(words.pop(0))
        elif word == "--duskline" and words:
            duskline = words.pop(0)
        else:
            dems.append(word)
    if not dems or not duskline:
        print(__doc__.split("\n\n")[1], file=sys.stderr)
        return 2
    for dem in dems:
        print_table(dem, measure(str(duskline), dem, rounds, options))
    return 0


if __name__ == "__main__":
    sys.exit(main())
