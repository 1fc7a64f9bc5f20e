"""tools/check_layers.py finds what is planted in a small project, and only that."""

import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "tools"))
from check_layers import wrong_includes  # noqa: E402

CLEAN = {
    "src/duskline/CMakeLists.txt": "FILES terrain/height_field.h casting/sweep.h",
    "src/duskline/geometry/grid.h": "#include <vector>\n",
    "src/duskline/terrain/height_field.h": "#include <duskline/geometry/grid.h>\n",
    "src/duskline/casting/sweep.h": "#include <duskline/terrain/height_field.h>\n",
    "src/duskline/casting/kernels/sweep_rows.cpp": '#include "hwy/highway.h"\n',
    "src/duskline/execution/for_rows.cpp": "#include <tbb/parallel_for.h>\n",
    "src/duskline/raster_io/read.cpp": "#include <gdal_priv.h>\n#include <duskline/casting/sweep.h>\n",
    "apps/duskline/main.cpp": '#include "shadow_command.h"\n#include <CLI/CLI.hpp>\n',
    "examples/renderer.cpp": "#include <epoxy/gl.h>\n",
    "tests/raster_io/read_test.cpp": "#include <gdal.h>\n",
}


def problems_with(planted):
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        for name, text in {**CLEAN, **planted}.items():
            (root / name).parent.mkdir(parents=True, exist_ok=True)
            (root / name).write_text(text)
        return wrong_includes(root)


class CheckLayers(unittest.TestCase):
    def expect_problem(self, name, text, words):
        problems = problems_with({name: text})
        self.assertEqual(len(problems), 1, problems)
        self.assertIn(name, problems[0])
        self.assertIn(words, problems[0])

    def test_a_clean_project_has_no_problem(self):
        self.assertEqual(problems_with({}), [])

    def test_a_layer_that_looks_up_is_found(self):
        self.expect_problem("src/duskline/terrain/dome.cpp", "#include <duskline/casting/sweep.h>\n",
                            "terrain may not include casting")

    def test_light_knows_nothing_of_terrain(self):
        self.expect_problem("src/duskline/light/sun.cpp", '  #  include "duskline/terrain/height_field.h"\n',
                            "light may not include terrain")

    def test_a_new_folder_must_be_given_its_place(self):
        self.expect_problem("src/duskline/weather/rain.h", "", "no layer is called weather")

    def test_gdal_stays_in_raster_io(self):
        for header in ("gdal_priv.h", "ogr_spatialref.h", "cpl_conv.h"):
            self.expect_problem("src/duskline/terrain/read.cpp", f"#include <{header}>\n", "raster_io/")

    def test_threads_stay_in_execution(self):
        self.expect_problem("src/duskline/casting/fast.cpp", "#include <oneapi/tbb/task_arena.h>\n", "execution/")

    def test_highway_stays_in_kernels(self):
        self.expect_problem("src/duskline/casting/fast.cpp", "#include <hwy/highway.h>\n", "casting/kernels/")

    def test_erfa_stays_in_light(self):
        self.expect_problem("apps/duskline/sun_command.cpp", "#include <erfa.h>\n", "src/duskline/light/")

    def test_installed_headers_ask_for_no_other_library(self):
        lists = {"src/duskline/CMakeLists.txt": "FILES execution/for_rows.h"}
        header = {"src/duskline/execution/for_rows.h": "#include <tbb/task_arena.h>\n"}
        self.assertEqual(problems_with(header), [])
        self.assertIn("installed", problems_with({**lists, **header})[0])

    def test_nobody_includes_a_program(self):
        self.expect_problem("tests/cli/names_test.cpp", '#include "../../apps/duskline/shadow_command.h"\n',
                            "programs may not be included")


if __name__ == "__main__":
    unittest.main()
