#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Maps against labelled clouds and semantic files, and the picture of map and truth.

Usage: eval_clouds_test.py PROGRAM [unittest args]"""

import csv
import json
import struct
import unittest

from laboratory import LaboratoryCase
from program import DATA, digest, run


def png_size(path):
    head = path.read_bytes()[:24]
    assert head[:8] == b"\x89PNG\r\n\x1a\n"
    return struct.unpack(">II", head[16:24])


class Clouds(LaboratoryCase):
    SIMULATION = ("--frames", 20, "--size", "320x240")
    RESOLUTION_M = 0.1

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.cloud = cls.folder / "lab.ply"
        exported = run("export", cls.map, "--format", "ply", "--output", cls.cloud)
        if exported.returncode != 0:
            cls.failed.append(exported.stderr)

    def evaluated(self, *more, map_=None, truth=None, status=0):
        result = run("eval", "--map", map_ or self.map, "--truth", truth or self.cloud, *more)
        self.assertEqual(result.returncode, status, result.stderr)
        return result.stderr if status else result.stdout

    def test_a_map_is_right_by_its_own_voxels(self):
        found = json.loads(self.evaluated("--json"))
        self.assertGreater(found["labelled"], 100)
        self.assertEqual((found["precision"], found["off_cloud"], found["wrong_class"], found["covered"]), (1, 0, 0, 1))
        self.assertEqual(found["true"], found["found"] + found["unlabelled"])
        self.assertLess(found["distances"]["max_m"], 1e-6)
        self.assertGreater(found["points_without_class"], 0)
        self.assertEqual(found["points"], found["distances"]["n"])
        text = self.evaluated()
        self.assertIn("0 of the labelled voxels are near no point of the cloud", text)
        self.assertRegex(text, r"from points to occupied space: mean 0\.0000 m")

    def test_a_table_for_spreadsheets(self):
        tables = self.folder / "voxels"
        found = json.loads(self.evaluated("--json", "--csv", tables))
        self.assertEqual([path.name for path in tables.iterdir()], ["voxels.csv"])
        with open(tables / "voxels.csv", newline="", encoding="utf-8") as file:
            rows = {row.pop("class"): row for row in csv.DictReader(file)}
        self.assertEqual(rows.keys(), {*found["classes"], "all"})
        for name, row in rows.items():
            of_class = found if name == "all" else found["classes"][name]
            self.assertEqual({key: float(value) if value else None for key, value in row.items()},
                             {key: of_class[key] for key in row})
        cloud = self.folder / "voxels.csv"  # a name that the table would take
        cloud.write_bytes(self.cloud.read_bytes())
        self.assertEqual(run("eval", "--map", self.map, "--truth", cloud, "--csv", self.folder).returncode, 4)

    def test_a_moved_cloud_is_moved_back(self):
        moved = self.folder / "moved.hmap"
        self.assertEqual(run("transform", self.map, "--by", "1,2,0,0", "--output", moved).returncode, 0)
        off = json.loads(self.evaluated("--json", map_=moved))
        self.assertGreater(off["distances"]["mean_m"], 0.1)
        back = json.loads(self.evaluated("--json", "--transform", "1,2,0,0", map_=moved))
        self.assertEqual(back["precision"], 1)
        self.assertLess(back["distances"]["max_m"], 1e-4)

    def test_labels_need_names(self):
        cloud = self.folder / "few.pcd"
        cloud.write_text("VERSION 0.7\nFIELDS x y z label\nSIZE 4 4 4 4\nTYPE F F F U\nWIDTH 2\nHEIGHT 1\nDATA ascii\n"
                         "0 0 0.05 1\n1 1 nan 2\n")
        names = self.folder / "names.yaml"
        names.write_text("1: floor\n2: chair\n")
        self.assertIn("--labels: has labels without names", self.evaluated(truth=cloud, status=2))
        found = json.loads(self.evaluated("--labels", names, "--json", truth=cloud))
        self.assertEqual((found["points"], found["points_unmeasured"], found["points_without_class"]), (1, 1, 0))
        names.write_text("1: floor\nx: chair\n")
        self.assertIn("names.yaml:2", self.evaluated("--labels", names, truth=cloud, status=2))
        self.assertIn("1 point, 1 places without a measurement, 1 label", run("check", cloud).stdout)
        cloud.write_bytes(cloud.read_bytes()[:-20])
        self.assertEqual(run("check", cloud).returncode, 2)

    def test_options_of_other_truths_are_refused(self):
        for option in (["--classes", "chair"], ["--against", self.map], ["--image", self.folder / "x.png"],
                       ["--reliability", self.folder / "x.png"], ["--input", self.folder / "lab"]):
            self.assertIn(option[0], self.evaluated(*option, status=2))
        for option in (["--labels", "x.yaml"], ["--transform", "0,0,0,0"]):
            self.assertIn("needs a cloud as truth", self.evaluated(*option, truth=self.folder / "lab" / "truth.hmap", status=2))
        self.assertFalse((self.folder / "x.png").exists())

    def test_recorded_clouds_are_read(self):
        cloud = DATA / "clouds/mOSD/learn0.pcd"
        if not cloud.exists():
            self.skipTest(f"no {cloud}")
        checked = run("check", cloud)
        self.assertEqual(checked.returncode, 0, checked.stderr)
        self.assertRegex(checked.stdout, r"\d+ points, \d+ places without a measurement, \d+ labels")

    def test_semantic_files_are_maps_and_truths(self):
        shape = '- {{name: chair, shape: "POLYGON(({0} 0,{1} 0,{1} 1,{0} 1,{0} 0))"}}\n'
        truth, map_ = self.folder / "truth.yaml", self.folder / "map.yaml"
        truth.write_text(shape.format(0, 1) + shape.format(5, 6))
        map_.write_text(shape.format(0.1, 1.1))
        found = json.loads(self.evaluated("--json", map_=map_, truth=truth))
        self.assertEqual((found["one_to_one"]["precision"], found["one_to_one"]["recall"]), (1, 0.5))
        self.assertAlmostEqual(found["one_to_one"]["distance_m"], 0.1, 9)
        self.assertAlmostEqual(found["one_to_one"]["jaccard_in_place"], 0.9 / 1.1 / 2, 9)
        tables = self.folder / "tables"
        self.evaluated("--csv", tables, map_=map_, truth=truth)
        self.assertIn("chair,2,1,0,1", (tables / "classes.csv").read_text())
        self.assertIn("map.yaml: ", self.evaluated(map_=self.folder / "none" / "map.yaml", truth=truth, status=3))

    def test_a_picture_of_both(self):
        picture = self.folder / "plan.png"
        text = self.evaluated("--image", picture, truth=self.folder / "lab" / "truth.hmap")
        self.assertIn("precision", text)
        self.assertEqual(png_size(picture)[0], 1280)
        before = digest(picture)
        self.evaluated("--image", picture, truth=self.folder / "lab" / "truth.hmap")
        self.assertEqual(digest(picture), before)
        self.assertEqual(run("eval", "--map", self.map, "--truth", self.map, "--image", "a.jpg").returncode, 4)
        self.assertEqual(run("eval", "--map", self.map, "--truth", self.map, "--image", self.map).returncode, 4)


if __name__ == "__main__":
    unittest.main(verbosity=1)
