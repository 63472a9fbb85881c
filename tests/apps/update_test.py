#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Changes to layers of a map by `hypermap update`, and sub-maps of its grids.

Usage: update_test.py PROGRAM [unittest args]"""

import json
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

from program import PROGRAM, digest, run

SEMANTIC = """- {name: chair, shape: "POLYGON((0 0,1 0,1 1,0 1,0 0))", tags: [wood], confidence: [0.5]}
- {name: table, shape: "POLYGON((2 0,4 0,4 1,2 1,2 0))"}
- {name: cup, shape: "POLYGON((3 0,3.1 0,3.1 0.1,3 0.1,3 0))"}
"""
BATCH = """add:
- {name: sofa, shape: "POLYGON((6 0,8 0,8 1,6 1,6 0))", id: 40}
- {name: plant, shape: "POLYGON((9 0,9.5 0,9.5 1,9 0))"}
modify:
- {id: 1, name: desk}
- {id: 0, shape: "POLYGON((0 5,1 5,1 6,0 6,0 5))"}
delete: [2]
"""
CONFIG = """layers:
- {class: OccupancyGridLayer, name: occupancy, frame_id: map, load_file: true, file: grid}
- {class: SemanticLayer, name: semantic, frame_id: map, load_file: true, file: shapes}
- {class: SemanticLayer, name: fixed, frame_id: map, load_file: true, file: fixed, enable_update: false}
transforms:
- {frame_id: map, child_frame_id: lab, transform_pose: [1, 0, 1.5707963267948966]}
"""


FLAGS = """layers:
- {class: SemanticLayer, name: fed, frame_id: map, load_file: true, file: shapes, subscribe_mode: true}
- {class: SemanticLayer, name: fixed, frame_id: lab, load_file: true, file: fixed, enable_update: false}
- {class: SemanticLayer, name: empty, frame_id: desk, load_file: false, file: shapes, subscribe_mode: true, enable_update: true}
- {class: SemanticLayer, name: shut, frame_id: map, load_file: false, subscribe_mode: false, enable_update: false}
transforms:
- {frame_id: map, child_frame_id: lab, transform_pose: [1, 0, 1.5707963267948966]}
- {frame_id: lab, child_frame_id: desk, transform_pose: [0, 2, 0]}
"""


def grid_yaml(image, origin, resolution=0.5):
    return (f"image: {image}\nresolution: {resolution}\norigin: [{origin[0]}, {origin[1]}, 0]\nnegate: 0\n"
            "occupied_thresh: 0.65\nfree_thresh: 0.196\n")


def pgm(cols, rows, value):
    return f"P5\n{cols} {rows}\n255\n".encode() + bytes([value]) * (cols * rows)


class Updates(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="hypermap-update-"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.write("hmap_config.yaml", CONFIG)
        self.write("shapes", SEMANTIC)
        self.write("fixed", SEMANTIC)
        self.write("grid.yaml", grid_yaml("grid.pgm", (-1, -2)))
        (self.folder / "grid.pgm").write_bytes(pgm(6, 4, 254))  # all free: x from -1 to 2, y from -2 to 0
        self.map = self.folder / "room.hmap"
        self.done("classes", self.folder / "hmap_config.yaml", "--clear", "--output", self.map)

    def write(self, name, text):
        path = self.folder / name
        path.write_text(text)
        return path

    def done(self, *arguments, status=0):
        result = run(*arguments)
        self.assertEqual(result.returncode, status, result.stderr)
        return result.stderr if status else result.stdout

    def refused(self, *arguments, status=2):
        """The error; the map is as it was."""
        before = digest(self.map)
        error = self.done("update", self.map, *arguments, status=status)
        self.assertEqual(digest(self.map), before)
        self.assertEqual(len(error.splitlines()), 1, error)
        return error

    def names(self, archive, layer="semantic"):
        found = json.loads(self.done("query", archive, "--layer", layer, "--string", "*", "--json"))["results"]
        return {one["id"]: one["name"] for one in found}

    def test_a_batch_is_applied_in_place_or_elsewhere(self):
        batch = self.write("batch.yaml", BATCH)
        before = digest(self.map)
        other = self.folder / "other.hmap"
        self.assertEqual(self.done("update", self.map, "--batch", batch, "--output", other),
                         "2 objects added (40, 41), 2 modified, 1 deleted\n")
        self.assertEqual(digest(self.map), before)
        self.assertEqual(self.names(other), {0: "chair", 1: "desk", 40: "sofa", 41: "plant"})
        document = json.loads(self.done("update", self.map, "--batch", batch, "--json"))
        self.assertEqual(document, {"layer": "semantic", "added": [40, 41], "modified": 2, "deleted": 1})
        self.assertEqual(digest(self.map), digest(other))
        at = json.loads(self.done("query", self.map, "--layer", "semantic", "--at", "0.5,5.5", "--json"))["results"]
        self.assertEqual([(one["id"], one["confidence"]) for one in at], [(0, 0.5)])
        self.assertEqual(self.names(self.map, "fixed"), {0: "chair", 1: "table", 2: "cup"})
        self.assertEqual(run("check", self.map).returncode, 0)

    def test_info_tells_the_flags_that_are_not_at_their_default(self):
        self.assertIn("\nfixed: enable_update false\n", self.done("info", self.map))
        self.assertNotIn("subscribe_mode", self.done("info", self.map))
        keys = ("load_file", "subscribe_mode", "enable_update")
        flags = {layer["name"]: [layer[key] for key in keys]
                 for layer in json.loads(self.done("info", self.map, "--json"))["layers"]}
        self.assertEqual(flags, {"occupancy": [True, False, True], "semantic": [True, False, True],
                                 "fixed": [True, False, False]})

    def test_transforms_and_flags_stay_through_load_and_save_and_act(self):
        config = self.write("flags.yaml", FLAGS)
        saved, again = self.folder / "saved.hmap", self.folder / "again.hmap"
        self.done("classes", config, "--clear", "--output", saved)
        self.done("classes", saved, "--clear", "--output", again)
        self.assertEqual(digest(saved), digest(again))
        said, said_again = ({key: json.loads(self.done("info", path, "--json"))[key] for key in ("layers", "transforms")}
                            for path in (config, saved))
        self.assertEqual(said, said_again)
        self.assertEqual([(one["frame_id"], one["child_frame_id"]) for one in said["transforms"]],
                         [("map", "lab"), ("lab", "desk")])
        flags = {one["name"]: (one["load_file"], one["subscribe_mode"], one["enable_update"]) for one in said["layers"]}
        self.assertEqual(flags, {"fed": (True, True, True), "fixed": (True, False, False), "empty": (False, True, True),
                                 "shut": (False, False, False)})
        # load_file: what is not loaded starts empty, though a file of its name lies there.
        self.assertEqual([len(self.names(saved, name)) for name in ("fed", "fixed", "empty", "shut")], [3, 3, 0, 0])
        # enable_update: a layer that is closed stays as it is.
        batch = self.write("batch.yaml", "delete: [2]\n")
        before = digest(saved)
        for name in ("fixed", "shut"):
            error = self.done("update", saved, "--layer", name, "--batch", batch, status=2)
            self.assertIn(f"{name} takes no updates, as its enable_update says", error)
        self.assertEqual(digest(saved), before)
        self.done("update", saved, "--layer", "fed", "--batch", batch)
        self.assertEqual(self.names(saved, "fed"), {0: "chair", 1: "table"})
        # subscribe_mode: told to programs that serve the map.
        told = subprocess.run([str(PROGRAM), "shell", str(saved)], input="republish\n", capture_output=True, text=True,
                              check=True).stdout
        self.assertRegex(told, r"(?m)^fed +SemanticLayer +map +\d+ +yes +yes ")
        self.assertRegex(told, r"(?m)^fixed +SemanticLayer +lab +\d+ +no +no ")
        # The transform acts: x of `desk` is y of `lab`, which lies at (1, 0) of `map`, turned by 90 degrees.
        where = ("query", saved, "--layer", "fed", "--json", "--at")
        found = [json.loads(self.done(*where, *at))["results"] for at in (("0.5,0.5", "--frame", "map"),
                                                                          ("0.5,-1.5", "--frame", "desk"))]
        self.assertEqual([[one["id"] for one in results] for results in found], [[0], [0]])

    def test_a_layer_that_is_not_loaded_cannot_keep_an_update_and_it_is_said_how_it_can(self):
        config = self.folder / "empty.yaml"
        config.write_text("layers:\n- {class: SemanticLayer, name: semantic, frame_id: map, load_file: false}\n")
        batch = self.write("add.yaml", BATCH[:BATCH.index("modify")])
        refused = run("update", config, "--batch", batch, "--output", self.folder / "kept.hmap")
        self.assertEqual(refused.returncode, 2)
        self.assertIn("layer semantic: has content, yet load_file is false, so it would be lost: "
                      "its configuration must say load_file: true", refused.stderr)
        self.assertFalse((self.folder / "kept.hmap").exists())

    def test_what_cannot_be_done_changes_nothing(self):
        batch = self.write("batch.yaml", BATCH)
        self.assertIn("fixed takes no updates, as its enable_update says",
                      self.refused("--layer", "fixed", "--batch", batch))
        self.assertIn("object 7: id: is not in the layer",
                      self.refused("--batch", self.write("a.yaml", "modify: [{id: 1, name: x}]\ndelete: [7]\n")))
        self.assertIn("a.yaml:2: add[0] (x).shape",
                      self.refused("--batch", self.write("a.yaml", "add:\n- {name: x, shape: POLYGON}\n")))
        self.assertIn("layer", self.refused("--layer", "attic", "--batch", batch))
        self.assertIn("occupancy is of class OccupancyGridLayer",
                      self.refused("--layer", "occupancy", "--batch", batch))
        self.assertIn("none.yaml", self.refused("--batch", self.folder / "none.yaml", status=3))

    def test_a_configuration_is_updated_into_an_archive(self):
        batch = self.write("batch.yaml", BATCH)
        config = self.folder / "hmap_config.yaml"
        self.assertIn("is no archive", self.done("update", config, "--batch", batch, status=2))
        other = self.folder / "other.hmap"
        self.done("update", config, "--batch", batch, "--output", other)
        self.assertEqual(self.names(other), {0: "chair", 1: "desk", 40: "sofa", 41: "plant"})

    def test_a_part_of_a_grid_takes_the_place_of_its_cells(self):
        part = self.write("part.yaml", grid_yaml("part.pgm", (0, -1.5)))
        (self.folder / "part.pgm").write_bytes(pgm(2, 1, 0))  # occupied
        self.assertEqual(self.done("update", self.map, "--grid", part),
                         "2 x 1 cells replaced from column 2, row 1 on\n")
        for place, name in (("0.25,-1.25", "Occupied"), ("0.75,-1.25", "Occupied"), ("1.25,-1.25", "Free"),
                            ("0.25,-1.75", "Free"), ("0.25,-0.75", "Free")):
            answer = json.loads(self.done("query", self.map, "--layer", "occupancy", "--at", place, "--json"))
            self.assertEqual([one["name"] for one in answer["results"]], [name], place)
        for origin, resolution, error in (((1.5, -1.5), 0.5, "bounds: reaches from column 5 to 6"),
                                          ((0.1, -1.5), 0.5, "origin: lies 2.2, 1 cells"),
                                          ((0, -1.5), 0.25, "resolution: is 0.25 m")):
            self.write("part.yaml", grid_yaml("part.pgm", origin, resolution))
            self.assertIn(error, self.refused("--grid", part))
        self.assertIn("semantic is of class SemanticLayer", self.refused("--layer", "semantic", "--grid", part))

    def test_a_sub_map_goes_out_and_comes_back(self):
        corner = self.folder / "corner"
        self.done("export", self.map, "--format", "ros-map", "--area", "0.1 -1.9,0.9 -1.9,0.9 -1.6,0.1 -1.6",
                  "--output", corner)
        text = corner.with_suffix(".yaml").read_text()
        self.assertIn("origin: [0, -2, 0]", text)
        image = corner.parent / re.search(r"image: (.*)", text).group(1)
        self.assertEqual(image.read_bytes()[-3:], pgm(2, 1, 254)[-3:])
        before = digest(self.map)
        self.done("update", self.map, "--grid", corner.with_suffix(".yaml"))
        self.assertEqual(digest(self.map), before)
        # The frame lab lies at (1, 0), turned by 90 degrees: its (-1.9, 0.1) is (0.9, -1.9).
        self.done("export", self.map, "--format", "ros-map", "--frame", "lab", "--output", self.folder / "same",
                  "--area", "-1.9 0.1,-1.6 0.1,-1.6 0.9,-1.9 0.9")
        self.assertIn("origin: [0, -2, 0]", (self.folder / "same.yaml").read_text())
        self.assertIn("--area: meets no cell",
                      self.done("export", self.map, "--format", "ros-map", "--area", "50 0,51 0,51 1", "--output", corner,
                                status=2))
        for wrong in (["--format", "ply", "--area", "0 0,1 0,1 1"], ["--format", "ros-map", "--area", "0 0,1 1"],
                      ["--format", "ros-map", "--frame", "lab"]):
            self.done("export", self.map, *wrong, "--output", self.folder / "x", status=4)

    def test_info_tells_how_the_grid_lies(self):
        self.assertIn("occupancy: 6 x 4 cells of 0.5 m from (-1.000, -2.000), turned by 0.00 degrees",
                      self.done("info", self.map))
        layer = json.loads(self.done("info", self.map, "--json"))["layers"][0]
        self.assertEqual(layer["grid"], {"columns": 6, "rows": 4, "resolution_m": 0.5, "origin": [-1, -2, 0]})
        self.assertEqual(layer["bounds"], {"min": [-1, -2], "max": [2, 0]})


if __name__ == "__main__":
    unittest.main(verbosity=1)
