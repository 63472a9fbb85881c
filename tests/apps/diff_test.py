#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What changed between two maps of a place.

Usage: diff_test.py PROGRAM [unittest args]"""

import json
import math
import pathlib
import shutil
import tempfile
import unittest

from program import run

PASS = 120  # frames


def moved(line):
    """A pose as one sees it whose origin lies at 1 m, 0.5 m, turned by 90 degrees."""
    stamp, x, y, z, qx, qy, qz, qw = map(float, line.split())
    half = math.sqrt(0.5)
    return " ".join(map(repr, (stamp, y - 0.5, 1.0 - x, z, half * (qx + qy), half * (qy - qx), half * (qz - qw),
                               half * (qw + qz))))


class Changes(unittest.TestCase):
    """A laboratory in two passes; before the second some things are moved, removed and added."""

    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="hypermap-diff-"))
        cls.data = cls.folder / "lab"
        cls.before, cls.after = cls.folder / "before.hmap", cls.folder / "after.hmap"
        cls.on, cls.part = cls.folder / "on.hmap", cls.folder / "part.hmap"
        of_pass = ("--max-frames", PASS, "--resolution", 0.05)
        steps = [("simulate", "--frames", PASS, "--seed", 3, "--passes", 2, "--moved", 2, "--removed", 2, "--added", 1,
                  "--detector", "perfect", "--size", "480x360", "--output", cls.data),
                 ("map", "--input", cls.data, "--output", cls.before, *of_pass),
                 ("map", "--input", cls.data, "--output", cls.after, *of_pass, "--first", PASS),
                 ("map", "--input", cls.data, "--output", cls.part, "--resolution", 0.05, "--first", PASS, "--max-frames", PASS // 6)]
        cls.failed = [result.stderr for result in (run(*step) for step in steps) if result.returncode not in (0, 1)]
        shutil.copy(cls.before, cls.on)
        on = run("map", "--input", cls.data, "--output", cls.on, "--append", "--same-world", "--first", PASS)
        cls.failed += [on.stderr] if on.returncode not in (0, 1) else []

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def setUp(self):
        self.assertEqual(self.failed, [])

    def diff(self, *arguments, status=1):
        result = run("diff", *arguments, "--json")
        self.assertEqual(result.returncode, status, f"{arguments}: {result.stdout}{result.stderr}")
        return json.loads(result.stdout)

    def kinds(self, report):
        return {kind: count for kind, count in report["counts"].items() if count}

    def test_names_the_changes_and_nothing_else(self):
        # One of the two suitcases is new, 4.8 m from where the other one is gone: by default it is one that moved.
        for after in (self.after, self.on):
            with self.subTest(after.name):
                report = self.diff(self.before, after, "--max-move", 4)
                self.assertEqual({kind: report["counts"][kind] for kind in ("moved", "gone", "added", "re_classed")},
                                 {"moved": 2, "gone": 2, "added": 1, "re_classed": 0}, report["counts"])
                self.assertEqual(report["goes_on"], after == self.on)
                for change in report["changes"]:
                    if change["change"] == "moved":
                        self.assertEqual(change["before"]["name"], change["after"]["name"])
                        self.assertGreater(change["distance_m"], 0.2)

    def test_a_map_differs_from_itself_in_nothing(self):
        report = self.diff(self.before, self.before, status=0)
        self.assertEqual(list(self.kinds(report)), ["same"])
        told = run("diff", self.before, self.before)
        self.assertEqual(told.stdout, f"{report['counts']['same']} same\n")
        self.assertEqual(len(run("diff", self.before, self.before, "--all").stdout.splitlines()),
                         report["counts"]["same"] + 3)

    def test_what_a_part_of_a_pass_did_not_show_is_not_gone(self):
        whole, part = self.diff(self.before, self.after), self.diff(self.before, self.part)
        self.assertGreater(part["counts"]["not_looked_at"], 3)

        def ids(report, *kinds):
            return {change["before"]["id"] for change in report["changes"] if change["change"] in kinds}

        self.assertLessEqual(ids(part, "gone"), ids(whole, "gone", "moved"))
        objects = self.diff(self.before, self.before, status=0)["counts"]["same"]
        self.assertEqual(sum(1 for change in part["changes"] if change["before"]), objects)

    def test_there_and_back_are_mirrors(self):
        there, back = self.diff(self.before, self.after)["counts"], self.diff(self.after, self.before)["counts"]
        self.assertEqual((there["gone"], there["moved"], there["added"]), (back["added"], back["moved"], back["gone"]))

    def test_a_map_of_another_origin_is_brought_back(self):
        elsewhere, turned = self.folder / "elsewhere", self.folder / "turned.hmap"
        elsewhere.mkdir()
        for path in self.data.iterdir():
            (elsewhere / path.name).symlink_to(path)
        poses = elsewhere / "groundtruth.txt"
        lines = poses.read_text().splitlines()
        poses.unlink()
        poses.write_text("\n".join(line if line.startswith("#") else moved(line) for line in lines) + "\n")
        mapped = run("map", "--input", elsewhere, "--output", turned, "--resolution", 0.05, "--max-frames", PASS)
        self.assertIn(mapped.returncode, (0, 1), mapped.stderr)
        self.assertEqual(list(self.kinds(self.diff(self.before, turned, "--transform", "1,0.5,0,90", status=0))), ["same"])
        self.assertIn("gone", self.kinds(self.diff(self.before, turned)))

    def test_layer_and_image(self):
        marked, image = self.folder / "marked.hmap", self.folder / "changes.png"
        report = self.diff(self.before, self.after, "--output", marked, "--image", image)
        self.assertEqual(image.read_bytes()[:8], b"\x89PNG\r\n\x1a\n")
        found = json.loads(run("query", marked, "--layer", "changes", "--string", "gone*", "--json").stdout)["results"]
        self.assertEqual(len(found), report["counts"]["gone"])
        self.assertEqual(run("check", marked).returncode, 0)

    def test_what_cannot_be_compared_is_refused(self):
        cases = ((["diff", self.before], 4, "after"),
                 (["diff", self.before, self.folder / "none.hmap"], 3, "none.hmap"),
                 (["diff", self.data / "truth.hmap", self.before], 2, "truth.hmap: has no semantic octree"),
                 (["diff", self.before, self.after, "--transform", "1,2"], 4, "--transform"),
                 (["diff", self.before, self.after, "--max-move", -1], 4, "--max-move"),
                 (["diff", self.before, self.after, "--output", self.before], 4, "--output"),
                 (["diff", self.before, self.after, "--output", self.folder / "x.png"], 4, ".hmap"),
                 (["diff", self.before, self.after, "--image", self.folder / "x.hmap"], 4, ".png"))
        for arguments, status, told in cases:
            with self.subTest(arguments=arguments):
                result = run(*arguments)
                self.assertEqual(result.returncode, status, result.stdout + result.stderr)
                self.assertIn(told, result.stderr)


if __name__ == "__main__":
    unittest.main()
