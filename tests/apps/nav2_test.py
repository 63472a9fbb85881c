#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Whole bundles of `export --format nav2`: masks against the shapes that GeoJSON has, by brute force.

Usage: nav2_test.py PROGRAM [unittest args]"""

import json
import math
import re
import unittest

from laboratory import LaboratoryCase
from program import run

EMPTY = "both masks are empty"


class Mask:
    """Values of a mask by the middles of its cells."""

    def __init__(self, yaml):
        said = yaml.read_text(encoding="utf-8")
        self.resolution = float(re.search(r"^resolution: (.*)$", said, re.MULTILINE)[1])
        origin = [float(part) for part in re.search(r"^origin: \[(.*)\]$", said, re.MULTILINE)[1].split(",")]
        image = (yaml.parent / re.search(r"^image: (.*)$", said, re.MULTILINE)[1]).read_bytes()
        magic, size, largest, pixels = image.split(b"\n", 3)
        cols, rows = map(int, size.split())
        assert (magic, largest, len(pixels), origin[2]) == (b"P5", b"255", cols * rows, 0), "another image"
        self.cells = {(origin[0] + (col + 0.5) * self.resolution, origin[1] + (rows - row - 0.5) * self.resolution):
                      pixels[row * cols + col] for row in range(rows) for col in range(cols)}


def way_to_edge(point, a, b):
    (px, py), (ax, ay), (bx, by) = point, a, b
    dx, dy = bx - ax, by - ay
    share = max(0.0, min(1.0, ((px - ax) * dx + (py - ay) * dy) / (dx * dx + dy * dy)))
    return math.hypot(ax + share * dx - px, ay + share * dy - py)


def way_to(point, polygon):
    """0 within the polygon, whose rings are closed."""
    edges = [edge for ring in polygon for edge in zip(ring, ring[1:])]
    inside = False
    for (ax, ay), (bx, by) in edges:
        if (ay > point[1]) != (by > point[1]) and point[0] < ax + (point[1] - ay) * (bx - ax) / (by - ay):
            inside = not inside
    return 0.0 if inside else min(way_to_edge(point, a, b) for a, b in edges)


class Nav2(LaboratoryCase):
    def exported(self, *more, status=0):
        result = run("export", self.map, "--format", "nav2", "--output", self.folder / "nav2", *more)
        self.assertEqual(result.returncode, status, result.stderr)
        return result

    def zones(self, text):
        path = self.folder / "zones.yaml"
        path.write_text(text)
        return path

    def mask(self, name):
        return Mask(self.folder / "nav2" / f"{name}_mask.yaml")

    def shapes_of(self, name):
        path = self.folder / "a.local.geojson"
        self.assertEqual(run("export", self.map, "--format", "geojson", "--class", name, "--output", path).returncode, 0)
        polygons = []
        for feature in json.loads(path.read_text())["features"]:
            geometry = feature["geometry"]
            polygons += geometry["coordinates"] if geometry["type"] == "MultiPolygon" else [geometry["coordinates"]]
        return polygons

    def check_zone(self, mask, value, polygons, distance):
        """All that is within the distance is in the zone, nothing that is farther by more than a cell's diagonal."""
        count = 0
        boxes = [(list(zip(*polygon[0])), polygon) for polygon in polygons]
        reach = distance + 2 * mask.resolution
        for middle, found in mask.cells.items():
            near = [polygon for box, polygon in boxes
                    if all(min(side) - reach <= at <= max(side) + reach for at, side in zip(middle, box))]
            way = min((way_to(middle, polygon) for polygon in near), default=math.inf)
            if found == value:
                count += 1
                self.assertLessEqual(way, distance + mask.resolution * math.sqrt(2), middle)
            else:
                self.assertGreater(way, distance, middle)
        self.assertGreater(count, 10)

    def test_zones_are_around_shapes(self):
        zones = self.zones("zones:\n  Chair: {keepout_m: 0.3, speed_percent: 40, speed_radius_m: 0.6}\n")
        self.assertNotIn(EMPTY, self.exported("--zones", zones).stderr)
        chairs = self.shapes_of("chair")
        self.check_zone(self.mask("keepout"), 0, chairs, 0.3)
        self.check_zone(self.mask("speed"), 40, chairs, 0.6)

    def test_a_map_that_knows_no_kinds_has_them_from_the_shipped_file(self):
        self.exported("--class", "chair")
        self.assertIn(0, self.mask("keepout").cells.values(), "a chair is a seat")
        self.assertIn(70, self.mask("speed").cells.values())
        words = self.folder / "words.yaml"
        words.write_text("aliases:\n  cup: [mug]\n")
        self.assertIn(EMPTY, self.exported("--zones", self.zones("zones: {seat: {keepout_m: 0.1}}\n"),
                                           "--class-names", words, status=1).stderr)

    def test_a_map_without_such_classes_is_told(self):
        told = self.exported("--zones", self.zones("zones:\n  unicorn: {keepout_m: 1}\n  chiar: {keepout_m: 1}\n"), status=1)
        self.assertIn("zones.yaml: unicorn: is no class of the map, nor of its vocabulary\n", told.stderr)
        self.assertIn('zones.yaml: chiar: is no class of the map, nor of its vocabulary, did you mean "chair"?', told.stderr)
        self.assertIn(EMPTY, told.stderr)
        self.assertEqual(set(self.mask("keepout").cells.values()), {254})
        self.assertEqual(set(self.mask("speed").cells.values()), {0})
        self.assertNotIn(EMPTY, self.exported("--class", "chair").stderr)
        self.assertIn(EMPTY, self.exported("--class", "cup").stderr, "chairs have zones, and none is asked for")

    def test_rules_that_are_wrong_are_named_and_nothing_is_written(self):
        self.exported()
        old = (self.folder / "nav2/keepout_mask.pgm").read_bytes()
        wrong = run("export", self.map, "--format", "nav2", "--output", self.folder / "nav2", "--zones",
                    self.zones("zones:\n  chair: {keepout_m: 1000}\n"))
        self.assertEqual(wrong.returncode, 2, wrong.stderr)
        self.assertIn("zones.yaml:2: zones.chair.keepout_m: is '1000'", wrong.stderr)
        other = run("export", self.map, "--format", "ply", "--output", self.folder / "a.ply", "--zones", "z.yaml")
        self.assertEqual(other.returncode, 4, other.stderr)
        self.assertIn("--zones: goes with --format nav2", other.stderr)
        self.assertEqual((self.folder / "nav2/keepout_mask.pgm").read_bytes(), old)


if __name__ == "__main__":
    unittest.main()
