#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Damage to bare files, against the table of docs/DAMAGE.md.

Usage: damage_test.py PROGRAM [unittest args]"""

import collections
import json
import pathlib
import random
import shutil
import struct
import tempfile
import unittest

from program import DATA, SOURCE, repetitions, run
from tiny_dataset import depth_png, make_dataset

# A sanitizer sees the readers at many more in the fuzzer; here each kind of file passes through the program.
NUM_CUTS = repetitions(25)
NUM_CHANGES = repetitions(40)

OCCUPANCY = ("image: {image}\nresolution: 0.05\norigin: [0, 0, 0]\nnegate: 0\n"
             "occupied_thresh: 0.65\nfree_thresh: 0.196\nmode: scale\n")
CHAIR = '{"image": "1.png", "detections": [{"label": "chair", "score": 0.75, "bbox": [1, 2, 30, 40]}]}\n'

Noticed = collections.namedtuple("Noticed", "cut changed")


class Sample:
    """A sound file, how `check` is to take it, and damage to it that cannot be noticed."""

    def __init__(self, path, kind, unnoticed=(), harmless=(), asked=None):
        self.path = path
        self.kind = kind
        self.unnoticed = unnoticed  # (what, by what): what a reader must believe
        self.harmless = harmless  # parts of the file whose bits mean nothing
        self.asked = asked or path  # the file that `check` is given


def changed_bit(content, place, bit):
    return content[:place] + bytes([content[place] ^ 1 << bit]) + content[place + 1:]


def bmp(side_px):
    """Grey, 24 bit, rows a multiple of four bytes."""
    pixels = b"\x80" * 3 * side_px * side_px
    return (struct.pack("<2sIHHI", b"BM", 54 + len(pixels), 0, 0, 54) +
            struct.pack("<IiiHHIIiiII", 40, side_px, side_px, 1, 24, 0, len(pixels), 2835, 2835, 0, 0) + pixels)


def npy(numbers):
    """A vector as NumPy writes it."""
    header = b"{'descr': '<f8', 'fortran_order': False, 'shape': (%d,), }" % len(numbers)
    return b"\x93NUMPY\x01\x00" + struct.pack("<H", len(header)) + header + struct.pack(f"<{len(numbers)}d", *numbers)


def table():
    """By the name of the file: whether a cut and whether a change is always noticed."""
    rows = {}
    for line in (SOURCE / "docs/DAMAGE.md").read_text().splitlines():
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        if line.startswith("|") and cells[2] in ("yes", "no"):
            rows[cells[0]] = Noticed(cut=cells[2] == "yes", changed=cells[3] == "yes")
    return rows


class Damage(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="hypermap-damage-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        cls.samples = cls.make_samples()

    @classmethod
    def written(cls, name, content):
        path = cls.folder / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return path

    @classmethod
    def done(cls, *arguments):
        result = run(*arguments)
        if result.returncode not in (0, 1):
            raise AssertionError(f"{arguments}: {result.stderr}")

    @classmethod
    def make_samples(cls):
        return {
            "archive `.hmap`": [Sample(cls.archive(), "archive")],
            "`.ot`, `.bt` of ours": cls.octrees_of_ours(),
            "`.ot`, `.bt` of others": cls.octrees_of_others(),
            "`detections.jsonl` of ours": [Sample(cls.simulated_detections(), "detections")],
            "JSON lines of others": [
                Sample(cls.written("others.jsonl", CHAIR + CHAIR.replace("1.png", "2.png")), "detections",
                       [("0.75", "0.35"), ("chair", "cheir")])],
            "other JSON: COCO results, intrinsics": cls.other_json(),
            "text: YOLO detections, trajectories, matrices": cls.texts(),
            "map for ROS, exported by us: `.yaml`": [
                Sample(cls.ros_map(), "map", [("resolution: 0.0", "resolution: 0.1")])],
            "map for ROS, exported by us: `.pgm`": [
                Sample(next(cls.folder.glob("ros-*.pgm")), "map", asked=cls.folder / "ros.yaml")],
            "YAML: maps, semantic layers, bare configurations": cls.yamls(),
            "PNG": [Sample(cls.written("wall.png", depth_png(9, 7, 5000)), "depth")],
            "binary PGM, BMP": [
                Sample(cls.written("a.pgm", b"P5 4 3 255\n" + bytes(range(100, 112))), "image", [(b"\x65", b"\x64")]),
                Sample(cls.written("a.bmp", bmp(4)), "image", [(b"\x80\x80", b"\x81\x80")])],
            "text PGM": [Sample(cls.written("b.pgm", "P2 2 1 255\n7 128"), "image", [("128", "12"), ("7", "6")])],
            "vector of NumPy, `.npy`": [Sample(cls.written("a.npy", npy([0.5, -1.0])), "embedding", [(struct.pack("<d", 0.5), struct.pack("<d", 0.25))])],
            "JPEG": cls.jpegs(),
        }

    @classmethod
    def archive(cls):
        make_dataset(cls.folder / "wall")
        path = cls.folder / "wall.hmap"
        cls.done("map", "--input", cls.folder / "wall", "--up", "-y", "--output", path)
        return path

    @classmethod
    def octrees_of_ours(cls):
        samples = []
        for name in ("wall.ot", "wall.bt"):
            cls.done("export", cls.folder / "wall.hmap", "--format", "octomap", "--output", cls.folder / name)
            samples.append(Sample(cls.folder / name, "octree", harmless=[b"crc32"]))
        return samples

    @classmethod
    def octrees_of_others(cls):
        node = struct.pack("<fB", 0.5, 0)
        full = b"# Octomap OcTree file\nid OcTree\nsize 3\nres 0.05\ndata\n" + struct.pack("<fB", 0.5, 3) + 2 * node
        binary = b"# Octomap OcTree binary file\nid OcTree\nsize 3\nres 0.05\ndata\n" + b"\x09\x00"
        return [Sample(cls.written("others.ot", full), "octree", [(b"0.05", b"0.15")]),
                Sample(cls.written("others.bt", binary), "octree", [(b"\x09\x00", b"\x06\x00"), (b"0.05", b"0.15")])]

    @classmethod
    def simulated_detections(cls):
        cls.done("simulate", "--frames", 1, "--size", "320x240", "--output", cls.folder / "laboratory")
        return cls.folder / "laboratory/detections.jsonl"

    @classmethod
    def other_json(cls):
        coco = [{"image_id": 0, "file_name": "1.png", "category": "chair", "category_id": 3,
                 "bbox": [1, 2, 30, 40], "score": 0.75}]
        camera = {"width": 32, "height": 24, "fx": 28.8, "fy": 28.8, "cx": 15.5, "cy": 11.5, "depth_scale": 5000}
        return [Sample(cls.written("coco.json", json.dumps(coco)), "detections", [("0.75", "0.35")]),
                Sample(cls.written("camera.json", json.dumps(camera)), "intrinsics", [("28.8", "29.8")])]

    @classmethod
    def texts(cls):
        poses = "".join(f"{i}.5 0.{i}1 0.25 1.75 0 0 0 1\n" for i in range(4))
        log = "".join(f"{i} {i} 4\n1 0 0 0.{i}\n0 1 0 0.25\n0 0 1 1.75\n0 0 0 1\n" for i in range(4))
        return [Sample(cls.written("poses.txt", poses), "trajectory",
                       [("1.75", "1.25"), ("3.5 0.31 0.25 1.75 0 0 0 1\n", "")]),
                Sample(cls.written("poses.log", log), "trajectory", [("1.75", "1.25")]),
                Sample(cls.written("yolo.txt", "0 0.5 0.5 0.25 0.25 0.75\n"), "detections", [("0.75", "0.7")])]

    @classmethod
    def ros_map(cls):
        cls.done("export", cls.folder / "wall.hmap", "--format", "ros-map", "--layer", "occupancy",
                 "--output", cls.folder / "ros")
        return cls.folder / "ros.yaml"

    @classmethod
    def yamls(cls):
        cls.written("map.pgm", b"P5 2 2 255\n" + bytes(4))
        shapes = "".join(f'- {{name: chair{i}, shape: "POLYGON((0 0, 1 0, 1 1, 0 0))"}}\n' for i in range(2))
        config = "layers:\n- {class: SemanticLayer, name: shapes.yaml, frame_id: map, load_file: true}\n"
        return [Sample(cls.written("map.yaml", OCCUPANCY.format(image="map.pgm")), "map",
                       [("mode: scale\n", ""), ("0.05", "0.15")]),
                Sample(cls.written("shapes.yaml", shapes), "semantic", [("chair0", "chajr0"), ("1 1", "1 3")]),
                Sample(cls.written("hmap_config.yaml", config), "config", [("frame_id: map", "frame_id: mop")])]

    @classmethod
    def jpegs(cls):
        images = sorted((DATA / "rgbd/7scenes_redkitchen").rglob("*.jpg"))[:1]
        samples = []
        for content in (path.read_bytes() for path in images):
            middle = content[len(content) // 2:]
            samples.append(Sample(cls.written("frame.jpg", content), "image", [(middle, changed_bit(middle, 0, 0))]))
        return samples

    def check(self, sample, content=None):
        """Exit code of `check` for the sample with other bytes, and what it said."""
        sound = sample.path.read_bytes()
        if content is not None:
            sample.path.write_bytes(content)
        try:
            result = run("check", "--as", sample.kind, sample.asked)
            return result.returncode, result.stdout + result.stderr
        finally:
            sample.path.write_bytes(sound)

    def assert_noticed(self, sample, content):
        status, told = self.check(sample, content)
        if status == 0 and sample.kind == "archive":
            self.assertEqual(self.map_of(content), self.map_of(sample.path.read_bytes()))
        else:
            self.assertIn(status, (1, 2), told)
            self.assertIn(sample.path.name, told)

    def map_of(self, archive):
        """What an archive says, without its own name."""
        result = run("info", "--json", self.written("other.hmap", archive))
        return result.stdout

    def changes(self, sample):
        """Single bits, here and there."""
        content = sample.path.read_bytes()
        harmless = {i for part in sample.harmless
                    for i in range(content.find(part), content.find(part) + len(part))}
        places = [i for i in range(len(content)) if i not in harmless]
        generator = random.Random(1)
        for place in generator.sample(places, min(NUM_CHANGES, len(places))):
            bit = generator.randrange(8)
            yield f"bit {bit} of byte {place}", changed_bit(content, place, bit)

    def cuts(self, sample):
        content = sample.path.read_bytes()
        size = len(content.rstrip())
        generator = random.Random(2)
        sizes = {0, 1, size - 1, *generator.sample(range(size), min(NUM_CUTS, size))}
        return [(f"cut to {length}", content[:length]) for length in sorted(sizes)]

    def all_samples(self):
        return [(row, sample) for row, samples in self.samples.items() for sample in samples]

    def test_the_table_has_a_row_for_each_kind_of_file(self):
        self.assertEqual(list(table()), list(self.samples))

    def test_sound_files_pass(self):
        for _, sample in self.all_samples():
            with self.subTest(sample.path.name):
                status, told = self.check(sample)
                self.assertEqual(status, 0, told)

    def test_cuts_that_are_always_noticed(self):
        for row, sample in self.all_samples():
            for what, content in self.cuts(sample) if table()[row].cut else ():
                with self.subTest(sample.path.name, what=what):
                    self.assert_noticed(sample, content)

    def test_changes_that_are_always_noticed(self):
        for row, sample in self.all_samples():
            for what, content in self.changes(sample) if table()[row].changed else ():
                with self.subTest(sample.path.name, what=what):
                    self.assert_noticed(sample, content)

    def test_what_the_table_says_to_pass_passes(self):
        """So that the table tells of a checksum that a format gets."""
        for row, sample in self.all_samples():
            with self.subTest(sample.path.name):
                is_safe = table()[row].cut and table()[row].changed
                self.assertEqual(bool(sample.unnoticed), not is_safe, row)
                for old, new in sample.unnoticed:
                    old, new = (part if isinstance(part, bytes) else part.encode() for part in (old, new))
                    content = sample.path.read_bytes()
                    self.assertIn(old, content)
                    at = content.rindex(old)
                    status, told = self.check(sample, content[:at] + new + content[at + len(old):])
                    self.assertEqual(status, 0, (old, new, told))


if __name__ == "__main__":
    unittest.main()
