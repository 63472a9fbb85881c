#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Aliases and super-classes, in every command and layer that is asked for a class; set when mapping, afterwards and for
one call.

Usage: class_names_test.py PROGRAM [unittest args]"""

import json
import pathlib
import shutil
import tempfile
import unittest

from program import SOURCE, digest, run

WORDS = """\
aliases:
  chair: [stool]
  tv: [screen]
super_classes:
  seat: [chair, sofa]
  household: [seat, cup]
  tool: [saw]
"""


class ClassNames(unittest.TestCase):
    """A laboratory with chairs, a sofa, cups and more."""

    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="hypermap-names-"))
        cls.words = cls.folder / "words.yaml"
        cls.words.write_text(WORDS)
        cls.dataset = cls.folder / "lab"
        cls.plain = cls.folder / "plain.hmap"
        cls.map = cls.folder / "lab.hmap"
        steps = [("simulate", "--frames", 40, "--seed", 1, "--detector", "perfect", "--output", cls.dataset),
                 ("map", "--input", cls.dataset, "--output", cls.plain, "--resolution", 0.1),
                 ("map", "--input", cls.dataset, "--output", cls.map, "--resolution", 0.1, "--class-names", cls.words)]
        cls.failed = [result.stderr for result in (run(*step) for step in steps) if result.returncode not in (0, 1)]

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def setUp(self):
        self.assertEqual(self.failed, [])
        self.copy = self.folder / "copy.hmap"
        shutil.copy(self.plain, self.copy)

    def done(self, *arguments, status=0):
        result = run(*arguments)
        self.assertEqual(result.returncode, status, f"{arguments}: {result.stdout}{result.stderr}")
        return result

    def found(self, archive, *conditions):
        return json.loads(self.done("query", archive, *conditions, "--json").stdout)["results"]

    def names(self, archive, *conditions):
        return sorted({one["name"] for one in self.found(archive, *conditions)})

    def ids(self, archive, *conditions):
        return sorted(one["id"] for one in self.found(archive, *conditions))

    def test_mapping_keeps_them_and_changes_nothing_else(self):
        told = json.loads(self.done("info", self.map, "--json").stdout)
        self.assertEqual(told["class_names"], {"aliases": 2, "super_classes": 3})
        self.assertIn("names of classes: 2 aliases, 3 super-classes", self.done("info", self.map).stdout)
        self.assertNotIn("names of classes", self.done("info", self.plain).stdout)
        self.done("check", self.map)
        # Without the vocabulary it is the other map, byte for byte.
        cleared = self.folder / "cleared.hmap"
        self.done("classes", self.map, "--clear", "--output", cleared)
        self.assertEqual(digest(cleared), digest(self.plain))

    def test_all_layers_agree(self):
        every = self.names(self.map, "--layer", "objects")
        seats = [name for name in every if name in ("chair", "sofa")]
        household = [name for name in every if name in ("chair", "cup", "sofa")]
        self.assertIn("chair", seats)
        self.assertGreater(len(household), len(seats))
        for layer in ("objects", "semantic", "octree", "evidence"):
            with self.subTest(layer):
                names = self.names(self.map, "--layer", layer, "--string", "stool")
                self.assertEqual(names, ["chair"])
                self.assertEqual(self.names(self.map, "--layer", layer, "--string", "seat"), seats)
                self.assertEqual(self.names(self.map, "--layer", layer, "--string", "HOUSEHOLD"), household)
                self.assertEqual(self.names(self.map, "--layer", layer, "--string", "ch*"), ["chair"])
                self.assertEqual(self.names(self.map, "--layer", layer, "--string", "/ch.+|no/"), ["chair"])
        by_alias = self.found(self.map, "--layer", "stool", "--string", "Occupied")
        self.assertEqual(by_alias, self.found(self.map, "--layer", "chair", "--string", "Occupied"))
        self.assertTrue(by_alias)

    def test_a_call_may_say_others(self):
        self.assertEqual(self.found(self.plain, "--layer", "objects", "--string", "seat"), [])
        given = ("--layer", "objects", "--string", "seat", "--class-names", self.words)
        self.assertEqual(self.ids(self.plain, *given), self.ids(self.map, "--layer", "objects", "--string", "seat"))
        self.assertIn("names of classes", self.done("info", self.map).stdout)

    def test_relations_nearest_place_and_route(self):
        beside = self.ids(self.map, "--beside", "seat")
        either = set()
        for name in self.names(self.map, "--layer", "objects", "--string", "seat"):
            either |= set(self.ids(self.map, "--beside", name))
        self.assertEqual(beside, sorted(either))
        nearest = self.found(self.map, "--nearest", "household", "--at", "0,0")
        self.assertEqual(len(nearest), 1)
        self.assertIn(nearest[0]["id"], self.ids(self.map, "--layer", "objects", "--string", "household"))
        placed = json.loads(self.done("query", self.map, "--place", "stool", "--json").stdout)["results"]
        self.assertEqual({one["name"] for one in placed}, {"chair"})
        by_class = run("query", self.map, "--route", "chair,cup")
        by_words = run("query", self.map, "--route", "stool,cup")
        self.assertEqual((by_words.returncode, by_words.stdout), (by_class.returncode, by_class.stdout))

    def test_exports(self):
        def features(archive, *more):
            output = self.folder / "a.local.geojson"
            self.done("export", archive, "--format", "geojson", "--output", output, *more)
            return sorted(one["id"] for one in json.loads(output.read_text())["features"])

        seats = self.ids(self.map, "--layer", "semantic", "--string", "seat")
        self.assertEqual(features(self.map, "--class", "seat"), seats)
        self.assertEqual(features(self.plain, "--class", "seat", "--class-names", self.words), seats)
        for form, name in (("ply", "a.ply"), ("octomap", "a.ot")):
            by_class, by_alias = self.folder / f"class-{name}", self.folder / f"alias-{name}"
            self.done("export", self.map, "--format", form, "--class", "chair", "--output", by_class)
            self.done("export", self.map, "--format", form, "--class", "stool", "--output", by_alias)
            self.assertEqual(digest(by_class), digest(by_alias))
        grids = self.folder / "grids"
        self.done("export", self.map, "--format", "class-grids", "--class", "stool", "--output", grids)
        self.assertEqual([path.stem for path in grids.glob("*.yaml")], ["chair"])
        refused = self.done("export", self.map, "--format", "ply", "--class", "tool", "--output", "x.ply", status=2)
        self.assertIn('no class is of "tool"', refused.stderr)

    def test_stacks_cells_and_images(self):
        stack = self.folder / "stack"
        made = json.loads(self.done("stack", self.map, "--class", "stool", "--output", stack, "--json").stdout)
        self.assertEqual([layer["name"] for layer in made["layers"]], ["/ism/chair"])
        kept = self.folder / "stack.hmap"
        self.done("stack", self.plain, "--class", "seat", "--class-names", self.words, "--output", stack,
                  "--archive", kept)
        self.assertNotIn("names of classes", self.done("info", kept).stdout)  # a call's are not saved
        cells = self.folder / "cells"
        self.done("cells", self.map, "--class", "stool", "--output", cells)
        cut = json.loads(self.done("stack", self.map, "--layer", "seat,cup", "--output", stack, "--json").stdout)
        self.assertEqual([layer["name"] for layer in cut["layers"]], ["/ism/chair", "/ism/cup", "/ism/sofa"])

        def of(layer):
            return set(json.loads(self.done("cells", self.map, "--of", layer, "--output", cells, "--json").stdout)["of"])

        chairs, sofas = of("stool"), of("sofa")  # a stool is another name of a chair
        self.assertEqual(of("seat"), chairs | sofas)
        self.assertTrue(chairs - sofas and sofas - chairs)
        ways = [json.loads(self.done("cells", self.map, "--path", "0,-1.8,-1,1.5", "--avoid", layer, "--output", cells,
                                     "--json").stdout)["path"] for layer in ("stool", "cha*")]
        self.assertEqual(*ways)
        one, other = self.folder / "one.png", self.folder / "other.png"
        self.done("snapshot", self.map, "--size", "320x240", "--title", "a", "--class", "chair", "--output", one)
        self.done("snapshot", self.map, "--size", "320x240", "--title", "a", "--class", "stool", "--output", other)
        self.assertEqual(digest(one), digest(other))
        self.done("snapshot", self.map, "--size", "320x240", "--title", "a", "--output", other)
        self.assertNotEqual(digest(one), digest(other))
        refused = self.done("snapshot", self.map, "--class", "tool", "--output", one, status=2)
        self.assertIn('no class is of "tool"', refused.stderr)

    def test_evaluations_match_after_aliases(self):
        def report(archive, *more):
            return json.loads(self.done("eval", "--map", archive, "--truth", self.dataset / "truth.hmap", "--json",
                                        *more).stdout)

        plain = report(self.plain)
        # The truth's own words are others: no chair of it is found without them.
        renamed = self.folder / "renamed.yaml"
        renamed.write_text("aliases: {throne: [chair]}\n")
        same = report(self.plain, "--class-names", renamed)
        for key, value in plain["one_to_one"].items():  # summed in another order
            self.assertAlmostEqual(same["one_to_one"][key], value, places=9, msg=key)
        self.assertIn("throne", same["classes"])
        self.assertNotIn("chair", same["classes"])
        self.assertEqual(same["voxels"]["precision"], plain["voxels"]["precision"])
        chairs = report(self.map, "--classes", "stool")
        self.assertEqual(list(chairs["classes"]), ["chair"])
        seats = report(self.map, "--classes", "seat")
        self.assertIn("chair", seats["classes"])
        self.assertNotIn("cup", seats["classes"])

    def test_a_map_is_told_new_ones_without_mapping(self):
        before = self.found(self.copy, "--layer", "objects")
        table = self.done("classes", self.copy, "--set", self.words).stdout
        self.assertIn("2 aliases, 3 super-classes", table)
        self.assertRegex(table, r"chair +- +\d+ +seat, household")
        self.assertEqual(digest(self.copy), digest(self.map))
        self.assertEqual(self.found(self.copy, "--layer", "objects"), before)
        written = self.folder / "written.yaml"
        self.done("classes", self.copy, "--write", written)
        self.done("classes", self.copy, "--clear")
        self.assertEqual(digest(self.copy), digest(self.plain))
        self.done("classes", self.copy, "--set", written)
        self.assertEqual(digest(self.copy), digest(self.map))
        told = json.loads(self.done("classes", self.copy, "--json").stdout)
        self.assertEqual(told["super_classes"]["household"], ["seat", "cup"])
        chair = next(one for one in told["classes"] if one["name"] == "chair")
        self.assertEqual(chair["super_classes"], ["seat", "household"])
        self.assertGreater(chair["shapes"], 0)

    def test_the_shipped_words_say_furniture(self):
        self.done("classes", self.copy, "--set", SOURCE / "data/vocabulary.yaml")
        self.assertIn("chair", self.names(self.copy, "--layer", "objects", "--string", "furniture"))

    def test_a_run_that_goes_on_keeps_them(self):
        shutil.copy(self.map, self.copy)
        result = run("map", "--input", self.dataset, "--output", self.copy, "--append", "--same-world", "--force",
                     "--max-frames", 2, "--resolution", 0.1)
        self.assertIn(result.returncode, (0, 1), result.stderr)
        self.assertIn("2 aliases, 3 super-classes", self.done("info", self.copy).stdout)

    def test_classes_to_keep_and_transient_ones_are_asked_for_likewise(self):
        kept = self.folder / "kept.hmap"
        result = run("map", "--input", self.dataset, "--output", kept, "--resolution", 0.1, "--max-frames", 20,
                     "--class-names", self.words, "--keep-classes", "seat")
        self.assertIn(result.returncode, (0, 1), result.stderr)
        self.assertLessEqual(set(self.names(kept, "--layer", "objects")), {"chair", "sofa"})
        refused = self.done("map", "--input", self.dataset, "--output", kept, "--keep-classes", "zz*", status=2)
        self.assertIn('no class of the input begins with "zz"', refused.stderr)

    def test_what_is_not_there_is_said(self):
        def said(text, archive=None):
            return self.done("query", archive or self.map, "--layer", "objects", "--string", text).stderr

        self.assertEqual(said("tool"), 'query: no class of this map is of "tool" (saw, tool)\n')
        self.assertEqual(said("zz*"), 'query: no class of this map begins with "zz"\n')
        self.assertEqual(said("/zz/"), "query: no class of this map matches /zz/\n")
        self.assertIn('did you mean "stool"?', said("stoool"))

    def test_wrong_expressions_are_wrong_command_lines(self):
        for text in ("/(/", "/[/", "/" + "a" * 300 + "/"):
            result = run("query", self.map, "--layer", "objects", "--string", text)
            self.assertEqual(result.returncode, 4, result.stderr)
            self.assertIn("--string", result.stderr)

    def test_wrong_files_are_refused_and_change_nothing(self):
        bad = self.folder / "bad.yaml"
        before = digest(self.copy)
        for text, said in (("aliases: {a: [b], c: [b]}\n", 'bad.yaml:1: aliases.c: "b" is an alias of "a" already'),
                           ("super_classes:\n  a: [b]\n  b: [a]\n", "bad.yaml:3: super_classes.b: super-classes form a "
                            "circle: a > b > a"),
                           ("alias: {}\n", 'did you mean "aliases"?'), ("aliases: {a: [b]\n", "bad.yaml"),
                           ("", "bad.yaml")):
            bad.write_text(text)
            for command in (("classes", self.copy, "--set", bad),
                            ("query", self.copy, "--layer", "objects", "--class-names", bad),
                            ("map", "--input", self.dataset, "--output", self.copy, "--class-names", bad)):
                self.assertIn(said, self.done(*command, status=2).stderr)
        self.assertEqual(digest(self.copy), before)
        self.done("classes", self.copy, "--set", self.folder / "none.yaml", status=3)
        self.done("classes", self.copy, "--set", self.words, "--clear", status=4)
        self.done("classes", self.copy, "--output", self.folder / "x.hmap", status=4)
        bare = SOURCE / "data/options/default.yaml"
        self.done("classes", bare, "--set", self.words, status=2)


if __name__ == "__main__":
    unittest.main()
