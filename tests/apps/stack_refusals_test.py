#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What stack and cells refuse, what they leave of it, and how they say it. Usage: stack_refusals_test.py PROGRAM [unittest args]"""

import json
import re
import shutil
import unittest

from program import run, tree_digest
from stack_lab import StackLab


class Refusals(StackLab):
    def test_wrong_sensors_inputs_and_references_are_named(self):
        dataset = self.shared / "lab"
        for arguments, status, said in ((["--sensor", "depth"], 4, "--input"),
                                        (["--input", dataset, "--sensor", "sonar"], 4, "--sensor: must be one of depth, detections"),
                                        (["--input", dataset, "--sensor", "depth=-1"], 4, "is 'depth=-1'"),
                                        (["--input", dataset, "--min-height", -1, "--max-height", 0.05], 4,
                                         "--max-height: with --input it must be above 0.05"),
                                        (["--input", dataset, "--stride", 6, "--register", self.classes_with_a_grid()[0],
                                          "--max-shift", 0.001], 2, "--register: none of 2 frames could be placed on"),
                                        (["--input", dataset, "--max-shift", 1], 4, "--register"),
                                        (["--input", dataset, "--register", "nothing"], 2, "nothing"),
                                        (["--input", self.folder, "--stride", 2], 2, str(self.folder))):
            result = run("stack", self.archive, "--output", self.folder / "out", *arguments)
            self.assertEqual(result.returncode, status, (arguments, result.stderr))
            self.assertIn(said, result.stderr)
        moved = self.folder / "renamed"
        shutil.copytree(dataset, moved)
        result = run("stack", self.archive, "--output", self.folder / "out", "--input", moved)
        self.assertIn(result.returncode, (0, 2))

    def test_either_a_map_or_tiles_are_asked_for(self):
        tiles = self.folder / "tiles"
        tiles.mkdir()
        output = ["--output", self.folder / "x"]
        for arguments, status, told in (([], 4, "FILE: a map, or --tiles FOLDER, must be named"),
                                        ([tiles], 4, "FILE: is a folder, not a map: --tiles takes one of tiles"),
                                        ([self.archive, "--tiles", ""], 4, "--tiles: is empty"),
                                        ([self.archive, "--tiles", tiles], 4, f"of the file '{self.archive}' or of tiles, not of both"),
                                        (["--tiles", tiles, "--class", "chair"], 4, "--class"),
                                        (["--tiles", tiles, "--fuse", "occupancy"], 4, "--fuse"),
                                        (["--tiles", tiles, "--min-height", 1], 4, "--min-height"),
                                        (["--tiles", tiles], 2, "has no tiles"), (["--tiles", tiles / "none"], 3, "none: cannot list")):
            with self.subTest(arguments):
                result = run("stack", *arguments, *output)
                self.assertEqual(result.returncode, status, result.stdout + result.stderr)
                self.assertIn(told, result.stderr)
                self.assertFalse((self.folder / "x").exists())
        result = run("stack", "--tiles", tiles, "--output", tiles)
        self.assertEqual(result.returncode, 4, result.stderr)

    def test_a_smaller_area_is_proposed_where_it_helps(self):
        for x_m, side, is_one_tile in ((0, 2_000_000_000, True), (100_000, 1, False)):
            tiles = self.folder / f"tiles-{side}"
            tiles.mkdir()
            for place, cells in ((0, 1), (x_m, side)):
                name = (f"What_OGM_T_{place}.0s.ns_Format_INT8_Unit_logodds_Layer_-cam_Res_10mm_X_{place}m_Y_{place}m_Z_0m"
                        f"_rows_{cells}_cols_{cells}_.bin")
                (tiles / name).write_bytes(b"\x20")
            with self.subTest(side):
                result = run("stack", "--tiles", tiles, "--output", self.folder / "x")
                self.assertEqual(result.returncode, 2, result.stdout + result.stderr)
                self.assertEqual("--area takes a part of it" in result.stderr, not is_one_tile, result.stderr)

    def test_what_is_not_there_is_said(self):
        output = ["--output", self.folder / "x"]
        for arguments, status, told in ((["stack", "--class", "chiar"], 2, "chair"), (["stack", "--fuse", "ocupancy"], 2, "occupancy"),
                                        (["stack", "--layer", "chiar"], 2, "--layer: no layer is named \"/ism/chiar\", did you mean \"/ism/chair\""),
                                        (["stack", "--min-height", 5, "--max-height", 6], 2,
                                         "--min-height, --max-height: no voxel lies between heights of 5 and 6 m"),
                                        (["stack", "--class", "zebra"], 2, "--class: no voxel of zebra lies between heights of 0.1 and 1.8 m"),
                                        (["stack", "--area=-1e9,-1e9,1e9,1e9"], 2, "--area, --resolution: '-1e9,-1e9,1e9,1e9' has more than a billion cells of 0.1 m a side"),
                                        (["stack", "--area", "0,0,1e300,1e300"], 2, "--area, --resolution: '0,0,1e300,1e300' has more than a billion cells"),
                                        (["cells", "--known"], 4, "--path"),
                                        (["stack", "--area", "500,500,501,501"], 2, "--area: lies outside: there are cells in -"),
                                        (["stack", "--area", "0,0,0.00000001,1"], 2, "--area: has no cell of 0.1 m"),
                                        (["stack", "--area", "0,0,0,1"], 4, "X0 < X1 and Y0 < Y1, is '0,0,0,1'"), (["stack", "--area", "0,0,1"], 4, "--area"),
                                        (["stack", "--yaw", 3], 4, "--area"), (["stack", "--rule", "cubic"], 4, "biodds"),
                                        (["stack", "--epsilon", 0.5], 4, "0.5"), (["stack", "--fuse", "a=b"], 4, "NAME=WEIGHT"),
                                        (["stack", "--fuse", "occupancy=-1"], 4, "--fuse: WEIGHT must be above 0 and at most 1000, is 'occupancy=-1'"), (["stack", "--pool", "mean"], 4, "maximum"),
                                        (["cells", "--levels", 0], 4, "1 .. 10"), (["cells", "--path", "0,0,1"], 4, "--path"),
                                        (["cells", "--path", "0,0,500,0"], 2, "--path: no cell is at 500,0, there are cells in -"), (["cells", "--of", "chiar"], 2, "--of: no layer is named \"/ism/chiar\", did you mean \"/ism/chair\""),
                                        (["cells", "--avoid", "chair"], 4, "--path"),
                                        (["stack", "--from", "semantic"], 2, "no stack"),
                                        (["stack", "--from", "stakc"], 2, "--from: no layer is named \"stakc\""),
                                        (["stack", "--from", "stack", "--class", "chair"], 4, "--class"),
                                        (["stack", "--class", "table"], 2, "did you mean \"diningtable\"? (80 are known: tvmonitor, person, "),
                                        (["stack", "--fuse", "semantic"], 2,
                                         "--fuse: layer semantic is a SemanticLayer, no occupancy grid"),
                                        (["stack", "--fuse", "occupancy=0"], 4, "is 'occupancy=0'"),
                                        (["stack", "--fuse", "occupancy=1001"], 4, "is 'occupancy=1001'"),
                                        (["stack", "--fuse", "=1"], 4, "NAME=WEIGHT"),
                                        (["stack", "--min-height", 2, "--max-height", 1], 4,
                                         "--max-height: must be above --min-height (2), is 1"),
                                        (["cells", "--path", "0,0,1,1", "--avoid", "chiar"], 2, "--avoid: no layer is named"),
                                        (["cells", "--total", "--cell-weighted"], 4, "--total excludes --cell-weighted"),
                                        (["stack", "--archive", self.archive], 4, "--archive"),
                                        (["cells", "--archive", self.folder / "x.zip"], 4, ".hmap")):
            with self.subTest(arguments):
                result = run(arguments[0], self.archive, *arguments[1:], *output)
                self.assertEqual(result.returncode, status, result.stdout + result.stderr)
                self.assertIn(told, result.stderr)
                self.assertFalse((self.folder / "x").exists())

    def test_a_folder_never_holds_maps_of_two_stacks(self):
        grids = self.folder / "grids"
        self.assertEqual(run("stack", self.archive, "--output", grids).returncode, 0)
        less = run("stack", self.archive, "--output", grids, "--class", self.classes_with_a_grid()[0])
        self.assertEqual(less.returncode, 0, less.stderr)
        written = [line for line in less.stdout.splitlines() if line.startswith(str(grids))]
        self.assertEqual(sorted(map(str, grids.iterdir())), sorted(written))
        (grids / "notes.txt").write_text("mine")
        before = tree_digest(grids)
        kept = self.folder / "kept.hmap"
        refused = run("stack", self.archive, "--output", grids, "--archive", kept)
        self.assertEqual(refused.returncode, 2, refused.stderr)
        self.assertIn("'notes.txt' in it is no part of a stack's maps", refused.stderr)
        self.assertEqual(tree_digest(grids), before)
        self.assertFalse(kept.exists(), "nothing is written where one of the outputs is refused")

    def test_cells_stay_out_of_the_maps_of_a_stack(self):
        grids = self.folder / "grids"
        self.assertEqual(run("stack", self.archive, "--output", grids).returncode, 0)
        before = tree_digest(grids)
        refused = run("cells", self.archive, "--output", grids)
        self.assertEqual(refused.returncode, 2, refused.stderr)
        self.assertIn(f"{grids}: holds the maps of 'stack'", refused.stderr)
        self.assertEqual(tree_digest(grids), before)
        self.assertEqual(run("stack", self.archive, "--output", grids).returncode, 0)
        for _ in range(2):  # its own files are replaced
            self.assertEqual(run("cells", self.archive, "--output", self.folder / "cells").returncode, 0)

    def test_datasets_are_no_folders_for_outputs(self):
        dataset = self.folder / "copy"
        shutil.copytree(self.shared / "lab", dataset)
        before = tree_digest(dataset)
        for command, status in ((["stack"], 2), (["cells"], 4), (["export", "--format", "class-grids"], 4)):
            refused = run(command[0], self.archive, *command[1:], "--output", dataset)
            self.assertEqual(refused.returncode, status, (command, refused.stderr))
            self.assertIn(str(dataset), refused.stderr)
        refused = run("tune", "--input", self.shared / "lab", "--frame", 0, "--output", dataset)
        self.assertEqual(refused.returncode, 4, refused.stderr)
        self.assertEqual(tree_digest(dataset), before)

    def test_what_was_written_before_an_error_is_said(self):
        kept = self.folder / "kept.hmap"
        blocked = self.folder / "blocked"
        blocked.write_text("no folder")
        for command in ("stack", "cells"):
            # The archive cannot be written: nothing is.
            failed = run(command, self.archive, "--output", self.folder / command, "--archive", blocked / "a.hmap")
            self.assertEqual(failed.returncode, 3, failed.stderr)
            self.assertFalse((self.folder / command).exists(), command)
        failed = run("cells", self.archive, "--output", blocked, "--archive", kept)
        self.assertEqual(failed.returncode, 3, failed.stderr)
        self.assertIn(f"written before that: {kept}", failed.stderr)
        self.assertTrue(kept.exists())

    def test_ends_of_a_way_in_what_it_avoids_are_said(self):
        cells = ["cells", self.archive, "--output", self.folder / "cells", "--levels", 2]
        self.assertEqual(run(*cells).returncode, 0)
        points = json.loads((self.folder / "cells" / "topometric.local.geojson").read_text())["features"]
        inside = next(point for point in points if point["properties"].get("best_layer"))
        name, (x, y) = inside["properties"]["best_layer"], inside["geometry"]["coordinates"]
        way = [*cells, "--avoid", name]
        result = run(*way, f"--path={x},{y},-1,-1", "--json")
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertRegex(result.stderr, rf"warning: --path: its start .* more probably of {name} than not")
        self.assertEqual(json.loads(result.stdout)["avoided_ends"], ["start"])
        result = run(*way, f"--path=-1,-1,{x},{y}")
        self.assertRegex(result.stderr, rf"warning: --path: its end .* more probably of {name} than not")

    def test_an_end_in_a_cell_to_be_avoided_is_said_where_its_supercell_is_not(self):
        """With one supercell for all, which is free, every occupied cell is such an end."""
        name = self.classes_with_a_grid()[0]
        kept = self.folder / "kept.hmap"
        self.assertEqual(run("stack", self.archive, "--output", self.folder / "grids", "--archive", kept).returncode, 0)
        found = json.loads(run("query", kept, "--layer", "stack", "--string", name, "--json").stdout)["results"]
        x, y = found[0]["position"][:2]
        cells = ["cells", self.archive, "--output", self.folder / "cells", "--levels", 10, "--avoid", name]
        result = run(*cells, f"--path=0,0,{x},{y}", "--json")
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertRegex(result.stderr, rf"warning: --path: its end \S+ lies in a cell that is more probably of /ism/{name} than not, as supercell 0 is not")
        answer = json.loads(result.stdout)
        self.assertEqual((answer["avoided_ends"], answer["avoided_cells"]), (["end"], len(found)))
        told = run(*cells, f"--path=0,0,{x},{y}").stdout
        self.assertRegex(told, rf"its supercells hold {len(found)} cells? more probably of /ism/{name} than not")

    def test_what_a_way_does_not_know_is_said(self):
        """Far below the room nothing was seen: the map of tiles there is unknown."""
        tiles = self.folder / "tiles"
        self.assertEqual(run("export", self.archive, "--format", "tiles", "--output", tiles).returncode, 0)
        cells = ["cells", "--tiles", tiles, "--output", self.folder / "cells", "--path=0,0,10,10", "--json"]
        result = run(*cells)
        self.assertEqual(result.returncode, 1, result.stderr)
        answer = json.loads(result.stdout)
        unknown = answer["unknown_supercells"]
        self.assertGreater(len(unknown), 1)
        self.assertLess(len(unknown), len(answer["path"]["supercells"]))
        self.assertIn(f"warning: --path: {len(unknown)} of the way's {len(answer['path']['supercells'])} supercells", result.stderr)
        self.assertIn("--known leads around them", result.stderr)
        points = json.loads((self.folder / "cells" / "topometric.local.geojson").read_text())["features"]
        says = points[unknown[-1]]["properties"]["layers"]
        self.assertEqual({layer["mean"] for layer in says.values()}, {0})
        result = run(*cells, "--known")
        self.assertEqual((result.returncode, json.loads(result.stdout)["path"]), (1, None), result.stderr)

    def test_the_examples_of_the_help_work(self):
        """On a map of the laboratory; their options are what is tried here, not their files."""
        examples = [line.split() for command in ("stack", "cells") for line in run(command, "--help").stdout.splitlines()
                    if re.match(r" *hypermap (stack|cells) lab.hmap", line)]
        self.assertGreater(len(examples), 3)
        names = {"lab.hmap": self.archive, "lab": self.shared / "lab", "grids": self.folder / "grids", "cells": self.folder / "cells"}
        for _, command, *arguments in examples:
            with self.subTest(arguments):
                result = run(command, *[names.get(argument, argument) for argument in arguments])
                self.assertEqual(result.returncode, 0, result.stderr)
                self.assertEqual([line for line in result.stderr.splitlines() if not line.startswith(f"{command}: ")], [])

    def test_a_turned_stack_says_that_its_maps_are_turned_back(self):
        area = ["--area=-1,-1,1,1", "--output", self.folder / "grids"]
        self.assertIn("turned back by 30.000 degrees and padded", run("stack", self.archive, *area, "--yaw", 30).stdout)
        self.assertNotIn("turned back", run("stack", self.archive, *area).stdout)


if __name__ == "__main__":
    unittest.main(verbosity=1)
