#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Recorded sequences whose description is wrong: what is said of them, and by which field.

Usage: misreadings_test.py PROGRAM [unittest args]"""

import math
import pathlib
import shutil
import tempfile
import unittest

from program import DATA, IS_SANITIZED, run

INTRINSICS = "intrinsics: {{width: 640, height: 480, fx: {0}, fy: {1}, cx: {2}, cy: {3}}}\n"


def quaternion(rows):
    """x, y, z, w of a rotation, by Shepperd's choice of the largest."""
    (a, b, c), (d, e, f), (g, h, i) = rows
    squares = [1 + a - e - i, 1 - a + e - i, 1 - a - e + i, 1 + a + e + i]
    largest = max(range(4), key=lambda k: squares[k])
    s = 2 * math.sqrt(squares[largest])
    return [(s / 4, (b + d) / s, (c + g) / s, (h - f) / s),
            ((b + d) / s, s / 4, (f + h) / s, (c - g) / s),
            ((c + g) / s, (f + h) / s, s / 4, (d - b) / s),
            ((h - f) / s, (c - g) / s, (d - b) / s, s / 4)][largest]


class Sequence:
    """A recorded sequence in a folder where its description can be written; links to its images."""

    def __init__(self, folder, name):
        self.folder = folder / name
        self.source = DATA / "rgbd" / name
        self.folder.mkdir(exist_ok=True)

    def link(self, *patterns):
        for pattern in patterns:
            for path in sorted(self.source.glob(pattern)):
                link = self.folder / path.relative_to(self.source)
                link.parent.mkdir(parents=True, exist_ok=True)
                if not link.exists():
                    link.symlink_to(path)

    def describe(self, **changed):
        keys = {**self.KEYS, **changed}
        text = self.CAMERA + "".join(f"{key}: {value}\n" for key, value in keys.items())
        (self.folder / "dataset.yaml").write_text(text)
        return self.folder

    def stamp(self, unit_per_s):
        """Images ten a second from 1 s on, poses of the same moments in another unit."""
        poses = self.poses()
        images = sorted(path.relative_to(self.folder) for path in self.folder.glob(self.KEYS["depth"].strip('"')))
        (self.folder / "depth_list.txt").write_text(
            "".join(f"{1 + i / 10:.1f} {image}\n" for i, image in enumerate(images)))
        (self.folder / "stamped.txt").write_text("".join(
            f"{f'{1 + i / 10:.1f}' if unit_per_s == 1 else (10 + i) * unit_per_s // 10} {' '.join(map(str, pose))}\n" for i, pose in enumerate(poses)))
        return self.describe(depth="depth_list.txt", trajectory="stamped.txt", trajectory_format="tum",
                             pair_by="stamp")

    @staticmethod
    def tum_pose(rows):
        return [rows[i][3] for i in range(3)] + list(quaternion([row[:3] for row in rows[:3]]))


class Kitchen(Sequence):
    NAME = "7scenes_redkitchen"
    CAMERA = INTRINSICS.format(585, 585, 320, 240)
    KEYS = {"depth": '"frame-*.depth.png"', "depth_scale": 1000, "trajectory": '"frame-*.pose.txt"',
            "trajectory_format": "matrix", "pair_by": "number"}

    def __init__(self, folder):
        super().__init__(folder, self.NAME)
        self.link("frame-*.depth.png", "frame-*.pose.txt")

    def poses(self):
        return [self.tum_pose([[float(word) for word in line.split()] for line in path.read_text().splitlines()])
                for path in sorted(self.folder.glob("frame-*.pose.txt"))]


class Cabinet(Sequence):
    NAME = "tum_fr3_cabinet"
    CAMERA = INTRINSICS.format(535.4, 539.2, 320.1, 247.6)
    KEYS = {"depth": "depth_imgs/*_depth_raw.png", "depth_scale": 5000, "trajectory": "truth_cam_poses.txt",
            "trajectory_format": "tum", "pair_by": "order", "up_axis": "z"}

    def __init__(self, folder):
        super().__init__(folder, self.NAME)
        self.link("depth_imgs/*.png", "truth_cam_poses.txt")

    def poses(self):
        lines = (self.folder / "truth_cam_poses.txt").read_text().splitlines()
        return [line.split()[1:] for line in lines if line.strip()]


class LivingRoom(Sequence):
    NAME = "icl_nuim_livingroom1"
    CAMERA = INTRINSICS.format(525, 525, 319.5, 239.5)
    KEYS = {"depth": "depth/*.png", "depth_scale": 1000, "trajectory": "test_scene/trajectory.log",
            "trajectory_format": "log", "pair_by": "number"}

    def __init__(self, folder):
        super().__init__(folder, self.NAME)
        self.link("depth/*.png", "test_scene/trajectory.log")

    def poses(self):
        numbers = [[float(word) for word in line.split()]
                   for line in (self.folder / "test_scene/trajectory.log").read_text().splitlines()]
        by_number = {int(numbers[i][0]): self.tum_pose(numbers[i + 1:i + 5]) for i in range(0, len(numbers) - 4, 5)}
        return [by_number[int(path.stem)] for path in sorted((self.folder / "depth").glob("*.png"))]


