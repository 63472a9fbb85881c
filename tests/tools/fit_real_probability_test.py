#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""scripts/fit_real_probability.py: what it takes from an observation log, that it finds the coefficients again,
and what it says of a folder that it cannot fit to."""

import json
import math
import pathlib
import random
import subprocess
import sys
import tempfile
import unittest
import zipfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))
import fit_real_probability  # noqa: E402  (found only now)


def row(kind, bearing_bin, count, score_sum, class_id=7, detector=0):
    return [kind, detector, class_id, bearing_bin, count, score_sum, 0.0, 0]


class Fit(unittest.TestCase):
    def test_features_are_logarithms_of_sums(self):
        log = {"summaries": [row(0, 3, 4, 2.5), row(0, 5, 2, 1.0), row(0, 5, 1, 0.5), row(1, 3, 9, 1.25), row(1, 4, 1, 0.5)]}
        self.assertEqual(fit_real_probability.features(log), [1.0, math.log(7), math.log(2), math.log1p(1.75), 0.0, 0.0])

    def test_one_detection_alone_is_told(self):
        self.assertEqual(fit_real_probability.features({"summaries": [row(0, 3, 1, 0.5)]}), [1.0, 0.0, 0.0, 0.0, 0.0, 1.0])

    def test_what_is_named_otherwise_is_counted_for_each_detector(self):
        log = {"summaries": [row(0, 3, 3, 2.0), row(0, 3, 1, 0.5, class_id=8), row(0, 4, 4, 2.0, class_id=9, detector=1)]}
        self.assertEqual(fit_real_probability.features(log)[4], 1.0 - 7 / 8)

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


class Folder(unittest.TestCase):
    """A folder of reports and maps, on the command line."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def put(self, name, are_real, detections=4):
        """A report and its map, of one object for each truth."""
        rows = [{"id": i + 1, "truth": {"id": 7} if is_real else None} for i, is_real in enumerate(are_real)]
        (self.folder / f"{name}.json").write_text(json.dumps({"objects": rows}))
        kind = 0 if detections else 1
        objects = [json.dumps({"id": r["id"], "ledger": {"summaries": [row(kind, 3, detections, 1.0)]}}) for r in rows]
        head = json.dumps({"format": "hypermap-objects", "version": 4, "num_objects": len(objects)})
        cells = [json.dumps("AAYSkf0hpDPyOguH01jBuA==") for _ in objects]
        with zipfile.ZipFile(self.folder / f"{name}.hmap", "w") as archive:
            archive.writestr("objects.jsonl", "\n".join([head, *objects, *cells]))

    def run_script(self, folder=None):
        return subprocess.run([sys.executable, "-B", ROOT / "scripts/fit_real_probability.py", folder or self.folder],
                              capture_output=True, text=True, check=False)

    def assert_refused(self, *words, folder=None):
        result = self.run_script(folder)
        self.assertEqual((result.returncode, result.stdout), (2, ""), result.stderr)
        self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)
        for word in (str(folder or self.folder), *words):
            self.assertIn(word, result.stderr)

    def test_pairs_are_fitted(self):
        self.put("a", [True, False])
        self.put("b", [True])
        result = self.run_script()
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertEqual(result.stdout.splitlines()[0], "3 objects, 2 of them real")

    def test_a_folder_without_reports(self):
        self.assert_refused("needs a report or more")

    def test_no_folder(self):
        self.assert_refused("must be a folder", folder=self.folder / "absent")

    def test_a_report_without_its_map(self):
        self.put("a", [True, False])
        (self.folder / "a.hmap").unlink()
        self.assert_refused("each report needs its map beside it", "a.json has no a.hmap")

    def test_objects_of_one_kind_of_truth(self):
        for are_real, counts in (([True, True], "2 and 0"), ([False], "0 and 1"), ([], "0 and 0")):
            with self.subTest(are_real):
                self.put("a", are_real)
                self.assert_refused("real and such that are not", counts)

    def test_what_was_never_detected_is_of_no_kind(self):
        self.put("a", [True, False], detections=0)
        self.assert_refused("has 0 and 0")

    def test_files_that_are_no_pair_are_named(self):
        self.put("a", [True, False])
        for name, text in (("a.json", "{"), ("a.json", "{}"), ("a.json", "[]"), ("a.hmap", "no archive")):
            with self.subTest(name=name, text=text):
                self.put("a", [True, False])
                (self.folder / name).write_text(text)
                self.assert_refused(f"{name}: must be a")


if __name__ == "__main__":
    unittest.main()
