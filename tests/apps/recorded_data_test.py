#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The program on data by others, against what is known of it.

Usage: recorded_data_test.py PROGRAM [unittest args]"""

import collections
import json
import math
import pathlib
import re
import shutil
import struct
import tempfile
import unittest
import zipfile

from program import DATA, IS_SANITIZED, SOURCE, digest, repetitions, run

# One sequence takes every path of the program; what the others measure, no sanitizer changes.
sees_the_same = unittest.skipIf(IS_SANITIZED, "maps another sequence by the same code")


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

    def view_weights(self, archive):
        """The squares that docs/EVALUATION.md, "Calibration", shares out among the classes of a map's only object."""
        with zipfile.ZipFile(archive) as members:
            names = re.findall(r"[^\[\],]+", members.read("classes.yaml").decode().strip())
            head, *lines = members.read("objects.jsonl").decode().splitlines()
        self.assertEqual(json.loads(head)["num_objects"], 1)
        entry = lines[0]  # codes of cells follow
        detections = [row for row in json.loads(entry)["ledger"]["summaries"] if row[0] == 0]
        of_view = collections.Counter()
        for _, _, _, view, count, *_ in detections:
            of_view[view] += count
        roots = collections.Counter()
        for _, _, number, view, count, *_ in detections:
            roots[names[number].strip()] += count / math.sqrt(of_view[view])
        return {name: root * root for name, root in roots.items()}

    def test_the_cabinet_answers_with_all_names_that_it_was_given(self):
        archive, (cabinet,) = self.mapped("tum_fr3_cabinet", "--dataset",
                                          SOURCE / "data/datasets/tum_fr3_cabinet.yaml")
        shares = {one["name"]: one["probability"] for one in cabinet["classes"]}
        self.assertEqual(list(shares.values()), sorted(shares.values(), reverse=True))
        self.assertAlmostEqual(sum(shares.values()), 1.0, places=9)
        self.assertEqual(set(list(shares)[:4]), {"microwave", "refrigerator", "tvmonitor", "oven"})
        weights = self.view_weights(archive)
        all_classes = sum(weights.values()) + 0.2  # for those that were never named
        for name in list(shares)[:4]:
            self.assertAlmostEqual(shares[name], weights[name] / all_classes, places=9)
        self.assertAlmostEqual(cabinet["class_entropy_nats"], -sum(p * math.log(p) for p in shares.values()), places=9)
        self.assertEqual(cabinet["name"], next(iter(shares)))
        self.assertEqual(cabinet["runner_up"], cabinet["classes"][1])
        self.assertAlmostEqual(cabinet["confidence"], cabinet["real_probability"] * shares[cabinet["name"]], places=9)
        text = run("query", archive, "--layer", "objects").stdout
        for name in list(shares)[:4]:
            self.assertIn(f"{name} {shares[name]:.2f}", text)
        self.assertNotIn(f"{list(shares)[-1]} 0.00", text)

    @sees_the_same
    def test_the_living_room_is_mapped(self):
        _, objects = self.mapped("icl_nuim_livingroom1", "--dataset",
                                 SOURCE / "data/datasets/icl_nuim_livingroom1.yaml")
        self.assertGreaterEqual(len(objects), 1)
        stats = json.loads((self.folder / "stats.json").read_text())
        self.assertEqual(stats["frames"], 43)
        self.assertIn("floor", stats["up"])

    @sees_the_same
    def test_the_kitchen_is_a_kitchen(self):
        _, objects = self.mapped("7scenes_redkitchen", "--stride", "2")
        names = {thing["name"] for thing in objects}
        self.assertLessEqual({"diningtable", "chair", "cup"}, names)


