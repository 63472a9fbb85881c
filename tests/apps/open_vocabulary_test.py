#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Embeddings from files of detections to `query --embedding`, with vectors that the test plants.

Usage: open_vocabulary_test.py PROGRAM [unittest args]"""

import base64
import json
import math
import pathlib
import random
import shutil
import struct
import tempfile
import unittest
import zipfile

from program import run
from tiny_dataset import make_dataset

DIMENSION = 16


def vector_of(name, dimension=DIMENSION):
    """A direction that belongs to a name, in numbers that a float of 32 bits has."""
    numbers = random.Random(name)
    return struct.unpack(f"<{dimension}f", struct.pack(f"<{dimension}f", *(numbers.gauss(0, 1) for _ in range(dimension))))


def npy(vector):
    header = b"{'descr': '<f8', 'fortran_order': False, 'shape': (%d,), }" % len(vector)
    return b"\x93NUMPY\x01\x00" + struct.pack("<H", len(header)) + header + struct.pack(f"<{len(vector)}d", *vector)


def stored(path):
    """The means in an archive, by model and id."""
    data = zipfile.ZipFile(path).read("embeddings.bin")
    place = 8

    def take(form):
        nonlocal place
        place += struct.calcsize(form)
        return struct.unpack_from(form, data, place - struct.calcsize(form))

    means = {}
    for _ in range(take("<I")[0]):
        name = take(f"<{take('<I')[0]}s")[0].decode()
        dimension, count = take("<II")
        ids = [take("<II")[0] for _ in range(count)]
        means[name] = {one: take(f"<{dimension}f") for one in ids}
    assert place == len(data)
    return means


def cosine(a, b):
    return math.fsum(x * y for x, y in zip(a, b)) / math.sqrt(math.fsum(x * x for x in a) * math.fsum(x * x for x in b))


class OpenVocabulary(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="hypermap-vocabulary-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        cls.dataset = cls.folder / "lab"
        cls.simulated = run("simulate", "--frames", 10, "--seed", 1, "--detector", "perfect", "--output", cls.dataset)
        cls.plain = (cls.dataset / "detections.jsonl").read_text().splitlines()[1:]
        cls.planted = cls.detections("planted.jsonl", lambda i, one: {"model": "clip", "vector": cls.seen(i, one)})
        cls.map = cls.folder / "lab.hmap"
        cls.mapped = run("map", "--input", cls.dataset, "--detections", cls.planted, "--output", cls.map)

    @staticmethod
    def seen(i, one):
        """The class's direction and a little of the place's, now as numbers, now as base64."""
        place = vector_of(str(one["bbox"]))
        vector = [x + 0.1 * y for x, y in zip(vector_of(one["label"]), place)]
        return vector if i % 2 else base64.b64encode(struct.pack(f"<{DIMENSION}f", *vector)).decode()

    @classmethod
    def detections(cls, name, embedding_of):
        """The simulated detections, each with an embedding."""
        frames = [json.loads(line) for line in cls.plain]
        for i, frame in enumerate(frames):
            for one in frame["detections"]:
                one["embedding"] = embedding_of(i, one)
        path = cls.folder / name
        path.write_text("".join(json.dumps(frame) + "\n" for frame in frames))
        return path

    def setUp(self):
        self.assertEqual(self.simulated.returncode, 0, self.simulated.stderr)
        self.assertEqual(self.mapped.returncode, 0, self.mapped.stderr)

    def asked(self, vector, *more, name="asked.json"):
        path = self.folder / name
        if isinstance(vector, bytes):
            path.write_bytes(vector)
        else:
            path.write_text(json.dumps(vector))
        return run("query", self.map, "--embedding", path, *more)

    def test_planted_vectors_are_ranked_exactly(self):
        means = stored(self.map)["clip"]
        shown = {one["id"] for one in json.loads(run("query", self.map, "--layer", "objects", "--json").stdout)["results"]}
        self.assertGreater(len(shown), 5)
        for label in ("chair", "cup", "something that is nowhere"):
            vector = vector_of(label)
            expected = sorted((-cosine(means[one], vector), one) for one in shown)
            told = self.asked(npy(vector), "--top", 1000, "--json", name="asked.npy")
            self.assertEqual(told.returncode, 0, told.stderr)
            results = json.loads(told.stdout)["results"]
            self.assertEqual([one["id"] for one in results], [one for _, one in expected])
            for one, (similarity, _) in zip(results, expected):
                self.assertAlmostEqual(one["similarity"], -similarity, places=9)
            first = json.loads(self.asked(vector, "--top", 1, "--json").stdout)["results"]
            self.assertEqual(first, results[:1])
        best = json.loads(self.asked(vector_of("chair"), "--json", "--top", 1).stdout)["results"][0]
        self.assertEqual(best["name"], "chair")
        self.assertGreater(best["similarity"], 0.9)

    def test_text_tells_the_similarity_too(self):
        told = self.asked({"model": "clip", "vector": vector_of("chair")}, "--top", 2, "--string", "chair")
        self.assertEqual(told.returncode, 0, told.stderr)
        self.assertRegex(told.stdout.splitlines()[0], r"^name +id +similarity ")
        self.assertRegex(told.stdout, r"(?m)^chair +\d+ +0\.9\d\d\d ")

    def test_what_cannot_be_compared_is_said(self):
        short = self.asked([1, 2, 3])
        self.assertEqual((short.returncode, short.stderr),
                         (4, "query: --embedding must have 16 numbers as those of model clip, has 3\n"))
        other = self.asked(vector_of("chair"), "--model", "dino")
        self.assertEqual(other.returncode, 2)
        self.assertIn("clip", other.stderr)
        clash = self.asked({"model": "clip", "vector": vector_of("chair")}, "--model", "dino")
        self.assertEqual(clash.returncode, 2)
        self.assertIn("is \"clip\", --model says \"dino\"", clash.stderr)
        empty = run("query", self.dataset / "truth.hmap", "--embedding", self.folder / "asked.json")
        self.assertEqual(empty.returncode, 2)
        self.assertIn("no object of the map has an embedding", empty.stderr)
        self.assertEqual(run("query", self.map, "--embedding", self.folder / "none").returncode, 3)
        self.assertEqual(run("query", self.map, "--layer", "objects", "--top", 3).returncode, 4)
        self.assertEqual(self.asked([1], "--nearest", "chair", "--at", "0,0").returncode, 4)

    def test_info_and_check_tell_of_them(self):
        told = json.loads(run("info", self.map, "--json").stdout)["embeddings"]
        self.assertEqual(told, [{"model": "clip", "dimension": DIMENSION, "objects": len(stored(self.map)["clip"])}])
        self.assertRegex(run("info", self.map).stdout, r"(?m)^embeddings of clip: \d+ objects of 16 numbers$")
        self.assertIn("embeddings of clip (16 numbers)", run("check", self.map).stdout)
        (self.folder / "mug.npy").write_bytes(npy([1.0, 2.0]))
        self.assertIn("embedding of 2 numbers", run("check", self.folder / "mug.npy").stdout)

    def test_threads_do_not_matter(self):
        for threads in (1, 2):
            output = self.folder / f"threads{threads}.hmap"
            run("map", "--input", self.dataset, "--detections", self.planted, "--output", output, "--threads", threads)
            self.assertEqual(output.read_bytes(), self.map.read_bytes())

    def test_a_dimension_that_clashes_is_refused(self):
        longer = self.detections("longer.jsonl", lambda i, one: {"model": "clip", "vector": vector_of(one["label"], 17)})
        output = self.folder / "clash.hmap"
        clash = run("map", "--input", self.dataset, "--detections", self.planted, "--detections", longer, "--output", output)
        self.assertEqual(clash.returncode, 2)
        self.assertRegex(clash.stderr, r"longer\.jsonl:\d+: \$\.detections\[0\]\.embedding: of model \"clip\" must have 16 numbers "
                                       r"as before, has 17")
        self.assertFalse(output.exists())
        shutil.copy(self.map, output)
        before = output.read_bytes()
        clash = run("map", "--input", self.dataset, "--detections", longer, "--output", output, "--append", "--same-world", "--force")
        self.assertEqual(clash.returncode, 2)
        self.assertIn("must have 16 numbers", clash.stderr)
        self.assertEqual(output.read_bytes(), before)

    def test_a_map_is_gone_on_from_with_its_embeddings(self):
        output = self.folder / "more.hmap"
        shutil.copy(self.map, output)
        other = self.detections("other.jsonl", lambda i, one: {"model": "dino", "vector": vector_of(one["label"], 8)})
        added = run("map", "--input", self.dataset, "--detections", other, "--output", output, "--append", "--same-world", "--force")
        self.assertIn(added.returncode, (0, 1), added.stderr)
        models = stored(output)
        self.assertEqual({name: len(next(iter(means.values()))) for name, means in models.items()}, {"clip": 16, "dino": 8})
        self.assertTrue(set(models["clip"]) & set(models["dino"]))

    def test_the_best_view_of_each_object_is_kept(self):
        self.assertEqual(json.loads(run("info", self.map, "--json").stdout)["views"], 0)
        none = run("export", self.map, "--format", "views", "--output", self.folder / "none")
        self.assertEqual(none.returncode, 2)
        self.assertIn("the map holds no views", none.stderr)
        output = self.folder / "seen.hmap"
        mapped = run("map", "--input", self.dataset, "--detections", self.planted, "--output", output, "--views")
        self.assertEqual(mapped.returncode, 0, mapped.stderr)
        count = json.loads(run("info", output, "--json").stdout)["views"]
        self.assertRegex(run("info", output).stdout, rf"(?m)^views of {count} objects$")
        shown = json.loads(run("query", output, "--layer", "objects", "--json").stdout)["results"]
        self.assertGreaterEqual(count, len(shown))
        for _ in range(2):  # the second time in place of the first
            written = run("export", output, "--format", "views", "--output", self.folder / "views")
            self.assertEqual(written.returncode, 0, written.stderr)
        files = sorted((self.folder / "views").iterdir())
        self.assertEqual(sorted(written.stdout.splitlines()), [str(file) for file in files])
        self.assertEqual({int(file.name.split("-")[0]) for file in files}, {one["id"] for one in shown})
        for file in files:
            content = file.read_bytes()
            self.assertLessEqual(len(content), 16384)
            self.assertEqual((content[:2], content[-2:]), (b"\xff\xd8", b"\xff\xd9"))
        (self.folder / "views/note.txt").write_text("mine")
        refused = run("export", output, "--format", "views", "--output", self.folder / "views")
        self.assertEqual(refused.returncode, 2)
        self.assertIn("note.txt", refused.stderr)
        kept = run("map", "--input", self.dataset, "--output", output, "--append", "--same-world", "--force")
        self.assertIn(kept.returncode, (0, 1), kept.stderr)
        self.assertGreater(json.loads(run("info", output, "--json").stdout)["views"], 0)

    def test_without_colour_no_view_is_said_once(self):
        output = self.folder / "grey.hmap"
        told = run("map", "--input", make_dataset(self.folder / "grey"), "--up", "-y", "--output", output, "--views")
        self.assertEqual(told.returncode, 1, told.stderr)
        self.assertEqual(told.stderr.count("no frame has a colour image"), 1, told.stderr)


if __name__ == "__main__":
    unittest.main()
