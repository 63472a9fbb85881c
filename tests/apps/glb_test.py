#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Whole scenes of `export --format glb`, by a strict reader of ours and, where it is installed, by the validator of
Khronos (`npm install gltf-validator` in a folder that NODE_PATH names).

Usage: glb_test.py PROGRAM [unittest args]"""

import json
import shutil
import struct
import subprocess
import unittest

from glb import Scene
from laboratory import LaboratoryCase
from program import DATA, run

VALIDATE = """
const validator = require('gltf-validator'), fs = require('fs');
validator.validateBytes(new Uint8Array(fs.readFileSync(process.argv[1])))
  .then(report => console.log(JSON.stringify(report.issues)));
"""
LISTED_VERTEX = "<3f3BHif"  # of a PLY export: place, colour, class, object, confidence


def validator_issues(path):
    """What the validator of Khronos finds; None where it is not installed."""
    if shutil.which("node") is None:
        return None
    result = subprocess.run(["node", "-e", VALIDATE, str(path)], capture_output=True, text=True, check=False)
    return json.loads(result.stdout) if result.returncode == 0 else None


class Scenes(LaboratoryCase):
    def exported(self, *more, name="a.glb", archive=None):
        result = run("export", archive or self.map, "--format", "glb", "--output", self.folder / name, *more)
        self.assertEqual(result.returncode, 0, result.stderr)
        return self.folder / name

    def scene(self, *more):
        return Scene(self.exported(*more).read_bytes())

    def vertices(self):
        """Occupied voxels, from the PLY export."""
        path = self.folder / "a.ply"
        self.assertEqual(run("export", self.map, "--format", "ply", "--output", path).returncode, 0)
        body = path.read_bytes().split(b"end_header\n", 1)[1]
        return list(struct.iter_unpack(LISTED_VERTEX, body))

    def test_each_object_stands_where_its_box_is(self):
        scene = self.scene()
        names = [scene.json["nodes"][child]["name"] for child in scene.nodes["objects"]["children"]]
        self.assertGreater(len(names), 3)
        for name in names:
            extras = scene.nodes[name]["extras"]
            self.assertEqual(name, f"{extras['class']} {extras['id']}")
            for found, said in zip(scene.map_bounds(name), extras["box"]):
                self.assertAlmostEqual(found, said, places=5)

    def test_up_is_y(self):
        scene = self.scene()
        name = next(name for name in scene.nodes if name.startswith("tvmonitor "))
        box = scene.nodes[name]["extras"]["box"]
        heights = [y for part in scene.parts(name) for _, y, _ in part.positions]
        self.assertAlmostEqual(max(heights), box[5], places=5)

    def test_the_surface_is_that_of_the_voxels(self):
        scene = self.scene()
        places = [vertex[:3] for vertex in self.vertices()]
        lows = [min(axis) - 0.025 for axis in zip(*places)]
        highs = [max(axis) + 0.025 for axis in zip(*places)]
        for found, expected in zip(scene.map_bounds("surface"), [*lows, *highs]):
            self.assertAlmostEqual(found, expected, places=4)
        triangles = sum(len(part.indices) // 3 for part in scene.parts("surface"))
        faces = {(round(x / 0.05 - 0.5), round(y / 0.05 - 0.5), round(z / 0.05 - 0.5)) for x, y, z in places}
        exposed = sum((x + dx, y + dy, z + dz) not in faces for x, y, z in faces
                      for dx, dy, dz in ((1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)))
        self.assertLess(triangles, exposed, "merged: fewer than one for two of each face")
        self.assertAlmostEqual(self.area(scene, "surface"), exposed * 0.05 ** 2, delta=1e-3)

    def area(self, scene, name):
        total = 0.0
        for part in scene.parts(name):
            for i in range(0, len(part.indices), 3):
                a, b, c = (part.positions[k] for k in part.indices[i:i + 3])
                u, v = [[q - p for p, q in zip(a, other)] for other in (b, c)]
                cross = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
                total += sum(part * part for part in cross) ** 0.5 / 2
        return total

    def test_voxels_go_to_their_objects(self):
        scene = self.scene("--with-voxels")
        owners = {vertex[7] for vertex in self.vertices() if vertex[7] != 0}
        with_voxels = {node["extras"]["id"] for node in scene.json["nodes"] if f"{node['name']} voxels" in scene.nodes}
        self.assertEqual(with_voxels, owners)
        for name, node in scene.nodes.items():
            if name.endswith(" voxels"):
                parent = scene.json["nodes"][scene.parents[scene.json["nodes"].index(node)]]
                self.assertEqual(f"{parent['name']} voxels", name)

    def test_only_classes_that_are_asked_for(self):
        scene = self.scene("--class", "tvmonitor")
        self.assertEqual({node["extras"]["class"] for node in scene.json["nodes"] if "id" in node.get("extras", {})},
                         {"tvmonitor"})

    def test_the_same_map_is_the_same_file(self):
        self.assertEqual(self.exported().read_bytes(), self.exported(name="b.glb").read_bytes())

    def test_the_validator_of_khronos_agrees(self):
        if validator_issues(self.exported()) is None:
            self.skipTest("gltf-validator is not installed (npm install gltf-validator, NODE_PATH)")
        for more in ([], ["--with-voxels"], ["--class", "tvmonitor"]):
            issues = validator_issues(self.exported(*more))
            self.assertEqual((issues["numErrors"], issues["numWarnings"], issues["numInfos"]), (0, 0, 0), issues)

    def test_maps_of_others(self):
        maps = sorted((DATA / "hmap").glob("*.hmap")) if DATA.is_dir() else []
        if not maps:
            self.skipTest(f"no maps of others in {DATA}")
        for archive in maps:
            with self.subTest(archive.name):
                result = run("export", archive, "--format", "glb", "--output", self.folder / "other.glb")
                if result.returncode == 0:
                    Scene((self.folder / "other.glb").read_bytes())
                else:
                    self.assertIn("neither objects nor an octree", result.stderr)

    def test_what_cannot_be_written_leaves_the_old_file(self):
        old = self.exported().read_bytes()
        refused = run("export", self.map, "--format", "glb", "--class", "unicorn", "--output", self.folder / "a.glb")
        self.assertEqual(refused.returncode, 2, refused.stderr)
        self.assertEqual((self.folder / "a.glb").read_bytes(), old)
        missing = run("export", self.map, "--format", "glb", "--output", self.folder / "none" / "a.glb")
        self.assertEqual(missing.returncode, 3, missing.stderr)
        self.assertIn(str(self.folder / "none"), missing.stderr)


if __name__ == "__main__":
    unittest.main()
