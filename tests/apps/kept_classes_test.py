#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Only detections of named classes: `--keep-classes` of `map` and `detect`.

Usage: kept_classes_test.py PROGRAM [unittest args]"""

import collections
import json
import pathlib
import shutil
import tempfile
import unittest

from program import DATA, digest, run


class KeptClasses(unittest.TestCase):
    MODEL = DATA / "models/yolox_nano/yolox_nano.onnx"

    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="hypermap-kept-"))
        cls.dataset = cls.folder / "lab"
        cls.simulated = run("simulate", "--frames", 12, "--seed", 1, "--detector", "perfect", "--output", cls.dataset)

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def setUp(self):
        self.assertEqual(self.simulated.returncode, 0, self.simulated.stderr)
        self.output = self.folder / "a.hmap"
        self.stats = self.folder / "stats.json"

    def detected(self):
        """How many detections there are of each class on file."""
        counts = collections.Counter()
        for line in (self.dataset / "detections.jsonl").read_text().splitlines():
            counts.update(one["label"] for one in json.loads(line).get("detections", []))
        return counts

    def mapped(self, *more, status=0):
        result = run("map", "--input", self.dataset, "--output", self.output, "--stats", self.stats, *more)
        self.assertEqual(result.returncode, status, result.stderr)
        objects = json.loads(run("query", self.output, "--layer", "objects", "--json").stdout)["results"]
        return result, json.loads(self.stats.read_text()), {found["name"] for found in objects}

    def test_others_are_dropped_and_counted(self):
        counts = self.detected()
        self.assertGreater(len(counts), 2)
        _, stats, classes = self.mapped()
        self.assertEqual(stats["detections"], counts.total())
        self.assertEqual(stats["detections_filtered"], 0)
        self.assertIn("chair", classes)
        self.assertGreater(len(classes), 1)
        result, stats, classes = self.mapped("--keep-classes", "chair")
        self.assertEqual(stats["detections"], counts.total())
        self.assertEqual(stats["detections_filtered"], counts.total() - counts["chair"])
        self.assertLessEqual(stats["segments"], counts["chair"])
        self.assertIn(f"{stats['detections_filtered']} of them left out by their class", result.stdout)
        self.assertEqual(classes, {"chair"})

    def test_names_are_taken_in_any_spelling_and_several_at_once(self):
        table = next(name for name in self.detected() if name != "chair" and " " not in name)
        self.mapped("--keep-classes", f"chair,{table}")
        once = digest(self.output)
        self.mapped("--keep-classes", "chair", "--keep-classes", table)
        self.assertEqual(digest(self.output), once)
        _, stats, _ = self.mapped("--keep-classes", f"CHAIR,{table.upper()}")
        counts = self.detected()
        self.assertEqual(stats["detections_filtered"], counts.total() - counts["chair"] - counts[table])

    def test_a_class_that_nobody_names_is_told_with_the_nearest(self):
        result, stats, classes = self.mapped("--keep-classes", "chiar", status=1)
        self.assertIn('wanted_classes: no class of the input is called "chiar", did you mean "chair"?', result.stderr)
        self.assertEqual(stats["detections_filtered"], stats["detections"])
        self.assertEqual(classes, set())

    def test_a_file_of_options_and_the_provenance_name_them(self):
        config = self.folder / "options.yaml"
        config.write_text("wanted_classes: [chair]\n")
        self.assertEqual(self.mapped("--config", config)[2], {"chair"})
        once = digest(self.output)
        self.mapped("--keep-classes", "chair")
        self.assertEqual(digest(self.output), once)
        options = json.loads(run("info", self.output, "--json").stdout)["provenance"]["options"]
        self.assertEqual(options["wanted_classes"], "[chair]")

    def found_by(self, *more, status=0):
        output = self.folder / "found.jsonl"
        result = run("detect", "--input", DATA / "rgbd/icl_nuim_livingroom1", "--dataset",
                     pathlib.Path(__file__).parents[2] / "data/datasets/icl_nuim_livingroom1.yaml",
                     "--max-frames", 6, "--model", self.MODEL, "--output", output, *more)
        self.assertEqual(result.returncode, status, result.stderr)
        lines = [json.loads(line) for line in output.read_text().splitlines()[1:]]
        return result, [(line["image"], one["label"], one["bbox"])
                        for line in lines for one in line.get("detections", [])]

    @unittest.skipUnless(MODEL.exists(), "recorded data are absent")
    def test_a_detector_writes_the_wanted_ones(self):
        _, found = self.found_by()
        kept = found[0][1]
        wanted = [one for one in found if one[1] == kept]
        self.assertLess(len(wanted), len(found))
        result, some = self.found_by("--keep-classes", kept.upper())
        self.assertEqual(some, wanted)
        self.assertRegex(result.stdout, rf"(?m)^{len(found) - len(wanted)} detections? of other classes left out$")
        result, none = self.found_by("--keep-classes", "chiar", status=1)
        self.assertEqual(none, [])
        self.assertIn('wanted_classes: no class of the input is called "chiar", did you mean "chair"?', result.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=1)