class Appending(unittest.TestCase):
    """Two halves of a recorded kitchen, and other places, in one map."""

    KITCHEN = DATA / "rgbd/7scenes_redkitchen"
    HALF = repetitions(100)  # frames

    @classmethod
    def setUpClass(cls):
        if not cls.KITCHEN.exists():
            raise unittest.SkipTest(f"test data not present: {cls.KITCHEN}")
        shared = pathlib.Path(tempfile.mkdtemp(prefix="hypermap-append-"))
        cls.addClassCleanup(shutil.rmtree, shared)
        cls.first_half = shared / "kitchen.hmap"
        cls.mapped = run("map", "--input", cls.KITCHEN, "--max-frames", cls.HALF, "--output", cls.first_half)

    def setUp(self):
        self.assertEqual(self.mapped.returncode, 0, self.mapped.stderr)
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="hypermap-append-"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.archive = self.folder / "kitchen.hmap"
        shutil.copy(self.first_half, self.archive)

    def appended(self, *arguments):
        return run("map", "--append", "--output", self.archive, *arguments)

    def runs(self):
        newest = json.loads(run("info", self.archive, "--json").stdout)["provenance"]
        return [*newest.pop("earlier"), newest]

    def test_two_halves_lie_in_one_world(self):
        second_half = ("--input", self.KITCHEN, "--first", self.HALF, "--max-frames", self.HALF)
        before = digest(self.archive)
        refused = self.appended(*second_half)
        self.assertEqual(refused.returncode, 2, refused.stderr)
        self.assertIn("--same-world", refused.stderr)
        self.assertIn("--transform", refused.stderr)
        self.assertEqual(digest(self.archive), before)
        result = self.appended(*second_half, "--same-world")
        self.assertEqual(result.returncode, 0, result.stderr)
        first, second = self.runs()
        self.assertEqual(second["map_from_input"], first["map_from_input"])
        self.assertNotEqual(second["input_hash"], first["input_hash"])
        self.assertEqual((first["next_frame_index"], second["next_frame_index"]), (self.HALF, 2 * self.HALF))

    def test_frames_of_the_map_are_refused(self):
        before = digest(self.archive)
        refused = self.appended("--input", self.KITCHEN, "--same-world")
        self.assertEqual(refused.returncode, 2, refused.stderr)
        self.assertIn("in the map already", refused.stderr)
        self.assertEqual(digest(self.archive), before)
        forced = self.appended("--input", self.KITCHEN, "--max-frames", 5, "--same-world", "--force")
        self.assertEqual(forced.returncode, 0, forced.stderr)

    def test_another_place_is_said(self):
        cabinet = ("--input", DATA / "rgbd/tum_fr3_cabinet", "--max-frames", 10,
                   "--dataset", SOURCE / "data/datasets/tum_fr3_cabinet.yaml")
        for placement, words in (("0,0,0,0", "another place"), ("40,0,0,0", "shows nothing of what the map knows")):
            with self.subTest(placement):
                result = self.appended(*cabinet, "--transform", placement, "--force")
                self.assertEqual(result.returncode, 1, result.stderr)
                self.assertIn(words, result.stderr)

    def test_flags_that_contradict_each_other_are_a_wrong_command_line(self):
        for flags in (("--same-world", "--transform", "0,0,0,0"), ("--same-world", "--up", "z"),
                      ("--transform", "0,0,0"), ("--transform", "0,0,nan,0")):
            with self.subTest(flags):
                self.assertEqual(self.appended("--input", self.KITCHEN, *flags).returncode, 4)
        result = run("map", "--input", self.KITCHEN, "--output", self.folder / "b.hmap", "--same-world")
        self.assertEqual(result.returncode, 4, "--same-world without --append")


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

    def test_the_nearest_where_no_archive_has_3d_objects(self):
        for name in ("map_t16", "lab_rosbag_t1_intersection", "semantic_gt_2019-04-23-12-51-46"):
            with self.subTest(name):
                path = DATA / f"hmap/{name}.hmap"
                chairs = json.loads(run("query", path, "--layer", "semantic", "--string", "chair", "--json").stdout)
                away = {one["id"]: math.dist(one["position"], (0, 0)) for one in chairs["results"]}
                told = run("query", path, "--nearest", "Chair", "--at", "0,0", "--top", 2, "--json")
                self.assertIn(told.returncode, (0, 1), told.stderr)
                found = json.loads(told.stdout)["results"]
                self.assertEqual([one["id"] for one in found], sorted(away, key=away.get)[:2])
                self.assertAlmostEqual(found[0]["distance_m"], away[found[0]["id"]], delta=1e-9)
                self.assertIn("1 found", run("query", path, "--nearest", "chair", "--at", "0,0").stdout)
                high = run("query", path, "--nearest", "chair", "--at", "0,0,1")
                self.assertEqual((high.returncode, "--at takes 2 numbers" in high.stderr), (4, True), high.stderr)

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
