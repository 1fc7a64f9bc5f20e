"""tools/bench_table.py makes rows of what `duskline bench --json` prints."""

import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "tools"))
from bench_table import digits, heading, machine, parsed, rows  # noqa: E402

EXACT = {
    "name": "exact",
    "median_ms": 9.996,
    "times_memcpy": 8.125,
    "cells_per_s": 25.2e6,
    "differing": 0,
    "beside_edge": 0,
    "farthest_from_edge_cells": 0,
    "peak_bytes": 3 * 2**19,
}
SWEEP = EXACT | {
    "name": "sweep",
    "median_ms": 0.104,
    "differing": 63,
    "beside_edge": 60,
    "farthest_from_edge_cells": None,
    "peak_bytes": None,
}
BENCH = {
    "input": "some/where/alps.tif",
    "rows": 420,
    "columns": 600,
    "cells": 252000,
    "azimuth_deg": 100.3,
    "altitude_deg": 5.0,
    "shadow": 63000,
    "threads": 2,
    "kernel": "avx2",
    "casters": [EXACT, SWEEP],
}


class BenchTable(unittest.TestCase):
    def test_speed_stands_beside_error(self):
        self.assertEqual(
            rows("speed", BENCH),
            [
                "| alps | 600 x 420 | 100.3 | 5 | `exact` | 10.0 | 8.12 | 25.2 | 0.0000 % | 0 | 1.50 |",
                "| alps | 600 x 420 | 100.3 | 5 | `sweep` | 0.10 | 8.12 | 25.2 | 0.0250 % | - | - |",
            ],
        )

    def test_accuracy_says_where_cells_differ(self):
        self.assertEqual(
            rows("accuracy", BENCH)[1],
            "| alps | 600 x 420 | 100.3 | 5 | 25.00 % | `sweep` | 63 (0.0250 %) | 60 | 3 | - |",
        )

    def test_headings_have_the_columns_of_the_rows(self):
        for table in ("speed", "accuracy"):
            for line in [*heading(table, BENCH), *rows(table, BENCH)]:
                self.assertEqual(line.count("|"), heading(table, BENCH)[0].count("|"))

    def test_casters_stand_side_by_side(self):
        self.assertEqual(
            [*heading("casters", BENCH), *rows("casters", BENCH)],
            [
                "| terrain | azimuth | altitude | in shadow | `exact` | `sweep` |",
                "|---|---|---|---|---|---|",
                "| alps | 100.3 | 5 | 25.00 % | 0.0000 % | 0.0250 % |",
            ],
        )

    def test_times_come_with_their_machine(self):
        self.assertEqual(machine(BENCH), "2 threads, kernels `avx2`")

    def test_numbers_have_three_digits(self):
        self.assertEqual([digits(n) for n in (0.0, 9.99, 9.996, 99.96, 12345.6)], ["0.00", "9.99", "10.0", "100", "12346"])

    def test_options_behind_two_dashes_go_to_the_command(self):
        options = parsed(["a.tif", "b.tif", "--light", "1,2", "--duskline", "x", "--", "--flat", "-z", "2"])
        self.assertEqual((options.dems, options.light, options.more), (["a.tif", "b.tif"], ["1,2"], ["--flat", "-z", "2"]))


if __name__ == "__main__":
    unittest.main()
