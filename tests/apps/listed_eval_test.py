#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""`eval` with a list of what stands in a sequence as truth. Usage: listed_eval_test.py PROGRAM [unittest args]"""

import json
import pathlib
import shutil
import tempfile
import unittest

from program import SOURCE, run


class ListedThings(unittest.TestCase):
    """A map of a small room, held against lists made from what the map itself says."""

    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="hypermap-listed-"))
        cls.dataset = cls.folder / "room"
        cls.archive = cls.folder / "room.hmap"
        cls.made = [run("simulate", "--output", cls.dataset, "--frames", 24, "--size", "320x240", "--seed", 1,
                        "--detector", "perfect"),
                    run("map", "--input", cls.dataset, "--output", cls.archive, "--up", "z")]

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def setUp(self):
        for result in self.made:
            self.assertEqual(result.returncode, 0, result.stderr)
        provenance = json.loads(run("info", self.archive, "--json").stdout)["provenance"]
        self.sequence = provenance["input"]
        self.objects = json.loads(run("query", self.archive, "--layer", "objects", "--json").stdout)["results"]
        self.assertGreaterEqual(len(self.objects), 4)

    def things(self):
        """Every object of the map as a listed thing."""
        return [{"name": f"thing_{thing['id']}", "class": thing["name"], "centre": thing["position"],
                 "size": thing["size_m"], "first_frame": 0, "marks": [{"frame": 0, "pixel": [1, 2]}]}
                for thing in self.objects]

    def listed(self, things, **head):
        """A file with these things; YAML takes JSON, but for the lines of its head."""
        head = {"format": "hypermap-sequence-truth", "version": 1, "sequence": self.sequence, "up": [0, 0, 1], **head}
        path = self.folder / "truth.yaml"
        lines = [f"{key}: {json.dumps(value)}" for key, value in head.items()]
        lines[0] = f"format: {head['format']}"
        path.write_text("\n".join([*lines, "things:", *(f"  - {json.dumps(thing)}" for thing in things), ""]))
        return path

    def evaluated(self, things, *arguments):
        result = run("eval", "--map", self.archive, "--truth", self.listed(things), "--json", *arguments)
        self.assertEqual(result.returncode, 0, result.stderr)
        return json.loads(result.stdout)

    def refusal(self, things, *arguments, **head):
        result = run("eval", "--map", self.archive, "--truth", self.listed(things, **head), *arguments)
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertEqual(result.stdout, "")
        self.assertTrue(result.stderr.startswith("hypermap: "), result.stderr)
        return result.stderr

    def test_what_the_map_shows_is_right(self):
        report = self.evaluated(self.things())
        counts = report["counts"]
        self.assertEqual(counts["counted"], len(self.objects))
        self.assertEqual(counts["right"], len(self.objects), report)
        self.assertEqual(counts["false"], 0)
        for thing, shown in zip(report["things"], self.objects):
            self.assertEqual(thing["object"]["id"], shown["id"])
            self.assertLess(thing["distance_m"], 0.02)
        self.assertEqual(report["tolerances"],
                         {"distance_m": 0.25, "side_share": 0.4, "chair_height_share": 0.2, "frames_named": 3})

    def test_faults_are_told_by_kind(self):
        things = self.things()
        gone = things.pop()
        things[0]["size"] = [2 * side for side in things[0]["size"]]
        things.append({**gone, "name": "unreal", "centre": [90, 0, 0]})
        report = self.evaluated(things)
        counts = report["counts"]
        self.assertEqual((counts["missed"], counts["false"]), (1, 1))
        self.assertEqual(counts["right"], len(self.objects) - 2)
        self.assertFalse(report["things"][0]["right_size"])
        self.assertEqual(report["false"][0]["class"], gone["class"])
        table = run("eval", "--map", self.archive, "--truth", self.listed(things))
        self.assertEqual(table.returncode, 0, table.stderr)
        for words in ("wrong size", "missed", "on no listed thing", "centre within 0.25 m, each side within 40 %, "
                      "heights of chairs within 20 %", "not known how often things were named"):
            self.assertIn(words, table.stdout)

    def test_what_does_not_count_is_told_apart(self):
        things = self.things()
        things[0]["no_depth"] = True
        things[1]["unnameable"] = True
        del things[1]["class"]
        things[2]["class"] = ["zeppelin"]
        things[3]["class"] = ["zeppelin", things[3]["class"]]
        report = self.evaluated(things)
        self.assertEqual([thing["standing"] for thing in report["things"][:4]],
                         ["no depth", "no word", "no word", "counts"])
        self.assertEqual(report["things"][1]["others"][0]["id"], self.objects[1]["id"])
        self.assertEqual(report["counts"]["counted"], len(self.objects) - 3)
        self.assertEqual(report["counts"]["false"], 0)

    def test_frames_that_name_a_thing_are_counted(self):
        report = self.evaluated(self.things(), "--input", self.dataset)
        self.assertEqual(report["frames"], 24)
        self.assertGreaterEqual(max(thing["frames_named"] for thing in report["things"]), 3)
        for thing in report["things"]:
            self.assertEqual(thing["standing"], "counts" if thing["frames_named"] >= 3 else "rarely seen")

    def test_another_sequence_is_a_warning(self):
        result = run("eval", "--map", self.archive, "--truth", self.listed(self.things(), sequence="elsewhere"))
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertIn("warning: ", result.stderr)
        self.assertIn("elsewhere", result.stderr)
        self.assertIn("things that count are right", result.stdout)

    def test_wrong_lists_are_refused_by_thing_and_field(self):
        def broken(**keys):
            things = self.things()
            things[1].update(keys)
            return things
        for things, words in ((broken(size=[1, -1, 1]), ("things[1].size[1]", "0.001", "-1")),
                              (broken(centre=[0, 0, "far"]), ("things[1].centre[2]", "far")),
                              (broken(color="red"), ("things[1].color", "unknown key"))):
            text = self.refusal(things)
            for word in (*words, "truth.yaml", f"(of thing thing_{self.objects[1]['id']})"):
                self.assertIn(word, text)
        self.assertIn("must be 1, is 2", self.refusal([], version=2))
        huge = self.listed(self.things())
        huge.write_text(huge.read_text() + "#" * (5 << 20))
        result = run("eval", "--map", self.archive, "--truth", huge)
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertIn("the limit is 4194304", result.stderr)

    def test_options_of_the_other_kind_of_truth_are_refused(self):
        truth = self.dataset / "truth.hmap"
        for arguments in (("--against", self.archive), ("--also", self.archive, truth), ("--classes", "chair"),
                          ("--reliability", self.folder / "plot.png")):
            self.assertIn(f"{arguments[0]}: needs an archive as truth", self.refusal(self.things(), *arguments))
        result = run("eval", "--map", self.archive, "--truth", truth, "--input", self.dataset)
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertIn("--input: needs a list of things as truth", result.stderr)
        result = run("eval", "--map", self.archive, "--truth", truth, "--detections", self.dataset / "detections.jsonl")
        self.assertEqual(result.returncode, 4, result.stderr)

    def test_lists_that_ship_need_a_map_of_their_sequence(self):
        for path in sorted((SOURCE / "data/truth").glob("*.yaml")):
            result = run("eval", "--map", self.archive, "--truth", path)
            self.assertEqual(result.returncode, 1, result.stderr)
            self.assertIn("no run of the map is of the sequence", result.stderr)


if __name__ == "__main__":
    unittest.main()
