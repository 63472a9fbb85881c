#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Every bad file that `map` reads, in an otherwise good dataset.

Usage: hostile_datasets_test.py PROGRAM [unittest args]"""

import json
import shutil
import unittest

from corpus import CORPUS, Corpus, files_of, must_load
from program import run, tree_digest
from tiny_dataset import make_dataset


class Datasets(Corpus):
    """What `map` reads, each bad file in an otherwise good dataset."""

    def setUp(self):
        super().setUp()
        self.output = self.folder / "out" / "a.hmap"
        self.output.parent.mkdir()
        self.stats = self.folder / "stats.json"

    def dataset(self, **options):
        folder = self.folder / "dataset"
        shutil.rmtree(folder, ignore_errors=True)
        return make_dataset(folder, **options)

    def map_arguments(self, dataset, *more):
        return ["map", "--input", dataset, "--output", self.output, "--stats", self.stats, *more]

    def assert_mapped(self, dataset, *more):
        result = self.assert_accepted(*self.map_arguments(dataset, *more))
        self.assertTrue(self.output.exists())
        self.output.unlink()
        return result

    def assert_not_mapped(self, named, dataset, *more):
        """What was at the output stays, and no temporary is left beside it."""
        self.output.write_bytes(b"what was there before")
        self.assert_refused(named, *self.map_arguments(dataset, *more))
        self.assertEqual([path.name for path in self.output.parent.iterdir()], [self.output.name])
        self.assertEqual(self.output.read_bytes(), b"what was there before")

    def judge(self, path, named, dataset, *more):
        with self.subTest(path.name):
            if must_load(path):
                self.assert_mapped(dataset, *more)
            else:
                self.assert_not_mapped(named, dataset, *more)

    def test_trajectories(self):
        """A sequence survives bad lines, which are named; a file without any pose is refused."""
        for path in files_of("trajectory"):
            lines = path.read_text(errors="replace").splitlines()
            stamps = [line.split()[0] for line in lines if line and not line.startswith("#")][:2]
            dataset = self.dataset(stamps=stamps if must_load(path) else ["1.0"])
            shutil.copy(path, dataset / "groundtruth.txt")
            if "1.0 0 0 1 0 0 0 1" not in lines:
                self.judge(path, "groundtruth.txt", dataset)
                continue
            with self.subTest(path.name):
                result = self.assert_mapped(dataset)
                self.assertEqual(result.returncode, 0 if must_load(path) else 1, result.stderr)
                if not must_load(path):
                    self.assertRegex(result.stderr, r"(?m)^warning: .*groundtruth.txt:\d+: \w+: .+")

    def test_intrinsics(self):
        for path in files_of("intrinsics"):
            dataset = self.dataset(size=(640, 480), stamps=["1.0"])
            shutil.copy(path, dataset / "camera.json")
            self.judge(path, "camera.json", dataset)

    def test_detections(self):
        dataset = self.dataset(size=(640, 480), stamps=["1.0"])
        for path in files_of("detections"):
            self.judge(path, path.name, dataset, "--detections", path)

    def test_a_label_stays_a_label(self):
        dataset = self.dataset(size=(640, 480), stamps=["1.0"])
        path = CORPUS / "detections/ok_label_path.json"
        label = json.loads(path.read_text())["detections"][0]["label"]
        self.assert_accepted(*self.map_arguments(dataset, "--detections", path))
        classes = json.loads(run("info", self.output, "--json").stdout)["classes"]
        self.assertEqual([entry["name"] for entry in classes], [label])
        before = tree_digest(self.folder)
        grids = self.output.parent / "grids"
        for form, output in (("class-grids", grids), ("ply", self.output.with_suffix(".ply"))):
            result = run("export", self.output, "--format", form, "--output", output)
            self.assertIn(result.returncode, (0, 1), result.stderr)  # 1: nothing bears the class
        for made in [*self.output.parent.glob("*.ply"), *([grids] if grids.exists() else [])]:
            shutil.rmtree(made) if made.is_dir() else made.unlink()
        self.assertEqual(tree_digest(self.folder), before)
        for arguments in (["info", self.output], ["query", self.output, "--layer", "objects"]):
            self.assertNotIn("\n- evil", run(*arguments).stdout)

    def test_depth_frames(self):
        for path in files_of("depth"):
            dataset = self.dataset()
            shutil.copy(path, dataset / "depth/1.png")
            self.judge(path, "1.png", dataset)
            if not must_load(path):
                self.assert_survived(path, dataset)

    def test_images_as_depth_frames(self):
        for path in files_of("image"):
            dataset = self.dataset()
            name = "1" + path.suffix
            shutil.copy(path, dataset / "depth" / name)
            (dataset / "depth.txt").write_text(f"1.0 depth/0.png\n1.1 depth/{name}\n")
            self.assert_survived(path, dataset)  # all are of another size, if of nothing else

    def assert_survived(self, path, dataset):
        """The other frame is mapped when half of the frames may be lost; the bad one is named."""
        with self.subTest(path.name, survives=True):
            result = self.assert_mapped(dataset, "--max-skipped", "0.5")
            self.assertEqual(result.returncode, 1, result.stderr)
            self.assertIn("1" + path.suffix, result.stderr)
            self.assertEqual(json.loads(self.stats.read_text())["frames_skipped"], 1)

    def test_yaml_as_options_and_as_a_description(self):
        dataset = self.dataset()
        for path in files_of("yaml"):
            for option in ("--config", "--dataset"):
                with self.subTest(path.name, option=option):
                    self.assert_not_mapped(path.name, dataset, option, path)

if __name__ == "__main__":
    unittest.main(verbosity=1)
