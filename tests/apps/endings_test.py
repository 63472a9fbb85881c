#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""How runs of `map` end that do not go as they should: wrong poses, kills, folders that go.

Usage: endings_test.py PROGRAM [unittest args]"""

import os
import shutil
import signal
import subprocess
import unittest

from contract_case import Case
from program import PROGRAM, digest, run, run_measured
from tiny_dataset import make_dataset


class Endings(Case):
    def moved(self, position):
        """Six frames, the fourth of them at another position."""
        stamps = [f"{i / 10:.1f}" for i in range(1, 7)]
        dataset = make_dataset(self.folder / "moved", stamps=stamps, size=(160, 120))
        lines = [f"{stamp} {position if i == 3 else '0 0 1'} 0 0 0 1\n" for i, stamp in enumerate(stamps)]
        (dataset / "groundtruth.txt").write_text("".join(lines))
        return dataset

    def test_one_wrong_pose_costs_no_run(self):
        for position in ("1000 1000 1", "780 780 1"):
            with self.subTest(position):
                dataset = self.moved(position)
                output = self.folder / "a.hmap"
                result = run_measured("map", "--input", dataset, "--output", output)
                self.assertEqual(result.returncode, 1, result.stderr)
                self.assertRegex(result.stderr, r"a\.hmap: layers: leave out \d+ voxels .* of frame depth/3\.png")
                self.assertLess(result.peak_bytes, 1 << 30)
                self.assertEqual(run("query", output, "--layer", "occupancy", "--at", "0,0").returncode, 0)
                shutil.rmtree(dataset)

    def test_wrong_poses_everywhere_are_named_by_frame(self):
        dataset = self.moved("1e6 0 1")
        result = run("map", "--input", dataset, "--output", self.folder / "a.hmap", "--max-skipped", 0.5)
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertIn("depth/3.png: map_from_camera: the sensor must stand within", result.stderr)

    def test_far_positions_are_refused_by_line_and_value(self):
        for value in ("1e9", "1e308"):
            with self.subTest(value):
                dataset = self.moved(f"{value} 0 1")
                checked = run("check", dataset / "groundtruth.txt")
                self.assertEqual(checked.returncode, 2)
                line = next(line for line in checked.stderr.splitlines() + checked.stdout.splitlines()
                            if "groundtruth.txt:4" in line)
                self.assertIn(value, line)
                self.assertLessEqual(len(line.encode()), 200)
                self.assertNotIn("inf", line)
                mapped = run("map", "--input", dataset, "--output", self.folder / "a.hmap", "--max-skipped", 0.5)
                self.assertEqual(mapped.returncode, 1, mapped.stderr)
                self.assertIn(f"is {value}", mapped.stderr)
                shutil.rmtree(dataset)

    def ended(self, number, *more):
        """A run that got the signal after its second frame."""
        output = self.folder / "a.hmap"
        command = [str(PROGRAM), "--progress", "always", "map", "--input", self.dataset, "--output", output,
                   *map(str, more)]
        with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) as child:
            child.stderr.readline()
            child.stderr.readline()
            child.send_signal(number)
            return child.stderr.read()

    def test_checkpoints_outlive_the_run_and_can_be_gone_on_from(self):
        for number in (signal.SIGINT, signal.SIGKILL):
            with self.subTest(number):
                message = self.ended(number, "--checkpoint-every", 1)
                checkpoint = self.folder / "a.hmap.checkpoint"
                self.assertTrue(checkpoint.exists())
                if number == signal.SIGINT:
                    self.assertIn(str(checkpoint), message)
                    self.assert_names("a.hmap.checkpoint")
                self.assertEqual(run("info", checkpoint).returncode, 0)
                output = self.folder / "a.hmap"
                checkpoint.rename(output)
                result = run("map", "--input", self.dataset, "--output", output, "--append",
                             "--same-world", "--force")
                self.assertEqual(result.returncode, 0, result.stderr)
                self.assert_names("a.hmap")
                output.unlink()

    def test_checkpoints_change_no_byte_and_go_with_the_map(self):
        output = self.folder / "a.hmap"
        result = run("map", "--input", self.dataset, "--output", output, "--checkpoint-every", 7)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(digest(output), digest(self.archive))
        self.assert_names("a.hmap")

    def test_a_map_whose_folder_went_is_rescued(self):
        out = self.folder / "out"
        working = self.folder / "working"
        for folder in (out, working):
            folder.mkdir()
        command = [str(PROGRAM), "--progress", "always", "map", "--input", self.dataset, "--output", out / "a.hmap"]
        with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                              cwd=working) as child:
            child.stderr.readline()
            out.rmdir()
            message = child.stderr.read()
        self.assertEqual(child.returncode, 3, message)
        rescued = working / "a.hmap.rescue"
        self.assertIn(str(rescued), message)
        self.assertEqual(digest(rescued), digest(self.archive))
        self.assertEqual(os.listdir(working), [rescued.name])


if __name__ == "__main__":
    unittest.main(verbosity=1)
