#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The program on data by others, against what is known of it.

Usage: recorded_data_test.py PROGRAM [unittest args]"""

import collections
import json
import pathlib
import shutil
import struct
import tempfile
import unittest

from program import DATA, SOURCE, run


class RealData(unittest.TestCase):
    """Recorded sequences and a real detector, against what is known of the places."""

    MODEL = DATA / "models/yolox_nano/yolox_nano.onnx"

    def setUp(self):
        if not self.MODEL.exists():
            self.skipTest(f"test data not present: {self.MODEL}")
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="hypermap-real-"))
        self.addCleanup(shutil.rmtree, self.folder)

    def mapped(self, name, *arguments):
        archive = self.folder / f"{name}.hmap"
        result = run("map", "--input", DATA / "rgbd" / name, "--model", self.MODEL, "--output", archive,
                     "--stats", self.folder / "stats.json", *arguments)
        self.assertEqual(result.returncode, 0, result.stderr)
        objects = json.loads(run("query", archive, "--layer", "objects", "--json").stdout)["results"]
        return archive, objects

    def layer_heights(self, archive):
        """How many occupied voxels lie at each height, from the exported points."""
        ply = self.folder / "points.ply"
        self.assertEqual(run("export", archive, "--format", "ply", "--output", ply).returncode, 0)
        header, body = ply.read_bytes().split(b"end_header\n", 1)
        self.assertIn(b"format binary_little_endian", header)
        counts = collections.Counter()
        for (_, _, z, *_) in struct.iter_unpack("<fffBBBHIf", body):
            counts[round(z, 4)] += 1
        return counts

    def test_the_cabinet_stands_once_and_its_top_is_where_it_was_measured(self):
        archive, objects = self.mapped("tum_fr3_cabinet", "--dataset",
                                       SOURCE / "data/datasets/tum_fr3_cabinet.yaml")
        self.assertEqual(len(objects), 1, objects)
        top = objects[0]["position"][2] + objects[0]["size_m"][2] / 2
        self.assertGreaterEqual(top, 0.55 - 0.04)
        self.assertLessEqual(top, 0.60 + 0.04)
        (height, _), = self.layer_heights(archive).most_common(1)
        self.assertLessEqual(abs(height), 0.03, "the floor lies at z = 0")

    def test_the_living_room_is_mapped(self):
        _, objects = self.mapped("icl_nuim_livingroom1", "--dataset",
                                 SOURCE / "data/datasets/icl_nuim_livingroom1.yaml")
        self.assertGreaterEqual(len(objects), 1)
        stats = json.loads((self.folder / "stats.json").read_text())
        self.assertEqual(stats["frames"], 43)
        self.assertIn("floor", stats["up"])

    def test_the_kitchen_is_a_kitchen(self):
        _, objects = self.mapped("7scenes_redkitchen", "--stride", "2")
        names = {thing["name"] for thing in objects}
        self.assertLessEqual({"diningtable", "chair", "cup"}, names)


class KnownAnswers(unittest.TestCase):
    """The answers that are known for the recorded maps."""

    def setUp(self):
        self.truth = DATA / "hmap/semantic_gt_2019-04-23-12-51-46.hmap"
        if not self.truth.exists():
            self.skipTest(f"test data not present: {self.truth}")

    def results(self, *arguments):
        result = run("query", self.truth, "--layer", "semantic", "--json", *arguments)
        self.assertIn(result.returncode, (0, 1), result.stderr)
        return json.loads(result.stdout)["results"]

    def test_the_sink(self):
        (sink,) = self.results("--string", "sink")
        self.assertAlmostEqual(sink["position"][0], 3.259, delta=0.001)
        self.assertAlmostEqual(sink["position"][1], 2.378, delta=0.001)

    def test_the_chair_in_an_area(self):
        (chair,) = self.results("--string", "chair", "--area", "2 2,2 3,1 3,1 2")
        self.assertAlmostEqual(chair["position"][0], 1.429, delta=0.001)
        self.assertAlmostEqual(chair["position"][1], 2.887, delta=0.001)

    def test_what_is_at_a_point_and_in_an_area(self):
        self.assertEqual([hit["name"] for hit in self.results("--at", "3,-2")], ["table"])
        names = {hit["name"] for hit in self.results("--area", "3 -2,3 -1,2 -1,2 -2")}
        self.assertEqual(names, {"table", "tvmonitor", "chair"})

    def test_every_archive_loads(self):
        for path in sorted((DATA / "hmap").glob("*.hmap")):
            with self.subTest(path.name):
                result = run("info", path, "--json")
                self.assertIn(result.returncode, (0, 1), result.stderr)
                self.assertGreater(len(json.loads(result.stdout)["layers"]), 0)

    def test_the_example_has_two_layers(self):
        info = json.loads(run("info", DATA / "hmap/hmap_example.hmap", "--json").stdout)
        self.assertEqual(len(info["layers"]), 2)

if __name__ == "__main__":
    unittest.main(verbosity=1)