class Misreadings(unittest.TestCase):
    SEQUENCES = (Cabinet,) if IS_SANITIZED else (Kitchen, Cabinet, LivingRoom)  # a sanitizer sees one path only

    def setUp(self):
        if not (DATA / "rgbd").exists():
            self.skipTest(f"test data not present: {DATA / 'rgbd'}")
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="hypermap-misread-"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.output = self.folder / "a.hmap"

    def strictly_mapped(self, folder, *arguments):
        return run("map", "--input", folder, "--output", self.output, "--strict", *arguments)

    def assert_named(self, folder, *words):
        """Refused before the work under --strict, with these words."""
        self.output.unlink(missing_ok=True)
        result = self.strictly_mapped(folder)
        self.assertEqual(result.returncode, 2, result.stderr)
        for word in words:
            self.assertIn(word, result.stderr)
        self.assertFalse(self.output.exists())

    def each(self):
        for kind in self.SEQUENCES:
            with self.subTest(kind.NAME):
                yield kind(self.folder)

    def test_a_wrong_scale_is_named(self):
        for sequence in self.each():
            scale = sequence.KEYS["depth_scale"]
            for factor in (0.1, 10) if IS_SANITIZED else (0.1, 0.2, 5, 10):
                with self.subTest(factor=factor):
                    self.assert_named(sequence.describe(depth_scale=scale * factor),
                                      f'better: with "depth_scale: {scale}"')

    def test_poses_of_the_other_direction_are_named(self):
        for sequence in self.each():
            self.assert_named(sequence.describe(pose_direction="world_to_camera"),
                              'better: with "pose_direction: camera_to_world"')

    def test_other_camera_axes_are_named(self):
        for sequence in self.each():
            for axes in ("opengl", "robot"):
                with self.subTest(axes):
                    self.assert_named(sequence.describe(camera_axes=axes), 'better: with "camera_axes: optical"')

    def test_an_axis_up_that_no_camera_holds_is_named(self):
        for sequence in self.each():
            up = {Cabinet: "z"}.get(type(sequence), "-y")
            wrong = {"z": ("-z", "y"), "-y": ("y", "z")}[up]
            for axis in wrong:
                with self.subTest(axis):
                    self.assert_named(sequence.describe(up_axis=axis), f"with --up={up}")

    def test_nanoseconds_for_seconds_are_named(self):
        for sequence in self.each():
            result = self.strictly_mapped(sequence.stamp(1))
            self.assertEqual(result.returncode, 0, result.stderr)
            self.output.unlink()
            self.assert_named(sequence.stamp(10**9), "its stamps are taken as nanoseconds")

    def test_without_strict_the_map_is_made_and_the_fault_said(self):
        for sequence in self.each():
            scale = sequence.KEYS["depth_scale"]
            folder = sequence.describe(depth_scale=scale * 5, up_axis=sequence.KEYS.get("up_axis", "-y"))
            result = run("map", "--input", folder, "--output", self.output, "--max-frames", 40)
            self.assertEqual(result.returncode, 1, result.stderr)
            self.assertIn(f'"depth_scale: {scale}"', result.stderr)
            self.assertTrue(self.output.exists())
            self.output.unlink()
            checked = run("check", folder)
            self.assertEqual(checked.returncode, 1, checked.stderr)
            self.assertIn(f'"depth_scale: {scale}"', checked.stdout + checked.stderr)
            outside = self.folder / "outside.yaml"
            (folder / "dataset.yaml").rename(outside)
            same = run("check", folder, "--dataset", outside)
            self.assertEqual((same.returncode, same.stdout), (checked.returncode, checked.stdout))
            self.assertEqual(run("info", folder, "--dataset", outside).returncode, 0)

    def test_what_is_described_right_is_left_alone_at_any_stride(self):
        for sequence in self.each():
            folder = sequence.describe(up_axis=sequence.KEYS.get("up_axis", "-y"))
            for stride in (5, 21) if IS_SANITIZED else (1, 2, 3, 5, 8, 13, 21):
                with self.subTest(stride=stride):
                    result = self.strictly_mapped(folder, "--stride", stride, "--resolution", 0.2)
                    self.assertEqual(result.returncode, 0, result.stderr)
                    self.output.unlink()

    def test_a_description_without_a_scale_is_refused(self):
        for sequence in self.each():
            folder = sequence.describe()
            text = (folder / "dataset.yaml").read_text()
            (folder / "dataset.yaml").write_text("\n".join(
                line for line in text.splitlines() if not line.startswith("depth_scale")) + "\n")
            for command in (("map", "--input", folder, "--output", self.output), ("check", folder)):
                result = run(*command)
                self.assertEqual(result.returncode, 2, result.stdout + result.stderr)
                self.assertIn("must name depth_scale", result.stdout + result.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=1)
