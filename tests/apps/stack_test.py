#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Maps as semantic occupancy grids, their supercells and the graph of them. Usage: stack_test.py PROGRAM [unittest args]"""

import json
import pathlib
import re
import shutil
import unittest

from program import run, tree_digest
from stack_lab import NUM_FRAMES, StackLab


class Stacks(StackLab):
    def test_a_stack_has_a_layer_for_each_class_grid(self):
        stack = self.answer("stack")
        self.assertEqual([layer["name"] for layer in stack["layers"]],
                         [f"/ism/{name}" for name in self.classes_with_a_grid()])
        self.assertGreater(len(stack["layers"]), 1)
        for layer in [*stack["layers"], stack["combined"]]:
            self.assertEqual(layer["occupied"] + layer["free"] + layer["unknown"], stack["cols"] * stack["rows"])
            self.assertGreater(layer["occupied"], 0)
        self.assertGreaterEqual(stack["combined"]["occupied"], max(layer["occupied"] for layer in stack["layers"]))
        yamls = [path for path in stack["files"] if path.endswith(".yaml")]
        self.assertEqual(len(yamls), len(stack["layers"]) + 1)
        for path in yamls:
            self.assertEqual(run("check", path).returncode, 0, path)

    def test_counts_are_those_of_the_written_maps(self):
        stack = self.answer("stack")
        for layer in [*stack["layers"], stack["combined"]]:
            path = next(p for p in stack["files"] if pathlib.Path(p).name == layer["name"].split("/")[-1] + ".yaml")
            yaml = dict(line.split(": ", 1) for line in pathlib.Path(path).read_text().splitlines())
            image = pathlib.Path(path).with_name(yaml["image"].strip("\"'")).read_bytes()
            pixels = image[-stack["cols"] * stack["rows"]:]
            occupied = sum((255 - p) / 255 > float(yaml["occupied_thresh"]) for p in pixels)
            free = sum((255 - p) / 255 < float(yaml["free_thresh"]) for p in pixels)
            self.assertEqual(layer["map"], {"occupied": occupied, "free": free, "unknown": len(pixels) - occupied - free})
        told = run("stack", self.archive, "--output", self.folder / "stack").stdout
        last, counts = stack["combined"], stack["combined"]["map"]
        self.assertIn(f"combined (maximum): {last['occupied']} cells occupied, {last['free']} free, {last['unknown']} unknown; "
                      f"in its map {counts['occupied']}, {counts['free']}, {counts['unknown']}\n", told)

    def test_progress_is_shown_layer_by_layer(self):
        for command in ("stack", "cells"):
            told = run("--progress", "always", command, self.archive, "--output", self.folder / command).stderr
            count = len(self.classes_with_a_grid())
            self.assertIn(f"cutting out layers {count}/{count} (100 %)", told)

    def test_what_has_no_class_is_said_unless_occupancy_is_fused(self):
        result = run("stack", self.archive, "--output", self.folder / "a", "--json")
        without = json.loads(result.stdout)["cells_without_class"]
        # Each occupied cell of the map has a class or has none.
        occupied = next(layer for layer in json.loads(run("info", self.archive, "--json").stdout)["layers"]
                        if layer["name"] == "occupancy")["cells"]["occupied"]
        self.assertEqual(without, occupied - json.loads(result.stdout)["combined"]["occupied"])
        self.assertGreater(without, 0)
        self.assertRegex(result.stderr, rf"^stack: what is occupied in {without} cells of the map has no class")
        self.assertEqual(result.returncode, 0)
        fused = run("stack", self.archive, "--output", self.folder / "b", "--fuse", "occupancy", "--json")
        self.assertEqual(fused.stderr, "")
        self.assertNotIn("cells_without_class", json.loads(fused.stdout))
        way = run("cells", self.archive, "--output", self.folder / "c", "--path=-1,-1,1,1")
        self.assertIn(f"cells: what is occupied in {without} cells", way.stderr)

    def test_a_sum_that_has_less_than_one_layer_is_said(self):
        result = run("stack", self.archive, "--output", self.folder / "a", "--pool", "bayesian", "--json")
        stack = json.loads(result.stdout)
        most = max(stack["layers"], key=lambda layer: layer["occupied"])
        self.assertLess(stack["combined"]["occupied"], most["occupied"])
        self.assertIn(f"where {most['name']} has {most['occupied']}: what other layers say against a cell outvotes it; --pool maximum", result.stderr)
        self.assertEqual(result.returncode, 0)
        self.assertNotIn("outvotes", run("stack", self.archive, "--output", self.folder / "b").stderr)

    def test_pose_size_resolution_and_layers_are_those_asked_for(self):
        name = self.classes_with_a_grid()[0]
        stack = self.answer("stack", "--area=-1,-1,1,0.5", "--yaw", 90, "--resolution", 0.25, "--layer", name,
                            "--rule", "bilinear", "--epsilon", 0.05, "--pool", "bayesian")
        self.assertEqual((stack["cols"], stack["rows"], stack["resolution_m"]), (8, 6, 0.25))
        self.assertEqual(stack["origin"][:2], [-1, -1])
        self.assertAlmostEqual(stack["origin"][2], 1.5707963, 6)
        self.assertEqual([layer["name"] for layer in stack["layers"]], [f"/ism/{name}"])
        self.assertEqual(stack["combined"] | {"name": ""}, stack["layers"][0] | {"name": ""})

    def test_tiles_are_the_map_that_they_were_made_of(self):
        tiles = self.folder / "tiles"
        made = run("export", self.archive, "--format", "tiles", "--output", tiles)
        self.assertEqual(made.returncode, 0, made.stderr)
        self.assertEqual(sorted(made.stdout.splitlines()), sorted(map(str, tiles.iterdir())))
        stack = self.answer("stack")
        x, y = stack["origin"][:2]
        area = f"--area={x},{y},{x + stack['cols'] * 0.1},{y + stack['rows'] * 0.1}"
        for command in ("stack", "cells"):
            ours = run(command, "--tiles", tiles, area, "--output", self.folder / f"{command}-of-tiles", "--json")
            self.assertEqual(ours.returncode, 0, ours.stderr)
            of_map = self.answer(command)
            of_map.pop("cells_without_class", None)  # tiles do not know
            self.assertEqual(json.loads(ours.stdout) | {"files": []}, of_map | {"files": []})
        kept = self.folder / "kept.hmap"
        whole = json.loads(run("stack", "--tiles", tiles, "--output", self.folder / "whole", "--archive", kept, "--json").stdout)
        again = run("stack", kept, "--from", "stack", "--output", self.folder / "again", "--json")
        self.assertEqual(json.loads(again.stdout)["layers"], whole["layers"], again.stderr)
        self.assertEqual((whole["cols"] % 256, whole["rows"] % 256), (0, 0))
        self.assertEqual([layer["occupied"] for layer in whole["layers"]], [layer["occupied"] for layer in stack["layers"]])
        self.assertEqual(run("check", *tiles.iterdir()).returncode, 0)
        told = json.loads(run("info", tiles, "--json").stdout)
        self.assertEqual([layer["name"] for layer in told["layers"]], ["tiles"])
        self.assertIn(f"folder of {len(list(tiles.iterdir()))} tiles", run("check", tiles).stdout)
        first = min(tiles.iterdir())
        first.rename(tiles / "room.tile")
        renamed = run("check", tiles)
        self.assertEqual(renamed.returncode, 1)
        self.assertIn(f"room.tile: name: a folder of tiles with it is refused, by its content it must be called {first.name}",
                      renamed.stdout)

    def test_tiles_of_the_public_implementation_are_read(self):
        tiles = self.folder / "tiles"
        tiles.mkdir()
        for second, x, cells in ((1, 0, b"\x10\xf0\x00\x20"), (2, 2, b"\x10\x10\x10\x10")):
            name = (f"What_OGM_T_{second}.000000000s.ns_Format_INT8_Unit_logodds_Layer_-amiro6-ism-cam_Res_1000mm_X_{x}m_Y_0m_"
                    "Z_0m_rows_2_cols_2_lat_nan_lon_nan_alt_nan_.bin")
            (tiles / name).write_bytes(cells)
            self.assertIn("2 x 2 cells", run("check", tiles / name).stdout)
        stack = json.loads(run("stack", "--tiles", tiles, "--output", self.folder / "out", "--json").stdout)
        self.assertEqual((stack["cols"], stack["rows"], stack["resolution_m"]), (4, 2, 1))
        self.assertEqual(stack["layers"], [{"name": "/ism/amiro6/ism/cam", "occupied": 6, "free": 1, "unknown": 1,
                                            "map": {"occupied": 6, "free": 0, "unknown": 2}}])
        (tiles / name).write_bytes(b"\x10")
        for command in (["stack", "--tiles", tiles, "--output", self.folder / "out2"], ["check", tiles / name]):
            result = run(*command)
            self.assertEqual(result.returncode, 2)
            self.assertIn("has 1 bytes, expected 2 x 2 x 1 = 4", result.stdout + result.stderr)
        self.assertFalse((self.folder / "out2").exists())

    def test_an_occupancy_layer_is_fused_by_its_weight(self):
        stack = self.answer("stack", "--fuse", "occupancy=0.5", "--keep-share", 0.9)
        self.assertIn("/ism/occupancy", [layer["name"] for layer in stack["layers"]])

    def test_cells_are_shown_listed_and_connected(self):
        cells = self.answer("cells", "--cell-weighted", "--levels", 2, "--of", self.classes_with_a_grid()[0])
        self.assertLess(cells["energy"], cells["first_energy"])
        self.assertGreater(cells["moves"], 0)
        image, dot, geojson = map(pathlib.Path, cells["files"])
        self.assertEqual(image.read_bytes()[:4], b"\x89PNG")
        nodes = re.findall(r"^  (\d+) \[", dot.read_text(), re.MULTILINE)
        self.assertEqual(nodes, [str(i) for i in range(cells["supercells"])])
        features = json.loads(geojson.read_text())["features"]
        points = [feature for feature in features if feature["geometry"]["type"] == "Point"]
        self.assertEqual(len(points), cells["supercells"])
        self.assertGreater(len(cells["of"]), 0)
        shown = {name for point in points for name, says in point["properties"]["layers"].items() if says["mean"] > 0}
        says_yes = {layer["name"] for layer in self.answer("stack")["layers"] if layer["occupied"] > 0}
        self.assertEqual(set(cells["without_supercell"]), says_yes - shown)
        for number in cells["of"]:
            layer = points[number]["properties"]["layers"][f"/ism/{self.classes_with_a_grid()[0]}"]
            self.assertGreaterEqual(layer["probability"], 0.5)
        # The neighbours of each node are those of the lines.
        lines = {(f["properties"]["from"], f["properties"]["to"]) for f in features[len(points):]}
        listed = {(i, k) for i, point in enumerate(points) for k in point["properties"]["neighbours"] if i < k}
        self.assertEqual(lines, listed)

    def test_one_supercell_is_counted_in_the_singular(self):
        said = run("cells", self.archive, "--output", self.folder / "cells", "--levels", 10).stdout
        self.assertIn("1 supercell, 0 moves", said)

    def test_a_way_leads_from_neighbour_to_neighbour(self):
        points = []
        cells = self.answer("cells", "--path=-1,-1,1,1")
        features = json.loads(pathlib.Path(cells["files"][2]).read_text())["features"]
        points = [feature["properties"] for feature in features[:cells["supercells"]]]
        way = cells["path"]["supercells"]
        self.assertGreater(len(way), 2)
        for here, after in zip(way, way[1:]):
            self.assertIn(after, points[here]["neighbours"])
        straight = self.answer("cells", "--path=-1,-1,-1,-1")["path"]
        self.assertEqual((len(straight["supercells"]), straight["length_m"]), (1, 0))
        avoiding = self.answer("cells", "--path=-1,-1,1,1", "--fuse", "occupancy", "--avoid", "occupancy")["path"]
        self.assertGreaterEqual(avoiding["length_m"], 2.0)

    def test_what_is_made_is_kept_in_an_archive(self):
        kept = self.folder / "kept.hmap"
        made = self.answer("stack", "--resolution", 0.2, "--archive", kept)
        self.assertEqual(made["files"][-1], str(kept))
        result = run("stack", kept, "--from", "stack", "--output", self.folder / "again", "--json")
        self.assertEqual(json.loads(result.stdout)["layers"], made["layers"], result.stderr)
        with_cells = self.folder / "cells.hmap"
        result = run("cells", kept, "--from", "stack", "--output", self.folder / "cells", "--archive", with_cells, "--json")
        cells = json.loads(result.stdout)
        layers = {layer["name"]: layer for layer in json.loads(run("info", with_cells, "--json").stdout)["layers"]}
        self.assertEqual(layers["stack"]["class"], "GridStackLayer")
        self.assertEqual(layers["stack"]["cells"]["occupied"], made["combined"]["occupied"])
        self.assertEqual((layers["supercells"]["class"], layers["supercells"]["objects"]),
                         ("SupercellLayer", cells["supercells"]))
        names = [layer["name"] for layer in made["layers"]]
        self.assertEqual((layers["stack"]["parts"], layers["supercells"]["parts"]), (names, names))
        told = run("info", with_cells).stdout
        self.assertIn(f"{cells['supercells']} supercells", told)
        self.assertIn(f"stack on {len(names)} layers: {', '.join(names)}", told)
        name = self.classes_with_a_grid()[0]
        found = json.loads(run("query", with_cells, "--layer", "stack", "--string", name, "--json").stdout)
        self.assertEqual(len(found["results"]),
                         next(layer["occupied"] for layer in made["layers"] if layer["name"] == f"/ism/{name}"))
        self.assertEqual(run("check", with_cells).returncode, 0)

    def test_frames_are_fused_as_further_layers(self):
        frames = ["--input", self.shared / "lab", "--sensor", "depth,detections=0.5"]
        stack = self.answer("stack", *frames)
        layers = {layer["name"]: layer for layer in stack["layers"]}
        self.assertEqual(stack["sensed"]["frames"], NUM_FRAMES)
        self.assertGreater(layers["/ism/depth"]["occupied"], 0)
        self.assertGreater(layers["/ism/depth"]["free"], layers["/ism/depth"]["occupied"])
        detected = [name for name in layers if name.startswith("/ism/detections/")]
        self.assertGreater(len(detected), 0)
        for name in detected:
            self.assertGreater(layers[name]["occupied"], 0)
        one = self.answer("stack", *frames, "--layer", detected[0].removeprefix("/ism/"))
        self.assertEqual([layer["name"] for layer in one["layers"]], [detected[0]])
        # What depth calls occupied the map, made of the same frames, does not call free, but where things end.
        both = self.answer("stack", *frames, "--fuse", "occupancy", "--layer", "depth,occupancy", "--pool", "bayesian")
        self.assertEqual(sorted(layer["name"] for layer in both["layers"]), ["/ism/depth", "/ism/occupancy"])
        again = self.answer("stack", *frames)
        self.assertEqual(again["layers"], stack["layers"])

    def test_detections_are_those_that_are_named_and_none_is_said(self):
        dataset = self.folder / "lab"
        shutil.copytree(self.shared / "lab", dataset)
        found = next(path for path in dataset.iterdir() if path.name in ("detections.json", "detections.jsonl"))
        named = found.rename(dataset / f"detections_own{found.suffix}")
        flags = ["--input", dataset, "--sensor", "detections", "--stride", 4]
        nothing = run("stack", self.archive, "--output", self.folder / "none", *flags)
        self.assertEqual(nothing.returncode, 0, nothing.stderr)
        self.assertIn("--sensor detections: nothing was detected in the frames fused", nothing.stderr)
        self.assertIn(f"not used: {named.name} in the input; --detections names it", nothing.stderr)
        layers = self.answer("stack", *flags, "--detections", named)["layers"]
        self.assertTrue([layer for layer in layers if layer["name"].startswith("/ism/detections/")])

    def test_frames_are_registered_to_a_layer(self):
        stack = self.answer("stack", "--input", self.shared / "lab", "--fuse", "occupancy", "--register", "occupancy",
                            "--max-shift", 0.3, "--first", 6, "--max-frames", 3)
        sensed = stack["sensed"]
        self.assertEqual(sensed["frames"], 3)
        self.assertGreater(sensed["registered"], 0)
        self.assertEqual(sensed["registered"] + sum(sensed["refused"].values()), sensed["frames"])
        self.assertLessEqual(sensed["max_shift_m"], 0.45)

    def test_a_map_keeps_a_stack_when_told_to(self):
        own = self.folder / "own.hmap"
        dataset = self.shared / "lab"
        result = run("map", "--input", dataset, "--resolution", 0.1, "--stack", "--output", own)
        self.assertEqual(result.returncode, 0, result.stderr)
        whole = self.answer("stack")
        result = run("stack", own, "--from", "stack", "--output", self.folder / "own", "--json")
        self.assertEqual(json.loads(result.stdout)["layers"], whole["layers"], result.stderr)

    def test_the_same_map_gives_the_same_bytes(self):
        for command in ("stack", "cells"):
            digests = set()
            for turn in ("a", "b"):
                result = run(command, self.archive, "--output", self.folder / turn / command)
                self.assertEqual(result.returncode, 0, result.stderr)
                digests.add(tree_digest(self.folder / turn / command))
            self.assertEqual(len(digests), 1, command)


if __name__ == "__main__":
    unittest.main(verbosity=1)
