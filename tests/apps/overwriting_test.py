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
        cases = [["snapshot", archive, "--output", archive], ["snapshot", archive, "--output", link],
                 ["export", archive, "--format", "ply", "--output", self.folder / "." / "a.hmap"],
                 ["export", options, "--format", "ros-map", "--output", self.folder / "options"],
                 ["export", options, "--format", "ros-map", "--output", self.folder / "options.pgm"],
                 [*mapping, "--output", dataset / "groundtruth.txt"],
                 [*mapping, "--output", dataset / "depth" / "1.png"],
                 [*mapping, "--output", options, "--config", options],
                 [*mapping, "--output", self.folder / "new", "--stats", self.folder / "new"],
                 [*mapping, "--output", self.folder / "new", "--stats", dataset / "groundtruth.txt"],
                 [*mapping, "--output", self.folder / "new", "--times-plot", dataset / "depth" / "1.png"],
                 ["snapshot", archive, "--output", dataset / "depth" / "1.png"],
                 ["snapshot", archive, "--output", self.folder / "images" / "1.png"],
                 ["snapshot", archive, "--output", self.folder / "image.png"],
                 ["tune", "--input", dataset, "--frame", 0, "--output", dataset / "depth"],
                 ["transform", archive, "--by", "0,0,0,0", "--output", dataset / "truth.hmap"],
                 [*mapping, "--output", dataset / "truth.hmap"]]
        elsewhere = self.folder / "elsewhere.yaml"
        elsewhere.write_text("depth: depth/*.png\ndepth_scale: 5000\ntrajectory: slam.json\n"
                             "intrinsics: {fx: 100, fy: 100, cx: 50, cy: 50}\n")
        shutil.copy(dataset / "groundtruth.txt", dataset / "slam.json")
        cases.append([*mapping, "--dataset", elsewhere, "--output", self.folder / "new", "--stats",
                      dataset / "slam.json"])
        shutil.copy(self.archive, dataset / "truth.hmap")
        (self.folder / "images").symlink_to(dataset / "depth")
        (self.folder / "image.png").symlink_to(dataset / "depth" / "1.png")
        before = {path: path.read_bytes() for path in self.folder.rglob("*") if path.is_file()}
        for arguments in cases:
            with self.subTest(arguments):
                result = run(*arguments)
                self.assertEqual(result.returncode, 4, result.stderr)
                self.assertRegex(result.stderr, "write over|a folder of a dataset")
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
