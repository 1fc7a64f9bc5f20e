"""tools/check_docs.py finds dead links and blocks that are out of date, and renews the blocks."""

import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "tools"))
from check_docs import problems, with_true_blocks  # noqa: E402

CLEAN = {
    "README.md": "# Top\n[more](docs/more.md#the-sun-and-north), [web](https://example.org/x), [here](#top)\n"
    "<!-- file: code.cpp -->\n```cpp\nint x;\n```\n",
    "docs/more.md": "# More\n## The sun, and north\n![picture](../code.cpp) [up](../README.md)\n"
    "```\n[not a link](nowhere.md)\n```\n",
    "code.cpp": "int x;\n",
}


def problems_with(planted):
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        for name, text in {**CLEAN, **planted}.items():
            (root / name).parent.mkdir(parents=True, exist_ok=True)
            (root / name).write_text(text)
        return list(problems(root, None))


class CheckDocs(unittest.TestCase):
    def expect_problem(self, planted, words):
        found = problems_with(planted)
        self.assertEqual(len(found), 1, found)
        self.assertIn(words, found[0])

    def test_true_pages_have_no_problem(self):
        self.assertEqual(problems_with({}), [])

    def test_a_dead_link_is_found(self):
        self.expect_problem({"docs/more.md": "## The sun, and north\n[gone](gone.md)\n"}, "docs/more.md: no file 'gone.md'")

    def test_a_dead_anchor_is_found(self):
        self.expect_problem({"docs/more.md": "## Another heading\n"}, "no heading '#the-sun-and-north'")

    def test_a_stale_block_is_found(self):
        self.expect_problem({"code.cpp": "int y;\n"}, "'file: code.cpp' is out of date")

    def test_a_stale_block_is_renewed_and_nothing_else(self):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            (root / "code.cpp").write_text("int y;\n")
            renewed = with_true_blocks(root, CLEAN["README.md"], None)
            self.assertEqual(renewed, CLEAN["README.md"].replace("int x;", "int y;"))

    def test_what_a_command_prints_is_asked_for(self):
        page = "<!-- prints: duskline shadow -->\n```\nold\n```\n"
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            self.assertEqual(with_true_blocks(root, page, None), page)
            self.assertIn("```\nshadow\n```", with_true_blocks(root, page, "/bin/echo"))


if __name__ == "__main__":
    unittest.main()
