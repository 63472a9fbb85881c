#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Every file of the hostile corpus through `check` and through the commands that read it.

Usage: hostile_test.py PROGRAM [unittest args]"""

import shutil
import unittest
import zipfile

from corpus import CORPUS, Corpus, files_of, must_load
from program import tree_digest

def is_map_metadata(path):
    words = ("resolution", "thresh", "origin", "negate", "image", "occupancy")
    return any(word in path.name for word in words)


class Check(Corpus):
    """Each file as its name says, by itself."""

    KINDS = {"zip": "archive", "octree": "octree", "image": "image", "depth": "depth", "wkt": "semantic",
             "trajectory": "trajectory", "intrinsics": "intrinsics", "detections": "detections"}

    def check(self, path, *arguments):
        result = self.measured("check", *arguments, path)
        self.assertIn(result.returncode, (0, 1) if must_load(path) else (2,),
                      f"{path}: {result.stdout}{result.stderr}")
        if path.name.startswith("err_"):
            self.assertIn(path.name, result.stdout + result.stderr)

    def test_kinds_insisted_on(self):
        for folder, kind in self.KINDS.items():
            for path in files_of(folder):
                with self.subTest(path.name):
                    size = ["--size", "32x24"] if kind == "depth" else []
                    self.check(path, "--as", kind, *size)

    def test_yaml(self):
        for path in files_of("yaml"):
            with self.subTest(path.name):
                self.check(path, "--as", "map" if is_map_metadata(path) else "config")

    def test_the_kind_is_found_by_content(self):
        for name in ("zip/ok_reference.hmap", "octree/ok_two.ot", "octree/ok_single.bt", "image/ok_p2.pgm",
                     "wkt/ok_square_ccw.yaml", "trajectory/ok_two.txt", "intrinsics/ok_camera.json",
                     "detections/ok_one.json", "yaml/ok_config.yaml"):
            with self.subTest(name):
                self.check(CORPUS / name)


class ArchiveCorpus(Corpus):
    """The commands that read archives."""

    def setUp(self):
        super().setUp()
        self.parts = self.folder / "parts"
        with zipfile.ZipFile(CORPUS / "zip/ok_reference.hmap") as archive:
            archive.extractall(self.parts)
        self.outputs = self.folder / "outputs"

    def commands(self, path):
        """Name, command line; each would write into `outputs`, and nothing else may be there."""
        out = self.outputs
        return [("info", ["info", path, "--json"]),
                ("query", ["query", path, "--layer", "semantic", "--at", "0.5,0.5"]),
                ("export", ["export", path, "--format", "geojson", "--output", out / "a.local.geojson"]),
                ("snapshot", ["snapshot", path, "--output", out / "a.png", "--size", "64x64"])]

    def check(self, path, accepted, commands=("info", "query", "export", "snapshot")):
        for name, arguments in self.commands(path):
            if name not in commands:
                continue
            shutil.rmtree(self.outputs, ignore_errors=True)
            self.outputs.mkdir()
            with self.subTest(file=path.name, command=name):
                if not accepted:
                    self.assert_refused(path.name, *arguments)
                    self.assertEqual(list(self.outputs.iterdir()), [])
                elif name == "snapshot":
                    result = self.measured(*arguments)
                    self.assertIn(result.returncode, (0, 3), result.stderr)  # 3: no EGL here
                else:
                    self.assert_accepted(*arguments)

    def with_member(self, name, content, **others):
        """The reference archive with other bytes for some members, as `<name>.hmap`."""
        members = {part.name: part.read_bytes() for part in self.parts.iterdir()}
        members.update(others.pop("also", {}))
        members[others.pop("member")] = content
        path = self.folder / f"{name}.hmap"
        with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
            for member, data in sorted(members.items()):
                archive.writestr(member, data)
        return path


class Archives(ArchiveCorpus):
    """Bad archives."""

    def test_bad_archives(self):
        before = tree_digest(CORPUS / "zip")
        for path in files_of("zip"):
            self.check(path, must_load(path))
        self.assertEqual(tree_digest(CORPUS / "zip"), before)


class Members(ArchiveCorpus):
    """A bad member in a good archive, or by itself."""

    def test_bad_configurations_in_a_folder_and_in_an_archive(self):
        for path in files_of("yaml"):
            if is_map_metadata(path):
                continue
            shutil.copy(path, self.parts / path.name)
            self.check(self.parts / path.name, must_load(path), ["info"])
            (self.parts / path.name).unlink()
            packed = self.with_member(path.stem, path.read_bytes(), member="hmap_config.yaml")
            self.check(packed, must_load(path), ["info"])

    def test_bad_map_metadata_alone_and_in_an_archive(self):
        for path in files_of("yaml"):
            if not is_map_metadata(path):
                continue
            shutil.copy(path, self.parts / path.name)
            self.check(self.parts / path.name, must_load(path), ["info"])
            (self.parts / path.name).unlink()
            packed = self.with_member(path.stem, path.read_bytes(), member="occupancy.yaml")
            self.check(packed, must_load(path), ["query"])

    def test_bad_images_of_a_map(self):
        metadata = (self.parts / "occupancy.yaml").read_text()
        for path in files_of("image"):
            image = "picture" + path.suffix
            also = {"occupancy.yaml": metadata.replace("occupancy.png", image).encode()}
            packed = self.with_member(path.stem, path.read_bytes(), member=image, also=also)
            self.check(packed, must_load(path), ["info"])

    def test_bad_polygons(self):
        for path in files_of("wkt"):
            packed = self.with_member(path.stem, path.read_bytes(), member="semantic")
            self.check(packed, must_load(path), ["query", "export"])

    def test_bad_octrees_alone_and_in_an_archive(self):
        config = (self.parts / "hmap_config.yaml").read_text()
        for path in files_of("octree"):
            self.check(path, must_load(path), ["info"])
            member = "tree" + path.suffix
            also = {"hmap_config.yaml": config.replace("octree.ot", member).encode()}
            packed = self.with_member(path.stem, path.read_bytes(), member=member, also=also)
            self.check(packed, must_load(path), ["info"])


if __name__ == "__main__":
    unittest.main(verbosity=1)
