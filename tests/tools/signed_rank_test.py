#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""scripts/signed_rank.py: p by hand, and by all signs one by one."""

import itertools
import pathlib
import random
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))
from signed_rank import p_different, p_greater  # noqa: E402  (found only now)


def by_all_signs(a, b):
    """Two-sided: the share of signs whose sum of ranks is as far from half of all."""
    values = [x - y for x, y in zip(a, b) if x != y]
    ranks = [sum(abs(v) < abs(d) for v in values) + (1 + sum(abs(v) == abs(d) for v in values)) / 2 for d in values]

    def away(signs):
        return abs(sum(rank for rank, sign in zip(ranks, signs) if sign) - sum(ranks) / 2)

    all_signs = list(itertools.product((False, True), repeat=len(values)))
    return sum(away(signs) >= away([d > 0 for d in values]) for signs in all_signs) / len(all_signs)


class SignedRank(unittest.TestCase):
    def test_one_sided_by_hand(self):
        # Differences 1, 2, 3: one of eight sign patterns reaches the rank sum 6.
        self.assertEqual(p_greater([2, 4, 6], [1, 2, 3]), 1 / 8)
        # Differences -1, 2, 3: rank sum 5 is reached by {2, 3} and {1, 2, 3}.
        self.assertEqual(p_greater([0, 4, 6], [1, 2, 3]), 2 / 8)
        # Ties share ranks: differences 1, 1, each of rank 1.5.
        self.assertEqual(p_greater([2, 3], [1, 2]), 1 / 4)
        self.assertEqual(p_greater([1, 2], [1, 2]), 1)

    def test_two_sided_by_hand(self):
        self.assertEqual(p_different([2, 4, 6], [1, 2, 3]), 2 / 8)
        self.assertEqual(p_different([1, 2, 3], [2, 4, 6]), 2 / 8)
        self.assertEqual(p_different([1] * 10, [0] * 10), 2 / 1024)
        self.assertEqual(p_different([1, 2], [1, 2]), 1)

    def test_two_sided_by_all_signs(self):
        draw = random.Random(1)
        for _ in range(100):
            pairs = [(draw.randint(0, 6), draw.randint(0, 7)) for _ in range(draw.randint(1, 9))]
            a, b = zip(*pairs)
            self.assertAlmostEqual(p_different(a, b), by_all_signs(a, b), msg=str(pairs))


if __name__ == "__main__":
    unittest.main()
