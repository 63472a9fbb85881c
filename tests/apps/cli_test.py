#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""One map looked at in every way: messages, files, JSON. Usage: cli_test.py PROGRAM [unittest args]

Long because: all cases look at one map, which is made once.
"""

import functools
import json
import math
import os
import pathlib
import shutil
import tempfile
import unittest
import zipfile

from program import IS_SANITIZED, digest, run, tree_digest

# A sanitizer makes a run ten times as dear and has seen each of its paths once before it is repeated.
not_repeated = unittest.skipIf(IS_SANITIZED, "compares bytes of runs that a sanitizer need not see again")

# Half of them show enough of the room for every command to have something to do.
NUM_FRAMES = 20 if IS_SANITIZED else 40
SHOWN_FRAME = NUM_FRAMES // 20  # a frame with detections
SIMULATION = ("--frames", NUM_FRAMES, "--size", "320x240", "--seed", 1, "--detector", "perfect")


class Pipeline(unittest.TestCase):
    """One small simulation, mapped once, looked at in every way."""

    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="hypermap-cli-"))
        cls.dataset = cls.folder / "lab"
        cls.archive = cls.folder / "lab.hmap"
        cls.simulated = run("simulate", "--output", cls.dataset, *SIMULATION)
        cls.mapped = run("map", "--input", cls.dataset, "--output", cls.archive,
                         "--stats", cls.folder / "stats.json")

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def setUp(self):
        self.assertEqual(self.simulated.returncode, 0, self.simulated.stderr)
        self.assertEqual(self.mapped.returncode, 0, self.mapped.stderr)

    def copy_of_dataset(self, name):
        copy = self.folder / name
        shutil.copytree(self.dataset, copy)
        return copy

    def test_stats_have_the_fields_of_the_contract(self):
        stats = json.loads((self.folder / "stats.json").read_text())
        self.assertEqual(stats["frames"], NUM_FRAMES)
        self.assertEqual(stats["frames_skipped"], 0)
        self.assertGreater(stats["points"], NUM_FRAMES * 50000)
        self.assertLessEqual({"read", "detect", "segment", "integrate", "associate", "project", "write"},
                             set(stats["stages_s"]))
        for field in ("points_skipped", "wall_s", "frames_per_s", "objects", "peak_rss_bytes", "threads"):
            self.assertIn(field, stats)
        self.assertGreater(stats["leaves"]["occupied"], 1000)
        self.assertGreater(stats["leaves"]["free"], stats["leaves"]["occupied"])

    @not_repeated
    def test_threads_and_repetition_do_not_change_a_byte(self):
        for name, threads in (("one", 1), ("two", 2)):
            again = self.folder / f"{name}.hmap"
            result = run("map", "--input", self.dataset, "--output", again, "--threads", threads)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertEqual(digest(again), digest(self.archive), f"{threads} threads")

    def members(self, archive):
        with zipfile.ZipFile(archive) as members:
            return {name: members.read(name) for name in members.namelist()}

    def assert_alike(self, ours, theirs, place):
        """JSON of equal structure whose numbers agree within 1e-6."""
        if isinstance(ours, dict):
            self.assertEqual(ours.keys(), theirs.keys(), place)
            for key, value in ours.items():
                self.assert_alike(value, theirs[key], f"{place}.{key}")
        elif isinstance(ours, list):
            self.assertEqual(len(ours), len(theirs), place)
            for i, value in enumerate(ours):
                self.assert_alike(value, theirs[i], f"{place}[{i}]")
        elif isinstance(ours, float):
            self.assertAlmostEqual(ours, theirs, delta=1e-6, msg=place)
        else:
            self.assertEqual(ours, theirs, place)

    @not_repeated
    def test_another_mathematics_library_gives_the_same_map(self):
        narrow = self.folder / "narrow.hmap"
        env = dict(os.environ, GLIBC_TUNABLES="glibc.cpu.hwcaps=-AVX2,-FMA")
        result = run("map", "--input", self.dataset, "--output", narrow, env=env)
        self.assertEqual(result.returncode, 0, result.stderr)
        ours, theirs = self.members(self.archive), self.members(narrow)
        self.assertEqual(ours.keys(), theirs.keys())
        for name in ("octree.ot", "classes.yaml"):
            self.assertEqual(ours[name], theirs[name], name)
        for one, other in zip(ours["objects.jsonl"].splitlines(), theirs["objects.jsonl"].splitlines(), strict=True):
            self.assert_alike(json.loads(one), json.loads(other), "objects.jsonl")

    @not_repeated
    def test_the_simulation_repeats_itself(self):
        again = self.folder / "again"
        env = dict(os.environ, TZ="Asia/Tokyo", LC_ALL="C.UTF-8")
        result = run("simulate", "--output", again, *SIMULATION, "--threads", 1, env=env)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(tree_digest(again), tree_digest(self.dataset))

    def test_info_lists_layers_and_classes(self):
        info = json.loads(run("info", self.archive, "--json").stdout)
        names = {layer["name"] for layer in info["layers"]}
        self.assertLessEqual({"occupancy", "semantic"}, names)
        self.assertIn("chair", {entry["name"] for entry in info["classes"]})
        self.assertEqual({"transforms", "provenance", "format_version"} - set(info), set())

    def test_queries_agree_with_each_other(self):
        by_name = json.loads(run("query", self.archive, "--layer", "semantic", "--string", "chair",
                                 "--json").stdout)["results"]
        self.assertGreater(len(by_name), 0)
        x, y = by_name[0]["position"][:2]
        at = json.loads(run("query", self.archive, "--layer", "semantic", "--at", f"{x},{y}",
                            "--json").stdout)["results"]
        self.assertIn(by_name[0]["id"], [hit["id"] for hit in at])
        nearest = run("query", self.archive, "--nearest", "chair", "--at", f"{x},{y}", "--json")
        self.assertEqual(json.loads(nearest.stdout)["results"][0]["name"], "chair")

    def test_the_nearest_by_the_way_of_a_robot_needs_neither_octree_nor_objects(self):
        free = json.loads(run("query", self.archive, "--layer", "occupancy", "--string", "Free", "--json").stdout)
        start = free["results"][len(free["results"]) // 2]["position"]
        asked = ["--nearest", "/.*/", "--at", f"{start[0]},{start[1]}", "--free-space", "--robot-radius", 0, "--reach", 3]
        answer = run("query", self.archive, *asked, "--top", 1000, "--json")
        self.assertEqual(answer.returncode, 0, answer.stderr)
        document = json.loads(answer.stdout)
        self.assertEqual((document["robot_radius_m"], document["reach_m"]), (0, 3))
        lengths = [one["route"]["length_m"] for one in document["results"]]
        self.assertEqual(lengths, sorted(lengths))
        self.assertGreater(len(lengths), 3)
        for one in document["results"]:
            points = one["route"]["points"]
            self.assertEqual(points[0], start)
            pieces = [math.dist(a, b) for a, b in zip(points, points[1:])]
            self.assertAlmostEqual(sum(pieces), one["route"]["length_m"])
            self.assertLessEqual(one["straight_m"], one["route"]["length_m"] + one["gap_m"] + 1e-9)
            self.assertLessEqual(one["gap_m"], 3.1)
        first = document["results"][0]
        text = run("query", self.archive, *asked).stdout
        self.assertIn(f"the way to {first['name']} {first['id']}: ", text)
        damaged = self.folder / "no-octree.hmap"
        with zipfile.ZipFile(damaged, "w") as members:
            for name, content in self.members(self.archive).items():
                members.writestr(name, b"no" if name in ("octree.ot", "objects.jsonl") else content)
        self.assertEqual(run("query", damaged, *asked, "--top", 1000, "--json").stdout, answer.stdout)
        self.assertEqual(run("query", damaged, "--nearest", "chair", "--at", "0,0").returncode, 2)

    def test_a_way_that_cannot_be_is_refused_by_its_reason(self):
        occupied = json.loads(run("query", self.archive, "--layer", "occupancy", "--string", "Occupied", "--json").stdout)
        unknown = json.loads(run("query", self.archive, "--layer", "occupancy", "--string", "Unknown", "--json").stdout)
        wall = occupied["results"][0]["position"]
        dark = next(one["position"] for one in unknown["results"] if one["value"] == -1)
        for at, reason in ((wall, "is in an obstacle"), (dark, "is in unknown space"),
                           ((900, 900), "is outside the occupancy grid")):
            told = run("query", self.archive, "--nearest", "chair", "--at", f"{at[0]},{at[1]}", "--free-space")
            self.assertEqual(told.returncode, 2)
            self.assertIn(f"--at {at[0]},{at[1]}: {reason}", told.stderr)
        for wrong in (["--free-space"], ["--nearest", "chair", "--at", "0,0", "--reach", 1],
                      ["--nearest", "chair", "--at", "0,0,1", "--free-space"],
                      ["--nearest", "chair", "--at", "0,0", "--free-space", "--robot-radius", "-1"],
                      ["--nearest", "chair", "--at", "0,0", "--free-space", "--complete"]):
            self.assertEqual(run("query", self.archive, *wrong).returncode, 4, wrong)

    def test_objects_say_how_much_of_them_was_seen_and_guesses_that_they_are_some(self):
        objects = ["query", self.archive, "--layer", "objects"]
        plain = json.loads(run(*objects, "--json").stdout)["results"]
        self.assertGreater(len({one["seen_share"] for one in plain}), 1)
        for one in plain:
            self.assertTrue(0 < one["seen_share"] <= 1, one)
            self.assertNotIn("completed_box", one)
        completed = json.loads(run(*objects, "--complete", "--json").stdout)["results"]
        for one, guessed in zip(plain, completed, strict=True):
            guess = guessed.pop("completed_box")
            self.assertEqual(guessed, one)
            if guess is not None:
                self.assertIs(guess["guess"], True)
                self.assertEqual(len(guess["bbox"]), 6)
        self.assertIn("completed size m (guess)", run(*objects, "--complete").stdout)
        self.assertNotIn("guess", run(*objects).stdout)
        nearest = json.loads(run("query", self.archive, "--nearest", "chair", "--at", "0,0", "--json").stdout)["results"]
        self.assertGreater(nearest[0].pop("distance_m"), 0)
        self.assertEqual(nearest, [one for one in plain if one["id"] == nearest[0]["id"]])
        shapes = run("query", self.archive, "--layer", "semantic", "--string", "chair", "--complete")
        self.assertEqual(shapes.returncode, 4)
        self.assertIn("--complete", shapes.stderr)
        refused = run("export", self.archive, "--format", "ply", "--complete", "--output", self.folder / "c.ply")
        self.assertIn("--complete", refused.stderr)
        self.assertNotEqual(refused.returncode, 0)

    def test_every_layer_that_info_lists_can_be_asked(self):
        layers = json.loads(run("info", self.archive, "--json").stdout)["layers"]
        self.assertLessEqual({"octree", "objects", "occupancy", "semantic", "chair"}, {one["name"] for one in layers})
        # A sanitizer has seen all once it has seen one layer of each kind.
        for layer in {one["class"]: one for one in layers}.values() if IS_SANITIZED else layers:
            with self.subTest(layer["name"]):
                low, high = (layer["bounds"][end] for end in ("min", "max"))
                if layer["class"] == "octomap":  # as text all its voxels take most of this program's time
                    middle = [(a + b) / 2 for a, b in zip(low, high)]
                    low, high = ([at + step for at in middle] for step in (-0.5, 0.5))
                area = f"{low[0]} {low[1]},{high[0]} {low[1]},{high[0]} {high[1]},{low[0]} {high[1]}"
                result = run("query", self.archive, "--layer", layer["name"], "--area", area, "--json")
                self.assertEqual(result.returncode, 0, result.stderr)
                found = json.loads(result.stdout)["results"]
                self.assertGreater(len(found), 0)
                at = ",".join(str(number) for number in found[0]["position"])
                here = run("query", self.archive, "--layer", layer["name"], "--at", at, "--json")
                self.assertIn(found[0]["id"], [hit["id"] for hit in json.loads(here.stdout)["results"]])

    def test_an_object_says_why_it_is_there(self):
        shown = json.loads(run("query", self.archive, "--layer", "objects", "--json").stdout)["results"]
        for thing in shown[:4]:
            why = json.loads(run("query", self.archive, "--why", thing["id"], "--json").stdout)
            self.assertTrue(why["shown"])
            self.assertEqual(why["name"], thing["name"])
            self.assertEqual(why["withheld_for"], [])
            self.assertGreaterEqual(sum(naming["detections"] for naming in why["namings"]), 3)
            self.assertEqual({naming["detector"] for naming in why["namings"]}, {"detections"})
            self.assertLessEqual(why["first"]["stamp_s"], why["last"]["stamp_s"])
            self.assertTrue(why["last_seen"]["detected"])
            self.assertLessEqual(why["last_seen"]["frame"], why["last"]["frame"])
            self.assertEqual(why["last_seen"]["frame"], max(naming["last_frame"] for naming in why["namings"]))
        text = run("query", self.archive, "--why", shown[0]["id"]).stdout
        self.assertIn(f"{shown[0]['name']} {shown[0]['id']} is shown", text)
        self.assertIn("clear looks in a row through its place", text)
        missing = run("query", self.archive, "--why", 99999)
        self.assertEqual(missing.returncode, 2)
        self.assertIn("--why: the map has no object 99999", missing.stderr)
        for value in ("99999999999999999999", "abc", "", "0", "-1", "1.5"):
            with self.subTest(value):
                wrong = run("query", self.archive, "--why", value)
                self.assertEqual(wrong.returncode, 4, wrong.stderr)
                self.assertIn(f"--why: must be the id of an object, a whole number in 1 .. 4294967295, is '{value}'",
                              wrong.stderr)

    def test_why_says_of_shown_and_withheld_objects_what_is_true_of_them_then(self):
        lines = [json.loads(line) for line in self.members(self.archive)["objects.jsonl"].splitlines()]
        found = json.loads(run("query", self.archive, "--layer", "objects", "--json").stdout)["results"]
        shown = [thing["id"] for thing in found]
        withheld = [line["id"] for line in lines
                    if isinstance(line, dict) and "id" in line and line["id"] not in shown]
        self.assertTrue(withheld, "some object of the map is withheld")
        for thing in shown[:3] + withheld[:3]:
            why = json.loads(run("query", self.archive, "--why", thing, "--json").stdout)
            lines = run("query", self.archive, "--why", thing).stdout.splitlines()
            text = "\n".join(lines)
            self.assertEqual(why["shown"], thing in shown)
            hidden, removed = (why["removal"][key] for key in ("looks_until_gone", "looks_until_removed"))
            self.assertEqual("hidden after" in text, why["shown"] and 0 < hidden < removed, text)
            self.assertEqual("such look" in text, "hidden after" in text, text)
            self.assertEqual("looked for" in text, not why["last"]["detected"], text)
            seen = next(line for line in lines if line.startswith("  last seen"))
            self.assertIn(f"(frame {why['last_seen']['frame']})", seen)
            listed = [one for one in why["classes"] if one["probability"] >= 0.05]
            counted = [one for one in why["classes"] if 0.005 <= one["probability"] < 0.05]
            belief = next(line for line in lines if line.startswith("  belief"))
            self.assertEqual(belief.count(",") + 1, max(1, len(listed)), belief)
            if listed:
                self.assertEqual("other" in belief, bool(counted), belief)

    def test_why_goes_by_the_rules_that_the_map_was_made_by(self):
        rules = self.folder / "rules.yaml"
        rules.write_text("publication:\n  min_observations: 1000\n  gone: {looks: 7, rare_looks: 0}\n")
        strict = self.folder / "strict.hmap"
        self.assertEqual(run("map", "--input", self.dataset, "--output", strict, "--config", rules).returncode, 0)
        shown = json.loads(run("query", self.archive, "--layer", "objects", "--json").stdout)["results"][0]["id"]
        why = json.loads(run("query", strict, "--why", shown, "--json").stdout)
        self.assertFalse(why["shown"])
        self.assertEqual([(one["condition"], one["limit"]) for one in why["withheld_for"]], [("observations", 1000)])
        self.assertEqual(why["removal"]["looks_until_gone"], 7)
        self.assertIn("1000 are asked for", run("query", strict, "--why", shown).stdout)

    def test_a_place_says_why_it_shows_nothing(self):
        thing = json.loads(run("query", self.archive, "--layer", "objects", "--json").stdout)["results"][0]
        there = run("query", self.archive, "--why-not", ",".join(str(x) for x in thing["position"]))
        self.assertIn(f"{thing['name']} {thing['id']} is shown at", there.stdout)
        far = json.loads(run("query", self.archive, "--why-not", "50,50,1", "--json").stdout)
        self.assertEqual((far["shown"], far["space"], far["withheld"]), ([], "Unknown", []))
        self.assertGreater(far["nearest"]["distance_m"], 30)
        self.assertGreater(far["nearest_withheld"]["distance_m"], 30)
        text = run("query", self.archive, "--why-not", "50,50,1").stdout
        self.assertIn("no frame measured anything there", text)
        self.assertRegex(text, rf"nothing there; the nearest is .* {far['nearest_withheld']['id']}, .* m from its box: ")
        for flags in (("--why", 1, "--layer", "objects"), ("--why", 1, "--why-not", "1,2"), ("--why-not", "1")):
            with self.subTest(flags):
                self.assertEqual(run("query", self.archive, *flags).returncode, 4)

    def test_an_octree_is_asked_in_3d(self):
        layer = ["query", self.archive, "--layer", "octree", "--json"]
        chairs = json.loads(run(*layer, "--string", "chair").stdout)["results"]
        self.assertGreater(len(chairs), 0)
        x, y, z = chairs[0]["position"]
        self.assertEqual(len(chairs[0]["size_m"]), 3)
        one = json.loads(run(*layer, "--at", f"{x},{y},{z}").stdout)["results"]
        self.assertEqual([hit["id"] for hit in one], [chairs[0]["id"]])
        self.assertEqual(json.loads(run(*layer, "--at", f"{x},{y},1000").stdout)["results"], [])
        column = json.loads(run(*layer, "--at", f"{x},{y}").stdout)["results"]
        self.assertIn(chairs[0]["id"], [hit["id"] for hit in column])

    def found(self, *arguments):
        result = run("query", self.archive, *arguments, "--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        return len(json.loads(result.stdout)["results"]), result.stderr

    def test_a_class_is_found_in_every_spelling_in_every_layer(self):
        for layer in ("objects", "semantic", "octree"):
            with self.subTest(layer):
                expected, _ = self.found("--layer", layer, "--string", "chair")
                self.assertGreater(expected, 0)
                self.assertEqual(self.found("--layer", layer, "--string", "Chair"), (expected, ""))
        self.assertEqual(self.found("--layer", "occupancy", "--string", "free")[0],
                         self.found("--layer", "occupancy", "--string", "Free")[0])

    def test_a_misspelt_class_is_told_with_the_nearest(self):
        for layer in ("objects", "semantic", "octree"):
            count, said = self.found("--layer", layer, "--string", "chiar")
            self.assertEqual(count, 0)
            self.assertIn('no class of this map is called "chiar", did you mean "chair"?', said)
        self.assertNotIn("did you mean", self.found("--layer", "objects", "--string", "unicorn")[1])
        mapped = run("map", "--input", self.dataset, "--output", self.folder / "b.hmap", "--max-frames", 4,
                     "--transient", "chiar,cup")
        self.assertEqual(mapped.returncode, 1)
        self.assertIn('transient_classes: no class of the input is called "chiar", did you mean "chair"?', mapped.stderr)
        self.assertNotIn("cup", mapped.stderr)
        for form, name in (("geojson", "a.local.geojson"), ("ply", "a.ply"), ("class-grids", "grids")):
            exported = run("export", self.archive, "--format", form, "--output", self.folder / name, "--class", "chiar")
            self.assertEqual(exported.returncode, 2)
            self.assertIn('did you mean "chair"?', exported.stderr)
        layer = run("query", self.archive, "--layer", "smantic", "--int", "1")
        self.assertIn('did you mean "semantic"?', layer.stderr)

    def test_an_export_of_nothing_says_so(self):
        for form, name in (("geojson", "n.local.geojson"), ("ply", "n.ply"), ("class-grids", "n"), ("octomap", "n.ot"),
                           ("color-octomap", "n.ot")):
            empty = run("export", self.archive, "--format", form, "--output", self.folder / name, "--class", "Zebra")
            self.assertEqual(empty.returncode, 1, form)
            self.assertIn("nothing", empty.stderr)
            self.assertFalse((self.folder / name).exists())

    def test_an_unknown_layer_is_told_with_those_that_exist(self):
        result = run("query", self.archive, "--layer", "smells", "--at", "0,0")
        self.assertEqual(result.returncode, 2)
        self.assertIn("semantic", result.stderr)

    @classmethod
    @functools.cache
    def evaluated(cls):
        return run("eval", "--map", cls.archive, "--truth", cls.dataset / "truth.hmap", "--json")

    def test_eval_finds_the_objects(self):
        result = self.evaluated()
        self.assertEqual(result.returncode, 0, result.stderr)
        report = json.loads(result.stdout)
        self.assertGreater(report["one_to_one"]["f1"], 0.5)
        self.assertLessEqual({"n", "distance_m", "jaccard"}, set(report["all"]))
        self.assertIn("chair", report["classes"])

    def test_eval_finds_the_relations(self):
        relations = json.loads(self.evaluated().stdout)["relations"]
        counted = json.loads(run("info", self.archive, "--json").stdout)["relations"]
        self.assertEqual(relations.keys(), {"on", "in", "under", "beside", "part_of"})
        for kind, one in relations.items():
            with self.subTest(kind):
                self.assertLessEqual(one["right"], one["map"])
                self.assertLessEqual(one["right"], one["truth"])
                self.assertLessEqual(one["map"], counted[kind])
        beside = relations["beside"]
        self.assertGreaterEqual(beside["map"], 1)
        self.assertGreaterEqual(beside["precision"], 0.7)
        self.assertAlmostEqual(beside["precision"], beside["right"] / beside["map"])

    def test_eval_compares_objects_voxels_and_probabilities(self):
        truth = self.dataset / "truth.hmap"
        report = json.loads(self.evaluated().stdout)
        voxels = report["voxels"]
        self.assertGreater(voxels["labelled"], 0)
        self.assertGreaterEqual(voxels["labelled"], voxels["right"] + voxels["wrong_class"])
        self.assertEqual(voxels["labelled"], sum(counts["labelled"] for counts in voxels["classes"].values()))
        self.assertEqual(voxels["true"], sum(counts["true"] for counts in voxels["classes"].values()))
        self.assertAlmostEqual(voxels["precision"], voxels["right"] / voxels["labelled"])
        self.assertTrue(report["knows_frames_named"])
        truths, scores = report["truths"], report["one_to_one"]
        self.assertEqual(sum(one["counts"] for one in truths), scores["truths"])
        matched = [one for one in truths if one["counts"] and one["matched"] is not None]
        self.assertEqual(len(matched), scores["matched"])
        self.assertAlmostEqual(sum(one["distance_m"] for one in matched) / len(matched), scores["distance_m"])
        thesis = [one["thesis"]["jaccard"] for one in truths if one["thesis"]["jaccard"] is not None]
        self.assertEqual((len(thesis), len(truths)), (report["all"]["n"], report["all"]["truths"]))
        self.assertAlmostEqual(sum(thesis) / len(thesis), report["all"]["jaccard"])
        real = report["calibration"]["real"]
        self.assertEqual(sum(bin["n"] for bin in real["bins"]), real["n"])
        plot = self.folder / "reliability.png"
        twice = run("eval", "--map", self.archive, "--truth", truth, "--also", self.archive, truth, "--reliability", plot,
                    "--json")
        self.assertEqual(twice.returncode, 0, twice.stderr)
        self.assertEqual(json.loads(twice.stdout)["calibration"]["real"]["n"], 2 * real["n"])
        self.assertEqual(json.loads(twice.stdout)["one_to_one"], report["one_to_one"])
        self.assertEqual(run("check", plot).returncode, 0)
        table = run("eval", "--map", self.archive, "--truth", truth).stdout
        for words in ("voxels of class", "box IoU", "rarely seen", "P(real): expected calibration error"):
            self.assertIn(words, table)

    def test_eval_writes_over_nothing_that_it_reads(self):
        truth = self.dataset / "truth.hmap"
        before = truth.read_bytes()
        for name in (truth, self.folder / "plot.jpg"):
            result = run("eval", "--map", self.archive, "--truth", truth, "--reliability", name)
            self.assertEqual(result.returncode, 4, result.stderr)
            self.assertIn("--reliability", result.stderr)
        self.assertEqual(truth.read_bytes(), before)

    def test_a_map_without_surfaces_is_a_truth_of_objects_alone(self):
        result = run("eval", "--map", self.archive, "--truth", self.archive)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("voxel labels are not evaluated: the truth has no surfaces", result.stdout)

    def test_a_truth_is_perfect_against_itself(self):
        truth = self.dataset / "truth.hmap"
        report = json.loads(run("eval", "--map", truth, "--truth", truth, "--json").stdout)
        self.assertEqual(report["one_to_one"]["recall"], 1.0)
        self.assertEqual(report["one_to_one"]["distance_m"], 0.0)

    def test_what_is_not_there_is_no_success(self):
        result = run("tune", "--input", self.dataset, "--frame", 0, "--detection", 999)
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertIn("--detection", result.stderr)
        result = run("eval", "--map", self.archive, "--truth", self.dataset / "truth.hmap", "--classes", "chiar")
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertIn("""'chiar', did you mean "chair"?""", result.stderr)
        result = run("export", self.archive, "--format", "geojson", "--output", self.folder / "lab.geojson")
        self.assertEqual(result.returncode, 4, result.stderr)
        self.assertIn(".local.geojson", result.stderr)

    def test_what_a_map_was_made_by_besides_options_is_told(self):
        output = self.folder / "placed.hmap"
        mapped = run("map", "--input", self.dataset, "--max-frames", 3, "--output", output,
                     "--places", pathlib.Path(__file__).parents[2] / "data" / "places.yaml")
        self.assertEqual(mapped.returncode, 0, mapped.stderr)
        self.assertRegex(run("info", output).stdout, r"made by .*, places places\.yaml xxh3-128:[0-9a-f]{32}\n")
        self.assertNotIn(", places", run("info", self.archive).stdout)

    def test_rooms_places_and_ways_are_told(self):
        rooms = json.loads(run("query", self.archive, "--rooms", "--json").stdout)["rooms"]
        self.assertEqual([room["room"] for room in rooms], list(range(1, len(rooms) + 1)))
        room_of = {one["id"]: room["room"] for room in rooms for one in room["objects"]}
        self.assertTrue(room_of)
        first, last = min(room_of), max(room_of)
        told = json.loads(run("query", self.archive, "--place", first, "--json").stdout)["results"]
        self.assertEqual([(one["id"], one["in"]["room"]) for one in told], [(first, room_of[first])])
        self.assertIn(f" {first} is in ", run("query", self.archive, "--place", first).stdout)
        way = json.loads(run("query", self.archive, "--route", f"{first},{last}", "--json").stdout)
        self.assertEqual((way["from"]["id"], way["to"]["id"]), (first, last))
        self.assertEqual(len(way["rooms"]), len(way["doorways"]) + 1)
        self.assertEqual((way["rooms"][0]["room"], way["rooms"][-1]["room"]), (room_of[first], room_of[last]))
        for code, flags in ((4, ("--rooms", "--layer", "objects")), (4, ("--rooms", "--place", first)),
                            (4, ("--route", first)), (4, ("--places", "x.yaml")), (2, ("--place", "unicorn")),
                            (2, ("--route", f"{first},unicorn")), (3, ("--rooms", "--places", "/nonexistent.yaml"))):
            with self.subTest(flags):
                result = run("query", self.archive, *flags)
                self.assertEqual(result.returncode, code, result.stderr)
                self.assertNotEqual(result.stderr.strip(), "")

    def test_relations_are_told_asked_for_and_missed(self):
        objects = json.loads(run("query", self.archive, "--layer", "objects", "--json").stdout)["results"]
        beside = {(one["id"], other["id"]) for one in objects for other in one["relations"]
                  if other["relation"] == "beside"}
        self.assertTrue(beside)
        self.assertEqual(beside, {(b, a) for a, b in beside}, "beside is symmetric")
        counts = json.loads(run("info", self.archive, "--json").stdout)["relations"]
        self.assertEqual(2 * counts["beside"], len(beside))
        first = min(beside)[0]
        asked = run("query", self.archive, "--beside", first)
        for one in sorted(b for a, b in beside if a == first):
            self.assertRegex(asked.stdout, f"(?m)^.* {one} is .*beside .* {first}")
        asked = run("query", self.archive, "--beside", first, "--string", "no such class", "--json")
        self.assertEqual(json.loads(asked.stdout)["results"], [])
        none = run("query", self.archive, "--part-of", first)
        self.assertEqual(none.returncode, 0, none.stderr)
        self.assertIn(f"the map knows of nothing that is part of {first}", none.stderr)
        unknown = run("query", self.archive, "--beside", first, "--string", "unicorn")
        self.assertEqual(unknown.stderr, 'query: no class of this map is called "unicorn"\n')
        absent = run("query", self.archive, "--beside", first, "--string", "zebra")
        self.assertEqual(absent.stderr, f'query: the map knows of nothing called "zebra" that is beside {first}\n')
        listed = run("query", self.archive, "--on", "nope").stderr
        self.assertIn('--on: no class of the map\'s objects is named "nope" (there are: ', listed)
        self.assertIn("chair", listed)
        standing = json.loads(run("query", self.archive, "--on", "floor", "--json").stdout)["results"]
        self.assertEqual([one["id"] for one in standing], [one["id"] for one in objects if one["support"] == "floor"])
        self.assertTrue(standing)
        self.assertIn("--under: the floor is no object", run("query", self.archive, "--under", "floor").stderr)
        for question, said in ((("--on", "chiar"), """did you mean "chair"?"""),
                               (("--in", 987654), "no object has the id 987654")):
            wrong = run("query", self.archive, *question)
            self.assertEqual(wrong.returncode, 2, wrong.stderr)
            self.assertIn(question[0] + ": ", wrong.stderr)
            self.assertIn(said, wrong.stderr)
        for wrong in (("--layer", "semantic", "--on", "chair"), ("--nearest", "chair", "--at", "0,0", "--on", "chair")):
            self.assertEqual(run("query", self.archive, *wrong).returncode, 4)
        rules = self.folder / "rules.yaml"
        rules.write_text("max_beside: 0\n")
        self.assertIn("0 found", run("query", self.archive, "--beside", first, "--rules", rules).stdout)
        rules.write_text("max_besides: 0\n")
        self.assertIn("did you mean", run("query", self.archive, "--beside", first, "--rules", rules).stderr)

    def test_a_map_without_objects_or_grids_says_so(self):
        flat = self.folder / "flat.hmap"
        copied = run("stack", self.archive, "--output", self.folder / "flat", "--archive", self.folder / "stacked.hmap")
        self.assertEqual(copied.returncode, 0, copied.stderr)
        tiles = self.folder / "flat-tiles"
        self.assertEqual(run("export", self.archive, "--format", "tiles", "--output", tiles).returncode, 0)
        made = run("stack", "--tiles", tiles, "--output", self.folder / "flat-again", "--archive", flat)
        self.assertEqual(made.returncode, 0, made.stderr)
        asked = run("query", flat, "--on", "table")
        self.assertEqual(asked.returncode, 2)
        self.assertIn("--on: relations need tracked 3D objects, and the map has none", asked.stderr)
        for archive, arguments, status, told in (
                (self.folder / "stacked.hmap", ("--layer", "stack"), 2,
                 "--layer: --format ros-map needs a layer of kind OccupancyGridLayer, 'stack' is a GridStackLayer; "
                 "grids of a stack are written by: hypermap stack FILE --from stack"),
                (flat, (), 2, "--layer: --format ros-map needs a layer of kind OccupancyGridLayer, the map has none; "
                 "grids of a stack are written by: hypermap stack FILE --from stack"),
                (self.archive, ("--class", "chair"), 4, "--class: does not go with --format ros-map")):
            refused = run("export", archive, "--format", "ros-map", *arguments, "--output", self.folder / "refused")
            self.assertEqual(refused.returncode, status, refused.stderr)
            self.assertIn(told, refused.stderr)

    def test_flags_that_a_format_does_without_are_a_wrong_command_line(self):
        rules = self.folder / "unused.yaml"
        rules.write_text("max_beside: 0\n")
        for flags, told in ((("--layer", "semantic"), "--layer: goes with --format ros-map, geojson, nav2 and geopackage, not with --format tiles"),
                            (("--rules", rules), "--rules: goes with --format geojson and relations, not with --format tiles"),
                            (("--complete",), "--complete: goes with --format geojson, not with --format tiles")):
            with self.subTest(flags):
                refused = run("export", self.archive, "--format", "tiles", *flags, "--output", self.folder / "refused")
                self.assertEqual(refused.returncode, 4, refused.stderr)
                self.assertIn(told, refused.stderr)
        self.assertFalse((self.folder / "refused").exists())

    def test_exports_are_made_and_checked(self):
        for form in ("ros-map", "class-grids", "octomap", "color-octomap", "ply", "geojson", "tiles",
                     "relations", "topological-map", "nav2", "geopackage"):
            with self.subTest(form):
                suffix = {"octomap": ".ot", "color-octomap": ".ot", "ply": ".ply",
                          "geojson": ".local.geojson", "relations": ".dot", "topological-map": ".dot"}.get(form, "")
                output = self.folder / f"export-{form}{suffix}"
                result = run("export", self.archive, "--format", form, "--output", output)
                self.assertEqual(result.returncode, 0, result.stderr)
        for pattern in ("export-tiles/*.tile", "export-ros-map*.yaml", "export-nav2/map.yaml", "export-nav2/*_mask.yaml",
                        "export-octomap.ot", "export-color-octomap.ot"):
            for made in self.folder.glob(pattern):
                self.assertEqual(run("check", made).returncode, 0, made)

    def test_snapshots_are_images(self):
        for view in ("top", "iso"):
            output = self.folder / f"{view}.png"
            result = run("snapshot", self.archive, "--output", output, "--view", view, "--size", "640x480")
            if result.returncode == 3:
                self.skipTest("no EGL here: " + result.stderr)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertEqual(output.read_bytes()[:4], b"\x89PNG")

    def test_the_topological_map_is_drawn_where_the_overlay_is_asked_for(self):
        plans = {}
        for layers in ("occupancy", "occupancy,overlay"):
            output = self.folder / "plan.png"
            result = run("snapshot", self.archive, "--output", output, "--view", "top", "--layers", layers)
            if result.returncode == 3:
                self.skipTest("no EGL here: " + result.stderr)
            self.assertEqual(result.returncode, 0, result.stderr)
            plans[layers] = output.read_bytes()
        self.assertGreater(json.loads(run("info", self.archive, "--json").stdout)["topological_map"]["edges"], 0)
        self.assertNotEqual(*plans.values())

    def test_without_egl_a_snapshot_ends_with_3_and_says_so(self):
        env = dict(os.environ, __EGL_VENDOR_LIBRARY_DIRS="/nonexistent", LIBGL_DRIVERS_PATH="/nonexistent")
        result = run("snapshot", self.archive, "--output", self.folder / "none.png", env=env)
        self.assertEqual(result.returncode, 3)
        self.assertIn("EGL", result.stderr)
        self.assertFalse((self.folder / "none.png").exists())

    def test_check_approves_what_we_wrote(self):
        for path in (self.archive, self.dataset / "truth.hmap", self.dataset):
            result = run("check", path)
            self.assertEqual(result.returncode, 0, result.stdout + result.stderr)

    def test_a_bad_frame_is_counted_named_and_survived(self):
        copy = self.copy_of_dataset("bad-frame")
        depth = sorted((copy / "depth").iterdir())
        depth[7].write_bytes(b"not a picture")
        result = run("map", "--input", copy, "--output", self.folder / "bad-frame.hmap",
                     "--stats", self.folder / "bad-frame.json")
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertIn(depth[7].name, result.stderr)
        self.assertEqual(json.loads((self.folder / "bad-frame.json").read_text())["frames_skipped"], 1)

    def test_too_many_bad_frames_end_with_2_and_write_nothing(self):
        copy = self.copy_of_dataset("bad-frames")
        for depth in sorted((copy / "depth").iterdir())[:10]:
            depth.write_bytes(b"")
        output = self.folder / "bad-frames.hmap"
        output.write_bytes(b"what was there before")
        result = run("map", "--input", copy, "--output", output)
        self.assertEqual(result.returncode, 2)
        self.assertEqual(output.read_bytes(), b"what was there before")

    def test_missing_poses_are_survived(self):
        copy = self.copy_of_dataset("missing-pose")
        lines = (copy / "groundtruth.txt").read_text().splitlines()
        data = [i for i, line in enumerate(lines) if not line.startswith("#")]
        del lines[data[11]]
        (copy / "groundtruth.txt").write_text("\n".join(lines) + "\n")
        result = run("map", "--input", copy, "--output", self.folder / "missing-pose.hmap",
                     "--stats", self.folder / "missing-pose.json")
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertEqual(json.loads((self.folder / "missing-pose.json").read_text())["frames_skipped"], 1)

    def test_a_map_in_two_runs_has_the_places_of_one(self):
        parts = self.folder / "parts.hmap"
        for more in (("--max-frames", NUM_FRAMES // 2), ("--first", NUM_FRAMES // 2, "--append", "--same-world")):
            result = run("map", "--input", self.dataset, "--output", parts, *more)
            self.assertLessEqual(result.returncode, 1, result.stderr)
        member = "topological_map.jsonl"
        self.assertEqual(self.members(parts)[member], self.members(self.archive)[member])
        self.assertRegex(run("info", parts).stdout, r"(?m)^topological map: \d+ vert(ex|ices), \d+ edges?$")

    def test_append_goes_on_from_the_archive(self):
        grown = self.folder / "grown.hmap"
        shutil.copy(self.archive, grown)
        result = run("map", "--input", self.dataset, "--output", grown, "--append", "--same-world", "--force",
                     "--max-frames", 4)
        self.assertEqual(result.returncode, 0, result.stderr)
        names = [[layer["name"] for layer in json.loads(run("info", archive, "--json").stdout)["layers"]]
                 for archive in (self.archive, grown)]
        self.assertEqual(names[0], [name for name in names[1] if name in names[0]])
        confirmed = run("query", grown, "--layer", "objects").stdout
        for name in set(names[1]) - set(names[0]):  # class grids of objects that four more frames confirm
            self.assertIn(name, confirmed)

    def test_an_unknown_option_in_a_file_names_the_nearest(self):
        config = self.folder / "options.yaml"
        config.write_text("octree:\n  resolution: 0.05\n")
        result = run("map", "--input", self.dataset, "--output", self.folder / "x.hmap", "--config", config)
        self.assertEqual(result.returncode, 2)
        self.assertIn("resolution_m", result.stderr)

    def test_tune_refuses_what_its_policy_does_not_use(self):
        for flag, value in (("--angle", 10), ("--curvature", 0.5)):
            result = run("tune", "--input", self.dataset, "--frame", 5, flag, value)
            self.assertEqual(result.returncode, 4, result)
            self.assertIn(f"{flag}: belongs to --policy region_growing, is given with foreground", result.stderr)

    def test_tune_shows_the_steps(self):
        output = self.folder / "tune"
        result = run("tune", "--input", self.dataset, "--frame", SHOWN_FRAME, "--output", output)
        self.assertEqual(result.returncode, 0, result.stderr)
        names = {path.name for path in output.glob("*.png")}
        for name in ("detections.png", "panels.png", "panels-from-above.png", "detection-0-step-1-window.png",
                     "detection-0-box.png"):
            self.assertIn(name, names)

    def test_the_number_of_a_frame_is_decimal(self):
        result = run("tune", "--input", self.dataset, "--frame", "0100")
        self.assertIn("asked for 100", result.stderr)

    def tuned(self, *arguments):
        return run("tune", "--input", self.dataset, "--frame", SHOWN_FRAME, "--detection", 0,
                   "--set", "segmentation.max_range_m=6", *arguments)

    def test_tune_takes_presets_files_and_any_option(self):
        smap = self.tuned("--preset", "smap")
        self.assertIn("outliers", smap.stdout, smap)
        config = self.folder / "tune.yaml"
        config.write_text("preset: smap\nsegmentation:\n  leaf_size_m: 0.02\n")
        coarse = self.tuned("--config", config)
        self.assertNotEqual(coarse.stdout.split("segment of")[1], smap.stdout.split("segment of")[1])
        by_flag = self.tuned("--preset", "smap", "--set", "segmentation.leaf_size_m=0.02")
        self.assertEqual(by_flag.stdout.split("segment of")[1], coarse.stdout.split("segment of")[1])
        wrong = self.tuned("--set", "segmentation.leaf_size=0.1")
        self.assertEqual(wrong.returncode, 4, wrong)
        self.assertIn("leaf_size_m", wrong.stderr)

    def test_tune_leaves_steps_out(self):
        def points(step, *arguments):
            told = self.tuned("--preset", "smap", *arguments)
            self.assertEqual(told.returncode, 0, told.stderr)
            return next(int(line.split(step)[1].split()[0]) for line in told.stdout.splitlines() if line.startswith("  " + step))

        without = ("--without", "outliers,voxel-grid")
        self.assertGreater(points("voxel grid", *without), points("voxel grid"))
        self.assertEqual(points("outliers", *without), points("voxel grid", *without))
        self.assertLess(points("outliers"), points("voxel grid"))
        wrong = self.tuned("--without", "clusters")
        self.assertEqual(wrong.returncode, 4, wrong)
        self.assertIn("is no step of this policy, which has range, surroundings, planes, parts", wrong.stderr)

    def test_tune_tells_times_of_a_sequence(self):
        output = self.folder / "times"
        told = run("tune", "--input", self.dataset, "--times", "--output", output, "--json")
        self.assertEqual(told.returncode, 0, told.stderr)
        times = json.loads(told.stdout)
        self.assertEqual([step["name"] for step in times["steps"]], ["window", "planes", "surfaces", "object"])
        self.assertLessEqual(times["steps"][0]["points"]["lower"], times["steps"][0]["points"]["upper"])
        self.assertEqual({path.name for path in output.iterdir()}, {"times.png", "points.png"})
        self.assertIn("points left", run("tune", "--input", self.dataset, "--times").stdout)

    def test_tune_sweeps_given_and_simulated_sequences(self):
        axis = ("--sweep", "publication.min_observations=3,1000")
        given = run("tune", "--input", self.dataset, "--truth", self.dataset / "truth.hmap", *axis, "--json")
        self.assertEqual(given.returncode, 0, given.stderr)
        points = json.loads(given.stdout)["points"]
        self.assertGreater(points[0]["mean"]["f1"], 0.0)
        self.assertEqual(points[1]["mean"]["recall"], 0.0)
        table = run("tune", *axis, "--seeds", "1", "--frames", 3)
        self.assertEqual(table.returncode, 0, table.stderr)
        self.assertEqual([line.split()[:2] for line in table.stdout.splitlines()[1:]],
                         [["3", "mean"], ["3", "worst"], ["1000", "mean"], ["1000", "worst"]])
        places = run("tune", "--sweep", "prior.source=none,places", "--seeds", "1", "--frames", 3)
        self.assertEqual(places.returncode, 0, places.stderr)
        self.assertEqual([line.split()[0] for line in places.stdout.splitlines()[1:]],
                         ["none", "none", "places", "places"])
        for arguments, told in ((["--sweep", "publication.min_observation=3"], "min_observations"),
                                (["--frame", "3", "--input", self.dataset, "--combiner", "x"], "--sweep"),
                                ([*axis, "--frame", "3"], "--frame"),
                                ([*axis, "--seeds", "1,2,1"], "--seeds: must name each seed once, names 1 twice"),
                                (["--sweep", "prior.source=none", "--places", "indoor.yaml"],
                                 "--places: is used by no map: prior.source is swept without places"),
                                (["--sweep", "stacking.rule=sum", "--combiner", "x"],
                                 "--combiner: is used by no map: stacking.rule is swept without trained"),
                                ([*axis, "--input", self.dataset], "--truth"),
                                (["--frame", "3"], "--input")):
            refused = run("tune", *arguments)
            self.assertEqual(refused.returncode, 4, refused)
            self.assertIn(told, refused.stderr)
        for status, arguments, told in ((2, ["--sweep", "stacking.rule=sum,trained"], "(--combiner)"),
                                        (3, [*axis, "--places", "/nonexistent.yaml"], "/nonexistent.yaml")):
            refused = run("tune", *arguments, "--input", self.dataset, "--truth", self.dataset / "truth.hmap")
            self.assertEqual(refused.returncode, status, refused)
            self.assertIn(told, refused.stderr)

    def test_sizes_of_a_map_add_up(self):
        sizes = json.loads(run("info", self.archive, "--sizes", "--json").stdout)
        self.assertEqual(sizes["bytes"], self.archive.stat().st_size)
        self.assertLess(sum(part["packed_bytes"] for part in sizes["parts"]), sizes["bytes"])
        self.assertIn("of an object", run("info", self.archive, "--sizes").stdout)


if __name__ == "__main__":
    unittest.main(verbosity=1)
