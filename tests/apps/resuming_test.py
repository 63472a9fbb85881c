#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs of `map` that are interrupted and go on from their checkpoint with --resume.

Usage: resuming_test.py PROGRAM [unittest args]"""

import json
import os
import pathlib
import shutil
import signal
import subprocess
import tempfile
import unittest

from program import IS_SANITIZED, PROGRAM, digest, run
from tiny_dataset import make_dataset

NUM_FRAMES = 24


class Resuming(unittest.TestCase):
    """A simulated room with objects that are seen, missed and removed, and its map in one go."""

    @classmethod
    def setUpClass(cls):
        cls.shared = pathlib.Path(tempfile.mkdtemp(prefix="hypermap-resuming-"))
        cls.dataset = cls.shared / "lab"
        cls.simulated = run("simulate", "--frames", NUM_FRAMES, "--seed", 5, "--detector", "noisy",
                            "--output", cls.dataset)
        cls.whole = cls.shared / "whole.hmap"
        cls.mapped = run("map", "--input", cls.dataset, "--output", cls.whole)

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.shared)

    def setUp(self):
        self.assertEqual(self.simulated.returncode, 0, self.simulated.stderr)
        self.assertEqual(self.mapped.returncode, 0, self.mapped.stderr)
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="hypermap-resuming-"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.output = self.folder / "a.hmap"
        self.checkpoint = self.folder / "a.hmap.checkpoint"
        self.command = ["map", "--input", self.dataset, "--output", self.output]

    def interrupted(self, number, num_lines, *more):
        """The command gets the signal when it has said so many lines of progress; (exit code, what it said then)."""
        command = [str(PROGRAM), "--progress", "always", *map(str, self.command), *map(str, more)]
        with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) as child:
            said = [child.stderr.readline() for _ in range(num_lines)]
            self.assertTrue(said[-1].startswith("mapping "), said)
            child.send_signal(number)
            message = child.stderr.read()
        return child.returncode, message

    def resumed(self, *more):
        result = run(*self.command, "--resume", *more)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result

    def test_an_interrupted_run_goes_on_to_the_same_bytes(self):
        for number in (signal.SIGINT,) if IS_SANITIZED else (signal.SIGINT, signal.SIGTERM, signal.SIGKILL):
            with self.subTest(number):
                status, message = self.interrupted(number, 10, "--checkpoint-every", 4)
                if number == signal.SIGKILL:
                    self.assertEqual(status, -number)
                else:
                    self.assertEqual(status, 128 + number, message)
                    self.assertIn(f"is in {self.checkpoint}", message)
                    self.assertIn(f"map: --resume goes on from {self.checkpoint}\n", message)
                self.assertEqual(os.listdir(self.folder), [self.checkpoint.name])
                result = self.resumed("--stats", self.folder / "s.json")
                self.assertEqual(digest(self.output), digest(self.whole))
                self.assertFalse(self.checkpoint.exists())
                stats = json.loads((self.folder / "s.json").read_text())
                self.assertEqual(stats["frames"], NUM_FRAMES)
                self.assertIn(stats["frames_resumed"], range(8, NUM_FRAMES, 4))
                self.assertIn(f"went on after the {stats['frames_resumed']} frames", result.stdout)
                self.output.unlink()
                (self.folder / "s.json").unlink()

    def test_interrupted_twice_at_other_numbers_of_threads(self):
        self.interrupted(signal.SIGINT, 6, "--checkpoint-every", 3, "--threads", 1)
        status, message = self.interrupted(signal.SIGINT, 4, "--checkpoint-every", 5, "--threads", 2, "--resume")
        self.assertEqual(status, 128 + signal.SIGINT, message)
        self.assertIn(f"map: --resume goes on from {self.checkpoint}\n", message)
        self.resumed()
        self.assertEqual(digest(self.output), digest(self.whole))

    def test_a_run_that_appends_goes_on_with_the_same_map(self):
        first = run(*self.command, "--max-frames", 8)
        self.assertEqual(first.returncode, 0, first.stderr)
        before = self.output.read_bytes()
        append = ["--append", "--same-world", "--first", 8]
        appended = run(*self.command, *append)
        self.assertEqual(appended.returncode, 0, appended.stderr)
        expected = digest(self.output)
        self.output.write_bytes(before)
        self.interrupted(signal.SIGINT, 6, *append, "--checkpoint-every", 2)
        self.assertEqual(self.output.read_bytes(), before)
        self.resumed(*append)
        self.assertEqual(digest(self.output), expected)

    def assert_refused(self, *words, more=(), status=2):
        result = run(*self.command, "--resume", *more)
        self.assertEqual(result.returncode, status, result.stderr)
        for word in words:
            self.assertIn(word, result.stderr)

    def test_what_does_not_go_on_is_refused_by_name(self):
        self.assert_refused(f"hypermap: {self.checkpoint}: --resume: there is no checkpoint to go on from")
        self.interrupted(signal.SIGINT, 4, "--checkpoint-every", 2)
        there = digest(self.checkpoint)
        begin = f"hypermap: {self.checkpoint}: "
        for more, words in ((["--stride", 2], "stride: is 2, must be that of the run to go on with, 1"),
                            (["--first", 1], "first: is 1, must be"),
                            (["--max-frames", 5], "max_frames: is 5, must be"),
                            (["--keep-classes", "chair"], "wanted_classes: is"),
                            (["--up", "y"], "up: is y, must be"),
                            (["--resolution", 0.2], "octree.resolution_m: is 0.2, must be"),
                            (["--max-range", 3], "integration.max_range_m: is 3"),
                            (["--transient", "cat"], "transient_classes: is"),
                            (["--detections", self.dataset / "detections.jsonl"], "detections: is detections.jsonl ")):
            with self.subTest(more):
                self.assert_refused(begin + words, more=more)
                self.assertEqual(digest(self.checkpoint), there)
        self.command[2] = make_dataset(self.folder / "other")
        self.assert_refused(begin)
        self.command[2] = self.dataset
        self.resumed()
        self.assertEqual(digest(self.output), digest(self.whole))

    def test_a_checkpoint_that_is_damaged_is_refused(self):
        self.interrupted(signal.SIGINT, 4, "--checkpoint-every", 2)
        self.checkpoint.write_bytes(self.checkpoint.read_bytes()[:-100])
        self.assert_refused(str(self.checkpoint))
        self.assertFalse(self.output.exists())

    def test_a_run_that_does_not_go_on_says_that_it_could(self):
        self.interrupted(signal.SIGINT, 4, "--checkpoint-every", 2)
        there = f"map: {self.checkpoint} of an earlier run is there: --resume would go on from it; "
        left = run(*self.command, "--max-frames", 2)
        self.assertEqual(left.returncode, 0, left.stderr)
        self.assertIn(there + "this run leaves it\n", left.stderr)
        self.assertTrue(self.checkpoint.exists())
        replaced = run(*self.command, "--max-frames", 2, "--checkpoint-every", 1)
        self.assertIn(there + "the first checkpoint of this run replaces it\n", replaced.stderr)
        self.assertFalse(self.checkpoint.exists())
        self.assertEqual(run(*self.command, "--max-frames", 2).stderr, "")


if __name__ == "__main__":
    unittest.main(verbosity=1)
