#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What the program refuses to write over, and what of its own it may replace.

Usage: overwriting_test.py PROGRAM [unittest args]"""

import pathlib
import shutil
import subprocess
import unittest

from contract_case import Case
from program import PROGRAM, run

OLD = b"what was there before"


class Overwriting(Case):
    def test_nothing_is_written_over_what_is_read(self):
        dataset = self.folder / "dataset"
        shutil.copytree(self.dataset, dataset)
        archive = self.folder / "a.hmap"
        shutil.copy(self.archive, archive)
        link = self.folder / "link"
        link.symlink_to("a.hmap")
        options = self.folder / "options.yaml"
        options.write_text("octree: {resolution_m: 0.05}\n")
        mapping = ["map", "--input", dataset]
        over_input = "would write over what is read: "
        over_dataset = "would write over a file of the dataset "
        in_dataset = "would be read as a file of the dataset "
        elsewhere = self.folder / "elsewhere.yaml"
        elsewhere.write_text("depth: depth/*.png\ndepth_scale: 5000\ntrajectory: slam.json\n"
                             "intrinsics: {fx: 100, fy: 100, cx: 50, cy: 50}\n")
        shutil.copy(dataset / "groundtruth.txt", dataset / "slam.json")
        patterned = self.folder / "patterned"
        shutil.copytree(dataset / "depth", patterned / "depth")
        shutil.copy(dataset / "groundtruth.txt", patterned)
        (patterned / "color").mkdir()
        (patterned / "dataset.yaml").write_text(
            "depth: depth/*.png\ncolor: color/*.pgm\ndepth_scale: 5000\ntrajectory: groundtruth.txt\n"
            "intrinsics: {fx: 100, fy: 100, cx: 50, cy: 50}\n")
        broken = self.folder / "broken"
        shutil.copytree(patterned, broken)
        (broken / "dataset.yaml").write_text("depth: depth/*.png\ndepth_scale: 0\n")
        new = self.folder / "new"
        cases = [(over_input, ["snapshot", archive, "--output", archive]),
                 (over_input, ["snapshot", archive, "--output", link]),
                 (over_input, ["export", archive, "--format", "ply", "--output", self.folder / "." / "a.hmap"]),
                 (over_input, ["export", options, "--format", "ros-map", "--output", self.folder / "options"]),
                 (over_input, ["export", options, "--format", "ros-map", "--output", self.folder / "options.pgm"]),
                 (over_dataset, [*mapping, "--output", dataset / "groundtruth.txt"]),
                 (over_dataset, [*mapping, "--output", dataset / "depth" / "1.png"]),
                 (over_input, [*mapping, "--output", options, "--config", options]),
                 ("is the name of another output: ", [*mapping, "--output", new, "--stats", new]),
                 (over_dataset, [*mapping, "--output", new, "--stats", dataset / "groundtruth.txt"]),
                 (over_dataset, [*mapping, "--output", new, "--times-plot", dataset / "depth" / "1.png"]),
                 (in_dataset, [*mapping, "--output", new, "--times-plot", patterned / "depth" / "new.png"]),
                 (over_dataset, ["snapshot", archive, "--output", dataset / "depth" / "1.png"]),
                 (over_dataset, ["snapshot", archive, "--output", self.folder / "images" / "1.png"]),
                 (over_dataset, ["snapshot", archive, "--output", self.folder / "image.png"]),
                 ("the image beside it would be read as one of a dataset's",
                  ["export", archive, "--format", "ros-map", "--output", patterned / "color" / "grid"]),
                 ("a folder of a dataset", ["export", archive, "--format", "class-grids", "--output", patterned / "color"]),
                 (over_dataset, ["snapshot", archive, "--output", broken / "depth" / "1.png"]),
                 *[("must be the name of a file", ["export", archive, "--format", "ros-map", "--output", name])
                   for name in ("/", f"{self.folder}/", f"{self.folder}/.", ".", "..", "-")],
                 ("a folder of a dataset", ["tune", "--input", dataset, "--frame", 0, "--output", dataset / "depth"]),
                 (over_dataset, ["transform", archive, "--by", "0,0,0,0", "--output", dataset / "truth.hmap"]),
                 (over_dataset, [*mapping, "--output", dataset / "truth.hmap"]),
                 (over_dataset, [*mapping, "--dataset", elsewhere, "--output", new, "--stats", dataset / "slam.json"])]
        shutil.copy(self.archive, dataset / "truth.hmap")
        (self.folder / "images").symlink_to(dataset / "depth")
        (self.folder / "image.png").symlink_to(dataset / "depth" / "1.png")
        before = {path: path.read_bytes() for path in self.folder.rglob("*") if path.is_file()}
        for fault, arguments in cases:
            with self.subTest(arguments):
                result = run(*arguments)
                self.assertEqual(result.returncode, 4, result.stderr)
                self.assertIn(fault, result.stderr)
        after = {path: path.read_bytes() for path in self.folder.rglob("*") if path.is_file()}
        self.assertEqual(before, after)

    def test_what_a_command_wrote_into_a_dataset_it_may_write_again(self):
        dataset = self.folder / "dataset"
        shutil.copytree(self.dataset, dataset)
        (dataset / "maps").mkdir()
        mapping = ["map", "--input", dataset, "--max-frames", 2]
        for arguments in ([*mapping, "--output", dataset / "map.hmap", "--stats", dataset / "stats.json"],
                          [*mapping, "--output", dataset / "MAP.HMAP"], [*mapping, "--output", dataset / "map"],
                          [*mapping, "--output", dataset / "maps" / "a.hmap", "--stats", dataset / "maps" / "a.json"],
                          ["snapshot", dataset / "map.hmap", "--output", dataset / "maps" / "plan.png"]):
            for turn in ("new", "replaced"):
                with self.subTest(arguments, turn=turn):
                    result = run(*arguments)
                    self.assertEqual(result.returncode, 0, result.stderr)

    def test_a_checkpoint_in_a_dataset_is_gone_on_from(self):
        dataset = self.folder / "dataset"
        shutil.copytree(self.dataset, dataset)
        output = dataset / "maps" / "a.hmap"
        output.parent.mkdir()
        mapping = ["map", "--input", dataset, "--output", output, "--checkpoint-every", 5]
        checkpoint = pathlib.Path(f"{output}.checkpoint")
        command = [str(PROGRAM), "--progress", "always", *map(str, mapping)]
        for _ in range(20):  # a run may end before it is killed
            with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) as child:
                while not checkpoint.exists() and child.poll() is None:
                    child.stderr.readline()
                child.kill()
            if checkpoint.exists():
                break
        self.assertTrue(checkpoint.exists())
        resumed = run(*mapping, "--resume")
        self.assertEqual(resumed.returncode, 0, resumed.stderr)

    def test_what_is_no_map_is_never_replaced_by_one(self):
        text = self.folder / "notes.txt"
        text.write_bytes(OLD)
        result = run("map", "--input", self.dataset, "--output", text)
        self.assertEqual(result.returncode, 4, result.stderr)
        self.assertIn("must end in .hmap", result.stderr)
        result = run("map", "--input", self.dataset, "--output", self.folder / "a", "--stats", text)
        self.assertEqual(result.returncode, 4, result.stderr)
        self.assertIn("must end in .json", result.stderr)
        self.assertEqual(text.read_bytes(), OLD)
        self.assert_names("notes.txt")


if __name__ == "__main__":
    unittest.main(verbosity=1)
