#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""scripts/fit_real_probability.py: what it takes from an observation log, and that it finds the coefficients again."""

import math
import pathlib
import random
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))
import fit_real_probability  # noqa: E402  (found only now)


def row(kind, bearing_bin, count, score_sum):
    return [kind, 0, 7, bearing_bin, count, score_sum, 0.0, 0]


class Fit(unittest.TestCase):
    def test_features_are_logarithms_of_sums(self):
        log = {"summaries": [row(0, 3, 4, 2.5), row(0, 5, 2, 1.0), row(0, 5, 1, 0.5), row(1, 3, 9, 1.25), row(1, 4, 1, 0.5)]}
        self.assertEqual(fit_real_probability.features(log), [1.0, math.log(7), math.log(2), math.log1p(1.75)])

    def test_what_was_never_detected_says_nothing(self):
        self.assertIsNone(fit_real_probability.features({"summaries": [row(1, 3, 9, 1.25)]}))

    def test_a_system_whose_first_pivot_is_zero(self):
        self.assertEqual(fit_real_probability.solved([[0.0, 2.0], [4.0, 0.0]], [6.0, 8.0]), [2.0, 3.0])

    def test_known_coefficients_are_found_again(self):
        numbers = random.Random(1)
        truth = [-1.0, 2.0, 0.5, -1.5]
        cases = []
        for _ in range(20000):
            x = [1.0] + [numbers.uniform(0.0, 3.0) for _ in range(3)]
            p = 1.0 / (1.0 + math.exp(-sum(w * v for w, v in zip(truth, x))))
            cases.append((x, numbers.random() < p))
        for found, expected in zip(fit_real_probability.fitted(cases), truth):
            self.assertAlmostEqual(found, expected, delta=0.15)

    def test_separable_cases_end(self):
        weights = fit_real_probability.fitted([([1.0, 0.0], False), ([1.0, 1.0], True)])
        self.assertGreater(weights[1], 1.0)
        self.assertTrue(all(math.isfinite(w) for w in weights))


if __name__ == "__main__":
    unittest.main()
