#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Maps of one place by several sessions as one.

Usage: merge_test.py PROGRAM [unittest args]"""

import json
import math
import pathlib
import shutil
import struct
import tempfile
import unittest

from program import run

HALF = 40  # frames
ORIGIN = (0.37, -0.81, 12.0)  # of the turned map in the first one: metres, degrees


def seen_from(line, origin):
    """A pose as one sees it whose origin lies there."""
    x0, y0, degrees = origin
    stamp, x, y, z, qx, qy, qz, qw = map(float, line.split())
    turn = math.radians(degrees)
    c, s, hc, hs = math.cos(turn), math.sin(turn), math.cos(turn / 2), math.sin(turn / 2)
    x, y = c * (x - x0) + s * (y - y0), -s * (x - x0) + c * (y - y0)
    return " ".join(map(repr, (stamp, x, y, z, hc * qx + hs * qy, hc * qy - hs * qx, hc * qz - hs * qw, hc * qw + hs * qz)))


def occupied(archive):
    """Voxels of 0.1 m, by the PLY file of their centres."""
    ply = archive.with_suffix(".ply")
    assert run("export", archive, "--format", "ply", "--output", ply).returncode == 0
    data = ply.read_bytes().split(b"end_header\n", 1)[1]
    size = 3 * 4 + 3 + 2 + 4 + 4
    return {tuple(math.floor(value / 0.1) for value in struct.unpack_from("<3f", data, at))
            for at in range(0, len(data), size)}


def overlap(a, b):
    a, b = occupied(a), occupied(b)
    return len(a & b) / len(a | b)


class Merge(unittest.TestCase):
    """A laboratory in two sessions, and the whole of it in one map."""

    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="hypermap-merge-"))
        cls.data, cls.turned_data = cls.folder / "lab", cls.folder / "turned"
        cls.first, cls.second, cls.whole, cls.turned, cls.both = (
            cls.folder / f"{name}.hmap" for name in ("first", "second", "whole", "turned", "both"))
        cls.failed = []
        cls.succeed("simulate", "--frames", 2 * HALF, "--seed", 3, "--size", "320x240", "--detector", "perfect", "--output", cls.data)
        shutil.copytree(cls.data, cls.turned_data)
        poses = cls.turned_data / "groundtruth.txt"
        poses.write_text("\n".join(line if line.startswith("#") else seen_from(line, ORIGIN)
                                   for line in poses.read_text().splitlines()) + "\n")
        coarse = ("--resolution", 0.1)
        cls.succeed("map", "--input", cls.data, "--output", cls.first, *coarse, "--max-frames", HALF, "--session", "morning")
        cls.succeed("map", "--input", cls.data, "--output", cls.second, *coarse, "--first", HALF, "--session", "noon")
        cls.succeed("map", "--input", cls.data, "--output", cls.whole, *coarse)
        cls.succeed("map", "--input", cls.turned_data, "--output", cls.turned, *coarse, "--first", HALF)
        cls.succeed("merge", cls.first, cls.second, "--output", cls.both)

    @classmethod
    def succeed(cls, *arguments):
        result = run(*arguments)
        cls.failed += [result.stderr] if result.returncode not in (0, 1) else []

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def setUp(self):
        self.assertEqual(self.failed, [])

    def merge(self, *arguments, status=0):
        result = run("merge", *arguments, "--json")
        self.assertEqual(result.returncode, status, f"{arguments}: {result.stdout}{result.stderr}")
        return json.loads(result.stdout)

    def objects(self, archive):
        found = json.loads(run("query", archive, "--layer", "objects", "--json").stdout)["results"]
        return sorted((one["name"], one["position"]) for one in found)

    def assert_same_objects(self, a, b, within_m):
        a, b = self.objects(a), self.objects(b)
        self.assertEqual([name for name, _ in a], [name for name, _ in b])
        for name, place in a:
            self.assertLess(min(math.dist(place, other) for known, other in b if known == name), within_m, name)

    def test_two_halves_are_the_whole(self):
        self.assertGreater(overlap(self.both, self.whole), 0.98)
        self.assert_same_objects(self.both, self.whole, 0.05)
        self.assertEqual(run("check", self.both).returncode, 0)
        info = run("info", self.both).stdout
        self.assertIn("morning", info)
        self.assertIn("noon", info)

    def test_the_order_does_not_matter(self):
        other = self.folder / "other.hmap"
        report = self.merge(self.second, self.first, "--output", other)
        self.assertEqual(other.read_bytes(), self.both.read_bytes())
        self.assertEqual([one["file"] for one in report["maps"]], [str(self.first), str(self.second)])
        self.assertEqual([one["later"] for one in report["maps"]], [False, True])
        self.assertGreater(report["maps"][1]["joined"], 5)
        self.assertEqual(report["sessions"], 2)

    def test_a_map_grows_in_its_own_file(self):
        grown = self.folder / "grown.hmap"
        shutil.copy(self.first, grown)
        told = run("merge", grown, self.second, "--output", grown)
        self.assertEqual(told.returncode, 0, told.stderr)
        self.assertIn("2 sessions", told.stdout)
        self.assertEqual(grown.read_bytes(), self.both.read_bytes())

    def test_a_known_transform_brings_it_back(self):
        placed = self.folder / "placed.hmap"
        transform = "turned={},{},0,{}".format(*ORIGIN)
        self.merge(self.first, self.turned, "--transform", transform, "--output", placed)
        # A voxel of 0.1 m goes to where its centre lies: half of the surfaces move by one.
        self.assertGreater(overlap(placed, self.both), 0.5)
        self.assert_same_objects(placed, self.both, 0.1)

    def test_where_a_map_lies_is_found(self):
        found = self.merge(self.first, self.turned, "--register", "--output", self.folder / "found.hmap")
        placed = found["maps"][1]["registered"]
        self.assertLess(math.hypot(placed["x_m"] - ORIGIN[0], placed["y_m"] - ORIGIN[1]), 0.1, placed)
        self.assertLess(abs(placed["yaw_deg"] - ORIGIN[2]), 1.0, placed)
        self.assertEqual(placed["z_m"], 0.0)

    def test_other_rules_and_a_recording_that_may_count_twice_are_told(self):
        part, output = self.folder / "part.hmap", self.folder / "told.hmap"
        self.succeed("map", "--input", self.data, "--output", part, "--resolution", 0.1, "--max-frames", 10)
        result = run("merge", self.first, part, "--output", output)
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertEqual(result.stderr, f"warning: {part}: has frames of lab of the time of which {self.first} has some: "
                                        "of one recording they count twice\n")
        config = self.folder / "config.yaml"
        config.write_text("association: {min_gain: 0.25}\n")
        result = run("merge", self.first, self.second, "--config", config, "--output", output)
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertEqual(result.stderr.splitlines(), [
            f"warning: {path}: association.min_gain: was 0.05 when the map was made, is 0.25 now: objects are joined by other rules"
            for path in (self.first, self.second)])
        far = run("merge", self.first, self.second, "--transform", "second=2e6,0,0,0", "--output", output)
        self.assertEqual(far.returncode, 2, far.stderr)
        self.assertIn("second.hmap: --transform: must shift by at most 1e6 m", far.stderr)

    def test_what_cannot_be_merged_is_refused_and_nothing_is_written(self):
        output = self.folder / "none.hmap"
        fine = self.folder / "fine.hmap"
        self.succeed("map", "--input", self.data, "--output", fine, "--max-frames", 1, "--first", HALF)
        cases = (([self.first], 4, "must be two or more"),
                 ([self.first, self.first], 2, "frames would count twice"),
                 ([self.first, self.both], 2, "frames would count twice"),
                 ([self.first, fine], 2, "resolution_m: must be that of"),
                 ([self.first, self.folder / "absent.hmap"], 3, "absent.hmap"),
                 ([self.first, self.data / "truth.hmap"], 2, "has no semantic octree"),
                 ([self.first, self.turned, "--transform", "turned=1,2"], 4, "--transform"),
                 ([self.first, self.turned, *2 * ["--transform", "turned=1,2,0,0"]], 4, "places 'turned' twice"),
                 ([self.first, self.turned, "--transform", "nobody=1,2,0,0"], 4, "with one of the maps"),
                 ([self.first, self.turned, "--transform", "first=1,2,0,0"], 4, "is of the first map"))
        for arguments, status, told in cases:
            with self.subTest(arguments=arguments):
                result = run("merge", *arguments, "--output", output)
                self.assertEqual(result.returncode, status, result.stdout + result.stderr)
                self.assertIn(told, result.stderr)
                self.assertFalse(output.exists())


if __name__ == "__main__":
    unittest.main()
