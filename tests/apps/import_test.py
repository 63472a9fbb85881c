#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Maps of several types and tools as one archive.

Usage: import_test.py PROGRAM [unittest args]"""

import json
import pathlib
import shutil
import tempfile
import unittest

from program import digest, run

GRID = """image: {name}.pgm
resolution: 0.5
origin: [-1.0, -0.5, 0.0]
negate: 0
occupied_thresh: 0.65
free_thresh: 0.196
"""
THINGS = """- {name: table, shape: "POLYGON ((0 0, 1 0, 1 1, 0 1, 0 0))"}
- {name: chair, shape: "POLYGON ((2 0, 2.5 0, 2.5 0.5, 2 0.5, 2 0))"}
"""


class Import(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="hypermap-import-"))
        cls.floor, cls.upper = (cls.grid(name, cell) for name, cell in (("floor", 0), ("upper", 254)))
        cls.things = cls.folder / "things.yaml"
        cls.things.write_text(THINGS)
        lab = cls.folder / "lab"
        cls.lab = cls.folder / "lab.hmap"
        cls.tree = cls.folder / "tree.bt"
        steps = [("simulate", "--frames", 20, "--seed", 1, "--detector", "perfect", "--output", lab),
                 ("map", "--input", lab, "--output", cls.lab, "--resolution", 0.1),
                 ("export", cls.lab, "--format", "octomap", "--output", cls.tree)]
        cls.failed = [result.stderr for result in (run(*step) for step in steps) if result.returncode not in (0, 1)]

    @classmethod
    def grid(cls, name, cell):
        (cls.folder / f"{name}.pgm").write_bytes(b"P5 4 2 255\n" + bytes([cell] * 8))
        path = cls.folder / f"{name}.yaml"
        path.write_text(GRID.format(name=name))
        return path

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def setUp(self):
        self.assertEqual(self.failed, [])
        self.output = self.folder / "all.hmap"
        self.output.unlink(missing_ok=True)

    def imported(self, *arguments, status=0):
        result = run("import", *arguments, "--output", self.output)
        self.assertEqual(result.returncode, status, result.stdout + result.stderr)
        return result

    def layers(self, archive=None):
        listed = json.loads(run("info", archive or self.output, "--json").stdout)["layers"]
        return {layer["name"]: layer for layer in listed}

    def values(self, layer, point, *more):
        found = json.loads(run("query", self.output, "--layer", layer, "--at", point, *more, "--json").stdout)
        return [one["value"] for one in found["results"]]

    def test_files_of_other_tools_become_layers(self):
        told = self.imported(self.floor, self.things, self.tree)
        self.assertIn("floor: OccupancyGridLayer in frame map", told.stdout)
        layers = self.layers()
        self.assertEqual(list(layers), ["floor", "things", "tree"])
        self.assertEqual(layers["floor"]["cells"]["occupied"], 8)
        self.assertEqual(layers["things"]["objects"], 2)
        self.assertGreater(layers["tree"]["leaves"]["occupied"], 100)
        self.assertEqual(run("check", "--strict", self.output).returncode, 0)
        provenance = json.dumps(json.loads(run("info", self.output, "--json").stdout)["provenance"])
        for name in ("floor.yaml", "things.yaml", "tree.bt", "xxh3-128:"):
            self.assertIn(name, provenance)

    def test_frames_are_known_by_their_transforms(self):
        self.imported(f"ground={self.floor}", f"first={self.upper}", self.things, "--frame", "first=second",
                      "--transform", "map,second,10,0,90")
        self.assertEqual({name: layer["frame_id"] for name, layer in self.layers().items()},
                         {"ground": "map", "first": "second", "things": "map"})
        # (0.6, -0.3) of `second` is turned by 90 degrees and moved: (10.3, 0.6) of `map`.
        in_map = self.values("first", "10.3,0.6", "--frame", "map")
        self.assertEqual(in_map, self.values("first", "0.6,-0.3", "--frame", "second"))
        self.assertEqual(len(in_map), 1)

    def test_archives_come_together(self):
        self.imported(self.floor, self.things)
        flat = self.folder / "flat.hmap"
        self.output.rename(flat)
        self.imported(flat, self.lab)
        both = self.layers()
        self.assertEqual(set(both), set(self.layers(flat)) | set(self.layers(self.lab)))
        query = ("--layer", "objects", "--string", "chair", "--json")
        self.assertEqual(run("query", self.output, *query).stdout, run("query", self.lab, *query).stdout)
        said, before = (json.loads(run("info", path, "--json").stdout) for path in (self.output, self.lab))
        self.assertEqual(said["sessions"], before["sessions"])
        imported = [one for one in said["provenance"]["earlier"] if "import" in one["options"]]
        self.assertEqual({one["input"]: one["options"]["import"]["layers"] for one in imported},
                         {"flat.hmap": ["floor", "things"], "floor.yaml": ["floor"], "things.yaml": ["things"],
                          self.lab.name: [*self.layers(self.lab)][:2] + ["octree", "objects", "topological_map"]})
        self.assertNotIn("session", run("query", self.output, "--why", "1").stdout)
        self.imported(flat, f"other={flat}", "--frame", "other=yard", status=1)
        self.assertEqual({name: layer["frame_id"] for name, layer in self.layers().items()},
                         {"floor": "map", "things": "map", "other_floor": "yard", "other_things": "yard"})

    def test_an_archive_alone_is_itself(self):
        self.imported(self.lab)
        self.assertEqual(digest(self.output), digest(self.lab))

    def test_a_bare_configuration_brings_its_files(self):
        config = self.folder / "config.yaml"
        config.write_text("layers:\n- {class: OccupancyGridLayer, frame_id: map, name: plan, file: floor, load_file: true}\n"
                          f"- {{class: SemanticLayer, frame_id: map, name: named, file: {self.things}, load_file: true}}\n")
        self.imported(config)
        self.assertEqual(list(self.layers()), ["plan", "named"])

    def test_a_frame_that_nothing_connects_is_told(self):
        told = run("import", self.floor, f"first={self.upper}", "--frame", "first=second", "--output", self.output)
        self.assertEqual(told.returncode, 1, told.stderr)
        self.assertIn("lies in frame second, which no transform connects with another one", told.stderr)
        self.assertNotIn("frame map", told.stderr)

    def test_what_cannot_be_a_part_is_refused_and_nothing_is_written(self):
        image = self.folder / "floor.pgm"
        cut = self.folder / "cut.bt"
        cut.write_bytes(self.tree.read_bytes()[:-5])
        cases = (([image], 2, "floor.pgm: is a file of kind image, which is no part of a map"),
                 ([self.floor, self.folder / "none.yaml"], 3, "none.yaml"),
                 ([self.floor, cut], 2, "cut.bt"),
                 ([self.floor, self.floor], 2, "has a layer floor, as another file has: NAME=FILE"),
                 ([self.lab, self.lab], 2, "only one map can bring them"),
                 ([f"x={self.lab}"], 2, "keeps its names and its frame"),
                 ([f"a/b={self.floor}"], 2, "a/b"),
                 ([self.floor, "--frame", "flor=x"], 4, "--frame"),
                 ([self.floor, "--transform", "map,x,1,2"], 4, "--transform"),
                 ([self.floor, "--transform", "map,map,1,2,3"], 2, "--transform: the frames are connected already"),
                 ([f"={self.floor}"], 4, "files: must be FILE or NAME=FILE, is '="),
                 ([], 4, "files"))
        for arguments, status, told in cases:
            with self.subTest(arguments=arguments):
                result = run("import", *arguments, "--output", self.output)
                self.assertEqual(result.returncode, status, result.stdout + result.stderr)
                self.assertIn(told, result.stderr)
                self.assertFalse(self.output.exists())
        self.assertEqual(run("import", self.floor, "--output", self.floor).returncode, 4)


if __name__ == "__main__":
    unittest.main()
