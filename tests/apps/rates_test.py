#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""`eval` with rates of one run or several, and times of frames. Usage: rates_test.py PROGRAM [unittest args]"""

import csv
import json
import pathlib
import shutil
import tempfile
import unittest

from program import run


class Rates(unittest.TestCase):
    """Two maps of a small room, of all of its frames and with coarser voxels."""

    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="hypermap-rates-"))
        cls.dataset = cls.folder / "room"
        cls.truth = cls.dataset / "truth.hmap"
        cls.maps = [cls.folder / "fine.hmap", cls.folder / "coarse.hmap"]
        cls.stats, cls.plot = cls.folder / "stats.json", cls.folder / "times.png"
        cls.made = [run("simulate", "--output", cls.dataset, "--frames", 24, "--size", "320x240", "--seed", 1,
                        "--detector", "noisy"),
                    run("map", "--input", cls.dataset, "--output", cls.maps[0], "--stats", cls.stats,
                        "--times-plot", cls.plot),
                    run("map", "--input", cls.dataset, "--output", cls.maps[1], "--resolution", 0.1)]

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def setUp(self):
        for result in self.made:
            self.assertEqual(result.returncode, 0, result.stderr)

    def evaluated(self, maps, *arguments, truths=None):
        return run("eval", "--map", *maps, "--truth", *(truths or [self.truth]), *arguments)

    def report(self, maps, *arguments, **options):
        result = self.evaluated(maps, "--json", "--rates", *arguments, **options)
        self.assertEqual(result.returncode, 0, result.stderr)
        return json.loads(result.stdout)

    def test_rates_are_made_of_the_counts_of_the_match(self):
        report = self.report(self.maps[:1])
        usual = json.loads(self.evaluated(self.maps[:1], "--json").stdout)
        for name, one in [("all", report["all"]), *report["classes"].items()]:
            with self.subTest(name):
                tp, fp, fn, tn = one["tp"], one["fp"], one["fn"], one["tn"]
                match = usual["one_to_one"] if name == "all" else usual["classes"].get(name, {}).get("one_to_one")
                if match:
                    self.assertEqual((tp, fp, fn), (match["matched"], match["objects"] - match["matched"],
                                                    match["truths"] - match["matched"]))
                    self.assertEqual(one["precision"], match["precision"])
                    self.assertEqual(one["tpr"], match["recall"])
                if tp + tn + fp + fn > 0:
                    self.assertAlmostEqual(one["accuracy"], (tp + tn) / (tp + tn + fp + fn))
                if fp + tn > 0:
                    self.assertAlmostEqual(one["tnr"] + one["fpr"], 1)
                    self.assertAlmostEqual(one["fpr"], fp / (fp + tn))
        tentative = [thing for thing in usual["objects"] if not thing["confirmed"]]
        self.assertLessEqual(report["all"]["tn"], len(tentative))
        self.assertEqual(report["unknown"], [])
        self.assertGreater(report["all"]["mean_ap"]["gate"], 0.3)
        self.assertLessEqual(report["all"]["mean_ap"]["iou50"], report["all"]["mean_ap"]["iou25"])

    def test_position_errors_are_those_of_the_things(self):
        report = self.report(self.maps[:1])
        found = [thing for thing in report["runs"][0]["things_found"] if thing["error_m"]]
        self.assertEqual(len(found), report["all"]["tp"])
        squares = [sum(part * part for part in thing["error_m"]) for thing in found]
        self.assertAlmostEqual(report["all"]["position"]["rmse_m"], (sum(squares) / len(squares)) ** 0.5)
        for thing in found:
            for axis in range(3):
                self.assertAlmostEqual(thing["error_m"][axis], thing["true_position"][axis] - thing["position"][axis])
        # One run: each thing's mean error is its error.
        self.assertAlmostEqual(report["mean_errors"]["rmse_m"], report["all"]["position"]["rmse_m"])

    def test_several_maps_are_runs(self):
        report = self.report(self.maps)
        self.assertEqual([one["map"] for one in report["runs"]], ["fine.hmap", "coarse.hmap"])
        self.assertEqual(report["all"]["tp"], sum(one["tp"] for one in report["runs"]))
        precisions = [one["precision"] for one in report["runs"]]
        self.assertAlmostEqual(report["over_runs"]["precision"]["mean"], sum(precisions) / 2)
        self.assertEqual(report["over_runs"]["precision"]["n"], 2)
        for thing in report["things"]:
            self.assertEqual(thing["runs"], 2)
            self.assertLessEqual(thing["found"], 2)
        same = self.report([self.maps[0]] * 3)
        self.assertAlmostEqual(same["over_runs"]["rmse_m"]["std"], 0)
        self.assertEqual(same["over_runs"]["precision"]["interval_95"], [report["runs"][0]["precision"]] * 2)
        each = self.report(self.maps, truths=[self.truth, self.truth])
        self.assertEqual(each["all"], report["all"])
        text = self.evaluated(self.maps)
        self.assertEqual(text.returncode, 0, text.stderr)
        for word in ("TPr", "AP IoU .50", "fine.hmap", "mean", "std", "95 % +-", "over the runs", "label recall", "error x m", "RMSE", "classes of what is real"):
            self.assertIn(word, text.stdout)

    def test_means_over_maps_have_intervals(self):
        report = self.report(self.maps)
        usual = [json.loads(self.evaluated([one], "--json").stdout) for one in self.maps]
        labels = [one["voxels"] for one in usual]
        for key, values in (("f1", [one["one_to_one"]["f1"] for one in usual]),
                            ("jaccard_in_place", [one["one_to_one"]["jaccard_in_place"] for one in usual]),
                            ("label_precision", [one["precision"] for one in labels]),
                            ("label_recall", [one["recall"] for one in labels])):
            with self.subTest(key):
                over_runs = report["over_runs"][key]
                mean = sum(values) / 2
                self.assertAlmostEqual(over_runs["mean"], mean)
                # t = 12.7062 of one degree of freedom; two values deviate from their mean by s / sqrt 2.
                half = 12.7062 * abs(values[0] - mean)
                self.assertAlmostEqual(over_runs["interval_95"][0], mean - half, delta=1e-5)
                self.assertAlmostEqual(over_runs["interval_95"][1], mean + half, delta=1e-5)
        alone = self.report(self.maps[:1])["over_runs"]["f1"]
        self.assertEqual((alone["n"], alone["std"], alone["interval_95"]), (1, None, None))
        self.assertNotIn("95 %", self.evaluated(self.maps[:1], "--rates").stdout)

    def test_tables_for_spreadsheets(self):
        tables = self.folder / "tables"
        result = self.evaluated(self.maps, "--csv", tables)
        self.assertEqual(result.returncode, 0, result.stderr)
        report = self.report(self.maps)

        def rows(name):
            with open(tables / name, newline="", encoding="utf-8") as file:
                return list(csv.DictReader(file))
        classes = {row["class"]: row for row in rows("classes.csv")}
        self.assertEqual(classes.keys(), {*report["classes"], "all"})
        self.assertEqual(float(classes["all"]["PRE"]), report["all"]["precision"])
        self.assertEqual(int(classes["chair"]["TN"]), report["classes"]["chair"]["tn"])
        self.assertEqual([row["map"] for row in rows("runs.csv")], ["fine.hmap", "coarse.hmap"])
        self.assertEqual(len(rows("things.csv")), len(report["things"]))
        self.assertEqual(len(rows("positions.csv")), sum(len(one["things_found"]) for one in report["runs"]))
        false = rows("false.csv")
        self.assertEqual(len(false), report["all"]["fp"])
        self.assertEqual([(row["object"], row["class"], float(row["x_m"])) for row in false],
                         [(str(one["object"]), one["class"], one["position"][0])
                          for run in report["runs"] for one in run["false"]])
        figures = {row["figure"]: row for row in rows("over_runs.csv")}
        self.assertEqual(figures.keys(), report["over_runs"].keys())
        self.assertEqual([float(figures["f1"][key]) for key in ("mean", "low_95", "high_95")],
                         [report["over_runs"]["f1"]["mean"], *report["over_runs"]["f1"]["interval_95"]])
        before = (tables / "runs.csv").read_bytes()
        self.assertEqual(self.evaluated(self.maps, "--csv", tables).returncode, 0)
        self.assertEqual((tables / "runs.csv").read_bytes(), before)

    def test_tables_and_images_come_at_once(self):
        plain = self.evaluated(self.maps[:1], "--rates")
        plan, plot, tables = (self.folder / name for name in ("both.png", "both_reliability.png", "both"))
        both = self.evaluated(self.maps[:1], "--csv", tables, "--image", plan, "--reliability", plot)
        self.assertEqual((both.returncode, both.stdout), (0, plain.stdout), both.stderr)
        alone = [self.folder / name for name in ("alone.png", "alone_reliability.png")]
        self.evaluated(self.maps[:1], "--image", alone[0], "--reliability", alone[1])
        self.assertEqual([path.read_bytes() for path in (plan, plot)], [path.read_bytes() for path in alone])
        self.assertTrue((tables / "runs.csv").exists())
        self.assertEqual(self.evaluated(self.maps[:1], "--rates", "--image", self.maps[0]).returncode, 4)

    def list_of_one(self):
        path = self.folder / "one.yaml"
        path.write_text("format: hypermap-sequence-truth\nversion: 1\nsequence: room\nup: [0, 0, 1]\nthings:\n"
                        "- {name: a, class: chair, centre: [0, 0, 0.5], size: [1, 1, 1], first_frame: 0, marks: []}\n")
        return path

    def test_a_truth_has_all_of_itself(self):
        report = self.report([self.truth])
        self.assertEqual((report["all"]["tpr"], report["all"]["precision"]), (1, 1))
        self.assertEqual(report["all"]["tn"], 0)  # it keeps its objects and rejects none
        self.assertEqual(report["all"]["mean_ap"]["gate"], 1)
        self.assertAlmostEqual(report["all"]["box_iou"], 1, places=5)
        self.assertEqual(report["all"]["position"]["rmse_m"], 0)
        self.assertEqual(report["unknown"], [])

    def test_lists_have_rates_as_well(self):
        objects = json.loads(run("query", self.maps[0], "--layer", "objects", "--json").stdout)["results"]
        sequence = json.loads(run("info", self.maps[0], "--json").stdout)["provenance"]["input"]
        things = [{"name": f"thing_{one['id']}", "class": one["name"], "centre": one["position"],
                   "size": one["size_m"], "first_frame": 0, "marks": []} for one in objects]
        things[0]["centre"] = [90, 0, 0]
        path = self.folder / "room.yaml"
        path.write_text("\n".join(["format: hypermap-sequence-truth", "version: 1", f"sequence: {sequence}",
                                   "up: [0, 0, 1]", "things:", *(f"  - {json.dumps(one)}" for one in things), ""]))
        report = self.report(self.maps[:1], truths=[path])
        self.assertEqual((report["all"]["fn"], report["all"]["fp"]), (1, 1))
        self.assertEqual(report["all"]["tp"], len(things) - 1)
        self.assertIn("rarely seen", report["unknown"][0])
        mixed = self.report(self.maps[:1] * 2, truths=[path, self.truth])
        self.assertEqual([one["truth"] for one in mixed["runs"]], ["room.yaml", "truth.hmap"])
        counted = self.report(self.maps[:1], "--input", self.dataset, truths=[path])
        self.assertEqual(counted["unknown"], [])

    def test_what_does_not_fit_is_refused(self):
        for arguments in (("--rates", "--against", self.maps[1]), ("--rates", "--also", self.maps[1], self.truth),
                          ("--csv", self.dataset)):
            result = self.evaluated(self.maps[:1], *arguments)
            self.assertEqual(result.returncode, 4, result.stderr)
        for maps, truths, arguments, words in (
                (self.maps, [self.truth], ("--against", self.maps[1]), "--against: needs a single map"),
                (self.maps * 2, [self.truth] * 3, (), "--truth: must be one, or one for each of 4 maps; are 3"),
                (self.maps[:1], [self.truth] * 2, (), "--truth: must be one, or one for each of 1 map; are 2"),
                (self.maps, [self.truth], ("--image", self.folder / "p.png"), "--image: needs a single map"),
                (self.maps[:1], [self.list_of_one()], ("--csv", self.folder / "t", "--image", self.folder / "p.png"),
                 "--image: needs an archive as truth"),
                (self.maps, [self.truth], ("--input", self.dataset), "--input: needs one list of things"),
                (self.maps, [self.truth], ("--classes", "chiar"), """--classes: neither""")):
            result = self.evaluated(maps, *arguments, truths=truths)
            self.assertEqual(result.returncode, 2, result.stderr)
            self.assertIn(words, result.stderr)
            self.assertEqual(result.stdout, "")

    def test_times_of_frames(self):
        times = json.loads(self.stats.read_text())["frame_times"]
        self.assertEqual(list(times), ["read", "detect", "wait", "smooth", "refine", "segment", "integrate", "associate",
                                       "visibility", "frame"])
        self.assertIsNone(times["detect"])
        self.assertIsNone(times["refine"])
        for stage in ("read", "segment", "integrate", "frame"):
            one = times[stage]
            self.assertEqual((one["frames"], one["one_of"]), (24, 1))
            self.assertEqual(sorted(numbers := [one[key] for key in ("min_s", "lower_s", "median_s", "upper_s",
                                                                     "max_s")]), numbers)
        self.assertEqual(run("check", self.plot).returncode, 0)
        for name in (self.folder / "plot.jpg", self.stats, self.maps[0]):
            result = run("map", "--input", self.dataset, "--output", self.maps[0], "--stats", self.stats,
                         "--times-plot", name)
            self.assertEqual(result.returncode, 4, result.stderr)
            self.assertIn("--times-plot", result.stderr)


if __name__ == "__main__":
    unittest.main()
