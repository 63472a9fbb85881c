#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""scripts/mcnemar.py: p by hand, and by all outcomes one by one."""

import itertools
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "scripts"))

from mcnemar import p_different  # noqa: E402  (found only now)


class McNemar(unittest.TestCase):
    def test_by_hand(self):
        self.assertEqual(p_different(0, 0), 1.0)
        self.assertEqual(p_different(3, 3), 1.0)
        self.assertEqual(p_different(0, 6), 2 / 2 ** 6)
        self.assertEqual(p_different(1, 5), 2 * (1 + 6) / 2 ** 6)

    def test_all_outcomes(self):
        """The share of all choices of the right one that are as far from a half as the observed one."""
        for first, second in itertools.product(range(5), repeat=2):
            far = abs(first - second)
            choices = list(itertools.product((1, -1), repeat=first + second))
            share = sum(abs(sum(signs)) >= far for signs in choices) / len(choices)
            self.assertAlmostEqual(p_different(first, second), share)


if __name__ == "__main__":
    unittest.main()
