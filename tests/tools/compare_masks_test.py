"""tools/compare_masks.py counts what differs, on which side, and how far from an edge."""

import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "tools"))
from compare_masks import COLOURS, Mask, colours, compare, in_words, zoomed  # noqa: E402

CODES = {"#": 0, ".": 1, "?": 255}


def mask(*rows):
    return Mask(len(rows[0]), bytes(CODES[cell] for row in rows for cell in row))


TRUTH = mask(
    ".....",
    ".....",
    "..##.",
    ".....",
    "....?",
)


class CompareMasks(unittest.TestCase):
    def test_a_mask_equals_itself(self):
        result = compare(TRUTH, TRUTH)
        self.assertEqual((result["cells"], result["shadow"], result["no_data"]), (25, 2, 1))
        self.assertEqual((result["differ"], result["distances"]), (0, {}))

    def test_both_kinds_of_mistake_are_told_apart(self):
        other = mask(".....", ".....", "...#.", ".....", "#...?")
        result = compare(TRUTH, other)
        self.assertEqual((result["differ"], result["false_light"], result["false_shadow"]), (2, 1, 1))
        self.assertEqual(result["distances"], {1: 1, 2: 1})

    def test_distances_count_diagonals_as_one(self):
        truth = mask("#......", ".......", ".......", ".......")
        for column, distance in [(1, 1), (2, 2), (6, 6)]:
            self.assertEqual(truth.edge_distance(1, column), distance)
        self.assertEqual(truth.edge_distance(3, 0), 3)
        self.assertEqual(truth.edge_distance(0, 0), 1)

    def test_no_data_is_no_edge(self):
        self.assertEqual(mask("..?").edge_distance(0, 0), 0)
        self.assertEqual(mask("..?").edge_distance(0, 2), 0)

    def test_a_cell_that_loses_its_data_differs_on_neither_side(self):
        result = compare(TRUTH, mask("?....", ".....", "..##.", ".....", "....?"))
        self.assertEqual((result["differ"], result["false_light"], result["false_shadow"]), (1, 0, 0))

    def test_the_picture_shows_the_mistakes(self):
        pixels = colours(mask("#."), mask(".#"))
        self.assertEqual(pixels, bytes(COLOURS["false light"] + COLOURS["false shadow"]))
        self.assertEqual(colours(mask("#."), mask("#.")), bytes(COLOURS["shadow"] + COLOURS["lit"]))

    def test_a_part_is_a_mask_of_its_own(self):
        part = TRUTH.part(1, 2, 3, 2)
        self.assertEqual((part.columns, part.rows, part.values), (3, 2, mask(".##", "...").values))
        for outside in [(-1, 0, 2, 2), (0, 4, 1, 2), (3, 0, 3, 1), (0, 0, 0, 1)]:
            self.assertIsNone(TRUTH.part(*outside))

    def test_a_zoomed_picture_repeats_pixels_across_and_down(self):
        self.assertEqual(zoomed(b"abcdef", 1, 2), b"abcabc" * 2 + b"defdef" * 2)
        self.assertEqual(zoomed(b"abcdef", 2, 3), (b"abc" * 3 + b"def" * 3) * 3)
        self.assertEqual(zoomed(b"abcdef", 2, 1), b"abcdef")

    def test_the_summary_names_share_and_sides(self):
        text = in_words(compare(mask("...#"), mask("..##")))
        self.assertIn("1 of 4 cells differ (25.0000 %): 0 lit", text)
        self.assertIn("1  1 cell from a shadow edge", text)


if __name__ == "__main__":
    unittest.main()
