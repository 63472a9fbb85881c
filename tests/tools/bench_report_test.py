#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""scripts/bench_report.py: targets are judged by their limits, and the document has a place for every table."""

import pathlib
import re
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))
import bench_report  # noqa: E402  (found only now)

DOCUMENT = ROOT / "docs" / "BENCHMARKS.md"


def figures_of(**groups):
    figures = {group: {} for group in bench_report.GROUPS}
    figures["archive"] = {"archive/laboratory/5cm": {"load_ms": 50.0, "save_ms": 25.0, "mapping_ms": 300.0,
                                                     "archive_over_ot": 0.5}}
    figures.update(groups)
    return figures


class Targets(unittest.TestCase):
    def test_larger_is_better_unless_said(self):
        self.assertIn("| 12 | 5 | 10 | goal |", bench_report.Target("speed", 12.0, 5, 10).row())
        self.assertIn("| 7 | 5 | 10 | must |", bench_report.Target("speed", 7.0, 5, 10).row())
        self.assertIn("| 4.5 | 5 | 10 | **missed** |", bench_report.Target("speed", 4.5, 5, 10).row())
        self.assertIn("| 4.5 ms | 5 | 5 | goal |", bench_report.Target("t", 4.5, 5, 5, " ms", larger=False).row())
        self.assertIn("| 5.5 ms | 5 | 5 | **missed** |", bench_report.Target("t", 5.5, 5, 5, " ms", larger=False).row())

    def test_what_did_not_run_is_said(self):
        self.assertIn("not run", bench_report.Target("speed", None, 5, 10).row())


class Document(unittest.TestCase):
    def test_every_table_has_its_place_and_all_else_stays(self):
        cloud = {"cloud/64x1024": {"scan_ms": 12.34, "points": 60000.0}}
        snapshot = {"publish/5cm/voxels:10000/objects:100": {"more_percent": 6.0, "frame_ms": 14.7},
                    "snapshot/voxels:10000/objects:100": {"cpu_time": 13.4}}
        before = DOCUMENT.read_text()
        after = bench_report.filled(before, figures_of(cloud=cloud, snapshot=snapshot))
        self.assertIn("| cloud/64x1024 | 12.3 | 60000 |", after)
        self.assertIn("| snapshot/voxels:10000/objects:100 | 13 |", after)
        self.assertIn("publishing every frame, 5cm, 10000 voxels, 100 objects | 6 % | 5 | 5 | **missed** |", after)
        self.assertIn("load and save over the time to map, laboratory 5 cm | 0.25 |", after)
        tables = re.compile(r"(<!-- begin \w+ -->\n).*?(<!-- end \w+ -->)", re.S)
        self.assertEqual(tables.sub(r"\1\2", after), tables.sub(r"\1\2", before))

    def test_tables_without_figures_stay(self):
        before = DOCUMENT.read_text()
        after = bench_report.filled(before, {"cloud": {"cloud/far": {"scan_ms": 1.0}}})
        self.assertIn("| cloud/far | 1.0 |", after)
        begin, end = "<!-- begin targets -->", "<!-- end frame -->"
        self.assertEqual(after[after.index(begin):after.index(end)], before[before.index(begin):before.index(end)])

    def test_a_document_without_a_place_is_refused(self):
        with self.assertRaisesRegex(SystemExit, "no place for `cloud`"):
            bench_report.filled(DOCUMENT.read_text().replace("begin cloud", "begun"), figures_of())


if __name__ == "__main__":
    unittest.main()
