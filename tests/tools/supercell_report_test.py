#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""scripts/supercell_report.py: what is chosen and called better, and that the document has a place for every table."""

import pathlib
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))
import supercell_report  # noqa: E402  (found only now)


def row(method, seed, **figures):
    return {"scene": "crowded", "seed": seed, "level": 3, "method": method, "setting": 0, "text": "", "count": 5625,
            "icv": 0.1, "ev": 0.9, "ue": 0.02, "br": 0.99, "pureness": 0.99, "seconds": 0.1} | figures


class Choice(unittest.TestCase):
    def test_the_least_cost_wins_among_those_that_matched_everywhere(self):
        rows = []
        for method in supercell_report.METHODS:
            for seed in (1, 2):
                rows.append(row(method, seed, setting=0, br=0.97))
                rows.append(row(method, seed, setting=1, br=0.98))
            rows.append(row(method, 1, setting=2, br=1.0))
            rows.append({k: v for k, v in row(method, 2, setting=2).items() if k != "count"})
        self.assertEqual(supercell_report.choose(rows), [1] * len(supercell_report.METHODS))


class Comparisons(unittest.TestCase):
    def test_better_and_worse_follow_the_metric(self):
        rows = [row("SEVDS", seed, ue=0.01 + 0.0001 * seed) for seed in range(8)]
        rows += [row("SEEDS", seed, ue=0.02) for seed in range(8)]
        measured = supercell_report.Measured(rows)
        self.assertEqual(measured.comparison("crowded", "SEVDS", "SEEDS", "ue", False), "better")
        self.assertEqual(measured.comparison("crowded", "SEEDS", "SEVDS", "ue", False), "**worse**")
        self.assertEqual(measured.comparison("crowded", "SEVDS", "SEEDS", "br", True), "alike")

    def test_the_document_has_a_place_for_every_table(self):
        text = (ROOT / "docs" / "RESULTS.md").read_text()
        for name in ("supercell-settings", "supercell-targets", "supercell-means"):
            self.assertIn(f"<!-- begin {name} -->", text)
            self.assertIn(f"<!-- end {name} -->", text)


if __name__ == "__main__":
    unittest.main()
