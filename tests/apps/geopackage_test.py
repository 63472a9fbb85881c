#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Whole files of `export --format geopackage`, by a strict reader of ours and, where it is installed, by ogrinfo
(Debian's gdal-bin).

Usage: geopackage_test.py PROGRAM [unittest args]"""

import json
import shutil
import subprocess
import unittest

from geopackage import GeoPackage
from hostile_archives import write_archive
from laboratory import LaboratoryCase
from program import DATA, run

LAYER = "- {{class: SemanticLayer, name: {}, frame_id: {}, load_file: true, file: {}}}\n"
SQUARE = 'shape: "POLYGON((0 0, 2 0, 2 2, 0 2, 0 0))"'
STRANGE = 'K\u00fcche "; DROP TABLE objects; --\n'


class GeoPackages(LaboratoryCase):
    def export(self, *more, name="a.gpkg", archive=None):
        return run("export", archive or self.map, "--format", "geopackage", "--output", self.folder / name, *more)

    def exported(self, *more, **where):
        result = self.export(*more, **where)
        self.assertEqual(result.returncode, 0, result.stderr)
        return self.folder / where.get("name", "a.gpkg")

    def geojson(self):
        path = self.folder / "a.local.geojson"
        self.assertEqual(run("export", self.map, "--format", "geojson", "--output", path).returncode, 0)
        return json.loads(path.read_text(encoding="utf-8"))["features"]

    def test_a_layer_is_a_table_of_the_shapes_that_geojson_has(self):
        rows = GeoPackage(self.exported()).tables["semantic"]
        features = self.geojson()
        self.assertGreater(len(rows), 3)
        self.assertEqual([row["id"] for row in rows], [feature["id"] for feature in features])
        for row, feature in zip(rows, features):
            geometry, said = feature["geometry"], feature["properties"]
            polygons = geometry["coordinates"] if geometry["type"] == "MultiPolygon" else [geometry["coordinates"]]
            rings = [[[tuple(point) for point in ring[:-1]] for ring in polygon] for polygon in polygons]
            self.assertEqual(row["geom"], rings)
            self.assertEqual((row["name"], row["confidence"], row["height_m"]),
                             (said["name"], said["confidence"], said["height_m"]))

    def test_objects_say_when_and_how_often_they_were_seen(self):
        tables = GeoPackage(self.exported()).tables
        self.assertEqual([row["geom"] for row in tables["objects"]], [row["geom"] for row in tables["semantic"]])
        for row in tables["objects"]:
            self.assertLessEqual(row["first_seen_ns"], row["last_seen_ns"])
            self.assertGreater(row["observations"], 0)
            self.assertAlmostEqual(row["top_m"] - row["bottom_m"], row["height_m"], places=9)
        self.assertEqual([row["class"] for row in tables["objects"]], [row["name"] for row in tables["semantic"]])

    def test_only_what_is_asked_for(self):
        tables = GeoPackage(self.exported("--class", "tvmonitor")).tables
        for name in ("objects", "semantic"):
            self.assertEqual({row.get("class", row.get("name")) for row in tables[name]}, {"tvmonitor"})
        self.assertEqual(set(GeoPackage(self.exported("--layer", "semantic")).tables), {"semantic"})

    def strange_map(self):
        """Three layers of shapes whose names are nothing to SQL, or too much."""
        names = [STRANGE.strip(), "GPKG_contents", "Objects"]
        layers = "layers:\n" + "".join(LAYER.format(json.dumps(name), "map", f"layer{i}") for i, name in enumerate(names))
        shape = f"- {{name: {json.dumps(STRANGE)}, id: 7, tags: [{json.dumps(STRANGE)}], {SQUARE}}}\n"
        return write_archive(self.folder / "strange.hmap", [("hmap_config.yaml", layers)] +
                             [(f"layer{i}", shape) for i in range(len(names))])

    def test_names_that_are_nothing_to_sql(self):
        package = GeoPackage(self.exported(archive=self.strange_map()))
        self.assertEqual(set(package.tables),
                         {"k\u00fcche____drop_table_objects__--", "layer_gpkg_contents", "objects-2"})
        for rows in package.tables.values():
            self.assertEqual([(row["id"], row["name"], json.loads(row["tags"])) for row in rows], [(7, STRANGE, [STRANGE])])
            self.assertEqual(rows[0]["geom"], [[[(0, 0), (2, 0), (2, 2), (0, 2)]]])
            self.assertIsNone(rows[0]["height_m"])

    def test_the_same_map_is_the_same_file(self):
        self.assertEqual(self.exported().read_bytes(), self.exported(name="b.gpkg").read_bytes())

    def test_ogrinfo_opens_it(self):
        if shutil.which("ogrinfo") is None:
            self.skipTest("ogrinfo is not installed (gdal-bin)")
        result = subprocess.run(["ogrinfo", "-al", "-so", str(self.exported())], capture_output=True, text=True, check=False)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        count = len(GeoPackage(self.folder / "a.gpkg").tables["objects"])
        objects = result.stdout.split("Layer name: ")[1]
        for said in ("objects\n", "\nGeometry: Multi Polygon\n", f"\nFeature Count: {count}\n", "Cartesian"):
            self.assertIn(said, objects)

    def test_maps_of_others(self):
        maps = sorted((DATA / "hmap").glob("*.hmap")) if DATA.is_dir() else []
        if not maps:
            self.skipTest(f"no maps of others in {DATA}")
        for archive in maps:
            with self.subTest(archive.name):
                result = self.export(name="other.gpkg", archive=archive)
                if result.returncode == 0:
                    GeoPackage(self.folder / "other.gpkg")
                else:
                    self.assertIn("needs a layer of kind SemanticLayer", result.stderr)

    def test_what_cannot_be_written_leaves_the_old_file(self):
        old = self.exported().read_bytes()
        refused = self.export("--class", "unicorn")
        self.assertEqual(refused.returncode, 2, refused.stderr)
        self.assertEqual((self.folder / "a.gpkg").read_bytes(), old)
        missing = self.export(name="none/a.gpkg")
        self.assertEqual(missing.returncode, 3, missing.stderr)
        self.assertIn(str(self.folder / "none"), missing.stderr)
        wrong = self.export(name="a.sqlite")
        self.assertEqual(wrong.returncode, 4, wrong.stderr)
        self.assertIn("must end in .gpkg", wrong.stderr)


if __name__ == "__main__":
    unittest.main()
