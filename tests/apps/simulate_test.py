#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The options of `simulate`: what each does to the dataset and its truth.

Usage: simulate_test.py PROGRAM [unittest args]"""

import json
import math
import pathlib
import shutil
import tempfile
import unittest

from program import IS_SANITIZED, repetitions, run

SMALL = ("--size", "80x60", "--seed", 3)
NUM_FRAMES = repetitions(40)


class Simulate(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="hypermap-simulate-"))
        self.addCleanup(shutil.rmtree, self.folder)

    def simulated(self, *options, scene="laboratory"):
        folder = self.folder / "lab"
        result = run("simulate", "--scene", scene, "--output", folder, *SMALL, *options)
        self.assertEqual(result.returncode, 0, result.stderr)
        return folder

    def refused(self, *options, status=4):
        result = run("simulate", "--output", self.folder / "lab", *SMALL, *options)
        self.assertEqual(result.returncode, status, result.stdout + result.stderr)
        return result.stderr

    def num_detections(self, *options):
        lines = (self.simulated("--frames", NUM_FRAMES, *options) / "detections.jsonl").read_text().splitlines()
        return sum(len(json.loads(line).get("detections", [])) for line in lines)

    def assert_poisson(self, count, mean):
        """Within four standard deviations of the mean."""
        self.assertLess(abs(count - mean), 4 * math.sqrt(mean))

    def images(self, folder):
        return [line.split()[1] for line in (folder / "rgb.txt").read_text().splitlines() if line[0] != "#"]

    def test_size_steps_and_passes(self):
        folder = self.simulated("--frames", 7, "--frame-step", 3, "--passes", 2)
        self.assertEqual(self.images(folder), [f"rgb/{number:06d}.png" for number in (0, 3, 6, 7, 10, 13)])
        camera = json.loads((folder / "intrinsics.json").read_text())
        self.assertEqual((camera["width"], camera["height"]), (80, 60))
        self.assertAlmostEqual(camera["fx"], 525 / 8)
        self.assertEqual((folder / "rgb/000000.png").read_bytes()[16:24], bytes((0, 0, 0, 80, 0, 0, 0, 60)))

    def test_rates_of_the_detector(self):
        without = self.num_detections("--false-alarms", 0, "--miss-rate", 1)
        self.assertEqual(without, 0)
        alarms = self.num_detections("--false-alarms", 5, "--miss-rate", 1)
        self.assert_poisson(alarms, NUM_FRAMES * 5)
        # The worse one has one more false alarm a frame, and a rate that is given goes before the name.
        worse = self.num_detections("--detector", "worse", "--miss-rate", 1)
        self.assert_poisson(worse, NUM_FRAMES * 1.3)

    @unittest.skipIf(IS_SANITIZED, "compares values; a sanitizer sees them made in the tests of the simulator")
    def test_heights_speed_and_noise_of_poses(self):
        def poses(*options):
            lines = (self.simulated("--frames", 4, *options) / "groundtruth.txt").read_text().splitlines()
            return [[float(word) for word in line.split()] for line in lines if line[0] != "#"]

        usual, low, fast = poses(), poses("--lens-height", 0.7), poses("--speed", 2)
        self.assertEqual({pose[3] for pose in low}, {0.7})
        self.assertAlmostEqual(usual[-1][0] / fast[-1][0], 2, places=4)
        self.assertEqual([pose[1:] for pose in usual], [pose[1:] for pose in fast])
        shifted, turned = poses("--pose-noise-m", 0.01), poses("--pose-noise-rad", 0.01)
        for before, moved, tilted in zip(usual, shifted, turned):
            self.assertTrue(all(0 < abs(a - b) < 0.06 for a, b in zip(before[1:4], moved[1:4])))
            self.assertEqual(before[4:], moved[4:])
            self.assertEqual(before[1:4], tilted[1:4])
            self.assertNotEqual(before[4:], tilted[4:])

    def test_changes_stand_in_the_truth(self):
        folder = self.simulated("--frames", 3, "--passes", 2, "--moved", 2, "--removed", 1, "--added", 1)
        layers = run("info", folder / "truth.hmap").stdout
        self.assertIn("changes", layers)
        found = json.loads(run("query", folder / "truth.hmap", "--layer", "changes", "--area",
                               "-10 -10,10 -10,10 10,-10 10", "--json").stdout)["results"]
        self.assertEqual(len(found), 4)
        for change in ("--moved", "--removed", "--added"):
            with self.subTest(change):
                told = self.refused("--passes", 1, change, 2)
                self.assertIn(change, told)
                self.assertIn("--passes must be 2 or more, is 1", told)
                self.assertNotIn("num_passes", told)
        self.assertIn("changes.num_removed", self.refused("--passes", 2, "--removed", 99, status=2))

    def test_masks_stand_beside_the_boxes_of_things(self):
        def masks(*options):
            lines = (self.simulated("--frames", 3, *options) / "detections.jsonl").read_text().splitlines()
            return [found.get("mask") for line in lines for found in json.loads(line).get("detections", [])]

        self.assertEqual(set(masks()), {None})
        exact = masks("--detector", "perfect", "--masks")
        self.assertTrue(exact and all(mask["size"] == [60, 80] for mask in exact))
        noisy = masks("--masks", "--false-alarms", 0)
        self.assertTrue(noisy and None not in noisy)
        self.assertNotEqual(noisy, exact)
        alarms = masks("--masks", "--false-alarms", 20, "--miss-rate", 1)
        self.assertEqual(set(alarms), {None})

    def test_a_perfect_detector_has_no_rates(self):
        for rate in ("--miss-rate", "--false-alarms", "--box-noise", "--wrong-class"):
            with self.subTest(rate):
                self.assertIn(f"{rate}: --detector perfect", self.refused("--detector", "perfect", rate, 0.5))

    def test_one_is_singular(self):
        result = run("simulate", "--output", self.folder / "one", *SMALL, "--frames", 1, "--miss-rate", 1, "--false-alarms", 0)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertRegex(result.stdout, r"^1 frame and 0 detections of \d\d+ objects in ")
        archive = self.folder / "one.hmap"
        mapped = run("map", "--input", self.folder / "one", "--output", archive)
        self.assertIn("1 frame, 0 detections, 0 of them", mapped.stdout)
        self.assertIn("0 objects (and 0 tentative)", mapped.stdout)
        self.assertIn(", 1 frame (1 depth, 1 colour, 1 pose)", run("info", self.folder / "one").stdout)

    def test_what_is_no_value_is_a_wrong_command_line(self):
        for options in (("--frame-step", 0), ("--passes", 0), ("--speed", 0), ("--lens-height", 0.01),
                        ("--pose-noise-m", -1), ("--pose-noise-rad", "nan"), ("--miss-rate", 1.5),
                        ("--false-alarms", 21), ("--box-noise", -0.1), ("--wrong-class", 2), ("--moved", -1),
                        ("--removed", 101), ("--added", "two"), ("--detector", "worst")):
            with self.subTest(options):
                self.assertIn(options[0], self.refused(*options))
        for size in ("80", "80x", "x60", "80x60x2", "0x60", "80x70000", "-80x60", "80 x 60", ""):
            with self.subTest(size):
                result = run("simulate", "--output", self.folder / "lab", f"--size={size}")
                self.assertEqual(result.returncode, 4, result.stderr)


if __name__ == "__main__":
    unittest.main()
