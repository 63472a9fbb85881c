#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Parts of a map and sets of them, and a map seen from another origin.

Usage: parts_test.py PROGRAM [unittest args]"""

import json
import pathlib
import shutil
import tempfile
import unittest

from program import digest, run, tree_digest


class Parts(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="hypermap-parts-"))
        cls.map = cls.folder / "lab.hmap"
        lab = cls.folder / "lab"
        steps = [("simulate", "--frames", 20, "--seed", 1, "--detector", "perfect", "--size", "320x240", "--output", lab),
                 ("map", "--input", lab, "--output", cls.map, "--resolution", 0.1)]
        cls.failed = [result.stderr for result in (run(*step) for step in steps) if result.returncode not in (0, 1)]
        cls.whole = cls.contents(cls.map)

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def setUp(self):
        self.assertEqual(self.failed, [])

    @classmethod
    def contents(cls, archive):
        """Occupied voxels and named objects; free voxels and cells."""
        layers = {layer["name"]: layer for layer in json.loads(run("info", archive, "--json").stdout)["layers"]}
        found = json.loads(run("query", archive, "--layer", "objects", "--string", "*", "--json").stdout)["results"]
        return {"voxels": layers["octree"]["leaves"]["occupied"], "free": layers["octree"]["leaves"]["free"],
                "cells": layers["occupancy"]["cells"]["free"], "objects": {one["id"] for one in found}}

    def test_a_part_has_what_lies_in_the_area(self):
        part = self.folder / "part.hmap"
        cropped = run("crop", self.map, "--area", "0 -9,9 -9,9 9,0 9", "--max-z", 1.0, "--output", part)
        self.assertEqual(cropped.returncode, 0, cropped.stderr)
        inside = self.contents(part)
        self.assertIn(f"{inside['voxels'] + inside['free']} of {self.whole['voxels'] + self.whole['free']} voxels", cropped.stdout)
        self.assertTrue(0 < inside["voxels"] < self.whole["voxels"])
        self.assertTrue(inside["objects"] and inside["objects"] < self.whole["objects"])
        at = ("--layer", "octree", "--at")
        answers = [json.loads(run("query", archive, *at, place, "--json").stdout)["results"]
                   for place in ("1,0,0.05", "-1,0,0.05") for archive in (self.map, part)]
        self.assertEqual([[one["value"] for one in answer] for answer in answers[:2]], [[answers[0][0]["value"]]] * 2)
        self.assertEqual((len(answers[2]), answers[3]), (1, []))
        self.assertEqual(run("check", part).returncode, 0)

    def test_tiles_have_everything_once(self):
        tiles = self.folder / "tiles"
        split = run("split", self.map, "--tile", 2.5, "--output", tiles)
        self.assertEqual(split.returncode, 0, split.stderr)
        index = json.loads((tiles / "tiles.json").read_text())
        self.assertEqual(index["tile_m"], 2.5)
        self.assertEqual({one["file"] for one in index["tiles"]} | {"tiles.json"}, {path.name for path in tiles.iterdir()})
        parts = [self.contents(tiles / one["file"]) for one in index["tiles"]]
        for key in ("voxels", "free", "cells"):
            self.assertEqual(sum(part[key] for part in parts), self.whole[key], key)
        ids = sorted(id for part in parts for id in part["objects"])
        self.assertEqual(ids, sorted(self.whole["objects"]))
        self.assertEqual([one["voxels"] for one in index["tiles"]], [part["voxels"] + part["free"] for part in parts])
        before = tree_digest(tiles)
        self.assertEqual(run("split", self.map, "--tile", 2.5, "--output", tiles).returncode, 0)
        self.assertEqual(tree_digest(tiles), before)

    def test_tiles_answer_as_the_whole_map_and_only_those_are_read_that_the_question_reaches(self):
        tiles = self.folder / "asked"
        self.assertEqual(run("split", self.map, "--tile", 2.5, "--output", tiles).returncode, 0)
        things = ("--layer", "objects")
        asked = [(*things, "--area", "-9 -9,9 -9,9 9,-9 9"), (*things, "--string", "chair"), (*things, "--at", "1,0.5"),
                 ("--nearest", "chair", "--at", "0,0"), ("--layer", "octree", "--at", "1,0.5,0.05"),
                 ("--layer", "occupancy", "--at", "1,0.5"), ("--layer", "semantic", "--area", "0 0,2 0,2 2,0 2")]
        for question in asked:
            whole, parts = (json.loads(run("query", archive, *question, "--json").stdout)["results"] for archive in (self.map, tiles))
            for one in whole + parts:
                for key in ("relations", "sentence", "support"):  # of all objects, not of these tiles alone
                    one.pop(key, None)
            if "octree" in question or "occupancy" in question:
                whole, parts = ([one["value"] for one in answers] for answers in (whole, parts))
            self.assertEqual(parts, whole, question)
        index = json.loads((tiles / "tiles.json").read_text())
        for one in index["tiles"]:
            x0, y0, x1, y1 = one["reach"]
            if not (x0 <= 1 <= x1 and y0 <= 0.5 <= y1):
                (tiles / one["file"]).write_bytes(b"")
        here = run("query", tiles, *things, "--at", "1,0.5", "--json")
        self.assertEqual(here.returncode, 0, here.stderr)
        everywhere = run("query", tiles / "tiles.json", *things, "--string", "chair")
        self.assertEqual(everywhere.returncode, 2, everywhere.stderr)
        self.assertIn("tile_", everywhere.stderr)

    def test_there_and_back_is_the_same_map(self):
        there, back = self.folder / "there.hmap", self.folder / "back.hmap"
        moved = run("transform", self.map, "--by", "1.2,-0.4,0.3,90", "--output", there)
        self.assertEqual(moved.returncode, 0, moved.stderr)
        self.assertEqual(self.contents(there), self.whole)
        # The inverse: turned by -90 degrees, (1.2, -0.4) is (-0.4, -1.2).
        self.assertEqual(run("transform", there, "--by", "0.4,1.2,-0.3,-90", "--output", back).returncode, 0)
        place = ("--layer", "octree", "--at")
        ours, theirs = (json.loads(run("query", archive, *place, "1,0.5,0.05", "--json").stdout)["results"]
                        for archive in (back, self.map))
        self.assertEqual([one["value"] for one in ours], [one["value"] for one in theirs])
        self.assertEqual(run("diff", self.map, back).returncode, 0)
        self.assertEqual(run("diff", self.map, there, "--transform", "0.4,1.2,-0.3,-90").returncode, 0)
        self.assertEqual(run("transform", self.map, "--by", "1,2,3", "--output", back).returncode, 4)
        far = run("transform", self.map, "--by", "2e6,0,0,0", "--output", back)
        self.assertEqual(far.returncode, 2, far.stderr)
        self.assertIn("--by: must shift by at most 1e6 m", far.stderr)

    def test_a_motion_by_nothing_leaves_the_file_as_it_is(self):
        same = self.folder / "same.hmap"
        moved = run("transform", self.map, "--by", "0,0,0,0", "--output", same)
        self.assertEqual(moved.returncode, 0, moved.stderr)
        self.assertEqual(digest(same), digest(self.map))

    def test_a_map_in_tiles_is_told_from_what_info_knows(self):
        tiles = self.folder / "told"
        self.assertEqual(run("split", self.map, "--tile", 2.5, "--output", tiles).returncode, 0)
        for path in (tiles, tiles / "tiles.json"):
            told = run("info", path)
            self.assertEqual(told.returncode, 2, told.stderr)
            self.assertIn("is a map in tiles: query takes it as it is", told.stderr)
        self.assertIn("kind 'tile-set'", run("export", tiles / "tiles.json", "--format", "ply", "--output", self.folder / "x.ply").stderr)

    def test_a_folder_with_anything_else_is_not_replaced(self):
        folder = self.folder / "kept"
        folder.mkdir()
        (folder / "letter.txt").write_text("dear")
        refused = run("split", self.map, "--output", folder)
        self.assertEqual(refused.returncode, 2, refused.stderr)
        self.assertIn("'letter.txt' in it is no tile of a map", refused.stderr)
        self.assertEqual([path.name for path in folder.iterdir()], ["letter.txt"])

    def test_a_part_of_nothing_is_an_empty_map(self):
        part = self.folder / "nothing.hmap"
        cropped = run("crop", self.map, "--area", "90 90,91 90,91 91", "--output", part)
        self.assertEqual(cropped.returncode, 1, cropped.stderr)
        self.assertIn("--area: nothing of the map lies in it", cropped.stderr)
        self.assertEqual(self.contents(part), {"voxels": 0, "free": 0, "cells": 0, "objects": set()})

    def test_wrong_command_lines_are_told_by_their_option(self):
        before = digest(self.map)
        for options, words in ((("--area", "0 0,1 1"), "--area: "), (("--area", "0 0,1 0,x 1"), "--area: "),
                               (("--area", "0 0,1 0,1 1", "--min-z", 2, "--max-z", 1), "--max-z: must be above --min-z (2), is 1")):
            refused = run("crop", self.map, *options, "--output", self.folder / "no.hmap")
            self.assertEqual(refused.returncode, 4, refused.stderr)
            self.assertIn(words, refused.stderr)
        same = run("crop", self.map, "--area", "0 0,1 0,1 1", "--output", self.map)
        self.assertEqual(same.returncode, 4)
        self.assertEqual(run("split", self.map, "--tile", 0, "--output", self.folder / "no").returncode, 4)
        self.assertEqual(digest(self.map), before)


if __name__ == "__main__":
    unittest.main()
