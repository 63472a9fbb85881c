#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""scripts/measured_middle.py by hand."""

import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "scripts"))

from measured_middle import columns, convex_hull, middle  # noqa: E402  (found only now)


class MeasuredMiddle(unittest.TestCase):
    def test_hull_leaves_out_what_lies_inside_and_on_sides(self):
        square = [(0, 0), (2, 0), (2, 2), (0, 2)]
        self.assertEqual(convex_hull(square + [(1, 1), (1, 0), (2, 0)]), square)

    def test_middle_is_that_of_the_area(self):
        # Points inside, more of them at one side, move nothing.
        house = [(0, 0), (2, 0), (2, 2), (0, 2), (0.1, 1), (0.2, 1)]
        for found, wanted in zip(middle(house), (1, 1)):
            self.assertAlmostEqual(found, wanted)
        for found, wanted in zip(middle([(0, 0), (3, 0), (0, 3)]), (1, 1)):
            self.assertAlmostEqual(found, wanted)

    def test_middle_of_a_line_and_of_a_point(self):
        self.assertEqual(middle([(0, 0), (1, 1), (4, 4)]), (2, 2))
        self.assertEqual(middle([(3, 5)]), (3, 5))

    def test_columns_have_each_place_once(self):
        self.assertEqual(columns([0, 1, 2, 0, 1, 3, -1, 0, 0], 0.5), {(0.25, 0.75), (-0.25, 0.25)})


if __name__ == "__main__":
    unittest.main()
