# SPDX-License-Identifier: BSD-3-Clause
"""A strict reader of the GeoPackages that `export --format geopackage` writes: refuses what the standard (OGC 12-128r18,
clauses 1 and 2.1) does not allow, and what we do not write."""

import sqlite3
import struct

UNDEFINED_CARTESIAN = -1


class NoGeoPackage(Exception):
    """What is wrong with the file."""


def require(holds, what):
    if not holds:
        raise NoGeoPackage(what)


class Bytes:
    """Numbers, little endian, one after the other."""

    def __init__(self, content):
        self.content, self.at = content, 0

    def take(self, form):
        values = struct.unpack_from("<" + form, self.content, self.at)
        self.at += struct.calcsize("<" + form)
        return values if len(values) > 1 else values[0]


def ring_of(source):
    points = [source.take("2d") for _ in range(source.take("I"))]
    require(len(points) >= 4 and points[0] == points[-1], "a ring that is not closed")
    return points[:-1]


def polygon_of(source):
    require(source.take("BI") == (1, 3), "no polygon in little endian")
    return [ring_of(source) for _ in range(source.take("I"))]


def parts_of(blob):
    """The polygons of a geometry, each a list of open rings, the outer one first."""
    source = Bytes(blob)
    require(blob[:2] == b"GP", "a geometry without its mark")
    source.at = 2
    version, flags, srs_id = source.take("BBi")
    require((version, flags, srs_id) == (0, 0b11, UNDEFINED_CARTESIAN), "another head of a geometry")
    envelope = source.take("4d")
    require(source.take("BI") == (1, 6), "no multipolygon in little endian")
    parts = [polygon_of(source) for _ in range(source.take("I"))]
    require(source.at == len(blob), "bytes behind a geometry")
    xs, ys = zip(*[point for part in parts for ring in part for point in ring])
    require(envelope == (min(xs), max(xs), min(ys), max(ys)), "an envelope that is not that of its points")
    return parts


class GeoPackage:
    """All tables of features: name -> rows, each a dict of columns, `geom` decoded to polygons."""

    def __init__(self, path):
        head = path.read_bytes()[:100]
        require(head[:16] == b"SQLite format 3\0", "no SQLite")
        require(head[68:72] == b"GPKG", "another application_id")
        self.file = sqlite3.connect(path.resolve().as_uri() + "?mode=ro", uri=True)
        self.file.row_factory = sqlite3.Row
        try:
            self.read()
        finally:
            self.file.close()

    def select(self, sql, *values):
        return [dict(row) for row in self.file.execute(sql, values)]

    def read(self):
        self.require_sound()
        self.contents = {row["table_name"]: row for row in self.select("SELECT * FROM gpkg_contents")}
        self.tables = {name: self.features(name) for name in self.contents}

    def require_sound(self):
        for pragma, expected in (("user_version", 10300), ("application_id", 0x47504B47), ("integrity_check", "ok")):
            found = self.file.execute("PRAGMA " + pragma).fetchone()[0]
            require(found == expected, f"{pragma} is {found}")
        require(not self.select("PRAGMA foreign_key_check"), "rows that refer to none")
        known = {row["srs_id"] for row in self.select("SELECT * FROM gpkg_spatial_ref_sys")}
        require({-1, 0, 4326} <= known, f"reference systems are {known}")
        tables = {row["name"] for row in self.select("SELECT name FROM sqlite_master WHERE type = 'table'")}
        listed = {row["table_name"] for row in self.select("SELECT table_name FROM gpkg_contents")}
        core = {"gpkg_spatial_ref_sys", "gpkg_contents", "gpkg_geometry_columns"}
        require(tables == core | listed, f"tables are {tables}, contents {listed}")

    def features(self, name):
        content = self.contents[name]
        require((content["data_type"], content["srs_id"]) == ("features", UNDEFINED_CARTESIAN), f"{name} is no table of features")
        shown = self.select("SELECT * FROM gpkg_geometry_columns WHERE table_name = ?", name)
        require(shown == [{"table_name": name, "column_name": "geom", "geometry_type_name": "MULTIPOLYGON",
                           "srs_id": UNDEFINED_CARTESIAN, "z": 0, "m": 0}], f"geometry of {name} is {shown}")
        quoted = name.replace('"', '""')
        columns = self.select(f'PRAGMA table_info("{quoted}")')
        require([column["name"] for column in columns if column["pk"]] == ["fid"], f"primary key of {name}")
        for column in columns:
            require(column["type"] in ("INTEGER", "DOUBLE", "TEXT", "MULTIPOLYGON"), f"type of {column['name']}")
        rows = self.select(f'SELECT * FROM "{quoted}" ORDER BY fid')
        for row in rows:
            row["geom"] = parts_of(row["geom"])
        self.require_extent(content, rows)
        return rows

    @staticmethod
    def require_extent(content, rows):
        points = [point for row in rows for part in row["geom"] for ring in part for point in ring]
        if not points:
            return
        xs, ys = zip(*points)
        found = tuple(content[key] for key in ("min_x", "min_y", "max_x", "max_y"))
        require(found == (min(xs), min(ys), max(xs), max(ys)), f"extent is {found}")
