#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""scripts/evaluation_report.py: means, worst and what a class is most confused for, over the seeds of a scene."""

import contextlib
import io
import json
import pathlib
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))
import evaluation_report  # noqa: E402  (found only now)


def report_of(f1, jaccard, worst, voxels):
    row = {"truths": 2, "objects": 2, "matched": 1, "excluded": 3, "rarely_seen": 1, "duplicates": 1, "precision": f1,
           "recall": f1, "f1": f1, "distance_m": 0.1, "jaccard_in_place": jaccard, "worst_jaccard_in_place": worst,
           "seen_jaccard_in_place": None, "footprint_covered": 0.5, "box_iou": 0.25}
    report = {"one_to_one": row, "classes": {"sofa": {"one_to_one": row}}, "voxels": voxels}
    if f1 < 1.0:  # older reports have no such key
        report["occupancy"] = {"free_precision": 0.75, "free_recall": 0.625}
    return report


def voxels_of(precision, confused_for):
    sofa = {"labelled": 10, "right": 4, "true": 20, "found": 5, "confused_for": confused_for}
    return {"precision": precision, "recall": 0.5, "wrong_class_share": 0.1, "surface_covered": 0.9,
            "classes": {"sofa": sofa}}


class Report(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.scene = pathlib.Path(self.folder.name) / "attic"
        self.scene.mkdir()
        nothing = {"n": 0, "expected_error": None, "interval_95": None, "log_loss": None}
        some = {"n": 7, "expected_error": 0.125, "interval_95": [0.1, 0.2], "log_loss": 0.5}
        reports = {"1": report_of(0.5, 0.6, 0.2, voxels_of(0.25, {"chair": 3, "bed": 1})),
                   "2": report_of(1.0, 0.8, 0.4, voxels_of(0.75, {"chair": 3})),
                   "together": {"calibration": {"best_class": nothing, "real": some}}}
        for name, report in reports.items():
            (self.scene / f"{name}.json").write_text(json.dumps(report))

    def printed(self, *arguments):
        output = io.StringIO()
        with contextlib.redirect_stdout(output):
            evaluation_report.main([str(argument) for argument in arguments])
        return output.getvalue()

    def test_a_scene_is_told_by_seed_mean_and_class(self):
        text = self.printed(self.scene)
        self.assertIn("1: F1 0.500", text)
        self.assertIn("attic: F1 mean 0.750, worst 0.500; Jaccard mean 0.700, worst 0.200, half seen -", text)
        self.assertIn("labels: precision 0.500, recall 0.500", text)
        self.assertIn("free cells: precision 0.750, recall 0.625; duplicates 2; excluded 6, rarely seen 2", text)
        self.assertIn("P(best class): calibration error - (- .. -), log loss -, 0 objects", text)
        self.assertIn("P(real): calibration error 0.125 (0.100 .. 0.200), log loss 0.500, 7 objects", text)
        # 8 of 20 labels are right, 10 of 40 voxels are found, 6 of 40 are called a chair.
        self.assertIn("sofa: 2 of 4, 2, 0.500, 0.100, 0.700, 0.250; 0.40, 0.25, chair 0.15", text)

    def test_scenes_stand_in_one_table(self):
        lines = self.printed("--table", self.scene, self.scene).splitlines()
        self.assertEqual(len(lines), 4)
        self.assertEqual(len({line.count("|") for line in lines}), 1)
        self.assertTrue(lines[2].startswith("| attic | 0.750 | 0.500 |"))

    def test_a_truth_without_surfaces_has_no_labels(self):
        (self.scene / "1.json").write_text(json.dumps(report_of(0.5, 0.6, 0.2, None)))
        text = self.printed(self.scene)
        self.assertIn("labels: precision -, recall -", text)
        self.assertIn("labels: precision 0.750", text)


if __name__ == "__main__":
    unittest.main()
