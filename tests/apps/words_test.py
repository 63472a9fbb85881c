#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What the program makes of words: numbers, names, other languages.

Usage: words_test.py PROGRAM [unittest args]"""

import json
import os
import re
import shutil
import subprocess
import unittest

from contract_case import Case
from program import digest, repetitions, run, run_measured


class Words(Case):
    """Numbers, names and languages."""

    def test_numbers_that_are_none_are_wrong_command_lines(self):
        dataset = ["--input", self.dataset, "--output", self.folder / "x"]
        options = [["map", *dataset, "--resolution"], ["map", *dataset, "--max-range"],
                   ["map", *dataset, "--max-skipped"], ["map", *dataset, "--stamp-tolerance"],
                   ["simulate", "--output", self.folder / "x", "--pose-noise"],
                   ["simulate", "--output", self.folder / "x", "--pose-noise-m"],
                   ["simulate", "--output", self.folder / "x", "--lens-height"],
                   ["snapshot", self.archive, "--output", self.folder / "x", "--cut-above"],
                   ["tune", "--input", self.dataset, "--frame", "0", "--leaf-size"]]
        for arguments in options:
            for text in ("nan", "-nan", "inf", "0,05", "1e300", "", "5 m", "wide")[:repetitions(8)]:
                with self.subTest([*arguments[:1], arguments[-1], text]):
                    result = run(*arguments[:-1], f"{arguments[-1]}={text}")
                    self.assertEqual(result.returncode, 4, result.stdout + result.stderr)
        self.assert_names()

    def test_points_and_areas_that_are_none_are_wrong_command_lines(self):
        layer = ["query", self.archive, "--layer", "occupancy"]
        for arguments, told in (([*layer, "--at", "1,b"], "'b'"), ([*layer, "--at", "1"], "2 or 3 numbers"),
                                ([*layer, "--at", "1,2,3"], "2 numbers"),
                                ([*layer], "--layer needs"),
                                ([*layer, "--area", "0 0,1 1"], "--area"),
                                (["query", self.archive, "--nearest", "chair", "--at", "1"], "2 or 3 numbers"),
                                ([*layer, "--at", "1,1", "--string", "Free"], "--at goes alone"),
                                ([*layer, "--int", "0", "--string", "Free"], "exclude each other"),
                                ([*layer, "--at", "1,1", "--nearest", "chair"], "--nearest asks the objects"),
                                (["query", self.archive, "--nearest", "chair", "--at", "1,1", "--string", "table"],
                                 "--string goes without"),
                                (["tune", "--input", self.dataset, "--frame", "-1"], "-1"),
                                (["simulate", "--output", self.folder / "x", "--seed", "-1"], "-1")):
            with self.subTest(arguments[3:]):
                result = run(*arguments)
                self.assertEqual(result.returncode, 4, result.stderr)
                self.assertIn(told, result.stderr)

    def test_a_misspelt_option_is_named_though_another_is_missing(self):
        result = run("map", "--input", self.dataset, "--outptu", self.folder / "x")
        self.assertEqual(result.returncode, 4)
        self.assertIn(f"unknown: --outptu {self.folder / 'x'}", result.stderr)
        self.assertIn('did you mean "--output"?', result.stderr)
        misspelt = run("mpa", "--input", "lab").stderr
        self.assertIn("unknown: mpa --input lab", misspelt)
        self.assertIn('did you mean "map"?', misspelt)
        self.assertNotIn("did you mean", run("cook", "--dinner").stderr)
        self.assertIn("--output is required", run("map", "--input", self.dataset).stderr)

    def test_a_file_of_another_kind_is_named_as_what_it_is(self):
        octree = self.folder / "a.ot"
        self.assertEqual(run("export", self.archive, "--format", "octomap", "--output", octree).returncode, 0)
        for arguments in (["query", octree, "--layer", "objects"], ["export", octree, "--format", "ply", "--output", "x"],
                          ["snapshot", octree, "--output", "x"]):
            result = run(*arguments)
            self.assertEqual(result.returncode, 2)
            self.assertIn("kind 'octree'", result.stderr)

    def test_a_place_for_counts_is_judged_before_the_work(self):
        result = run("map", "--input", self.dataset, "--output", self.folder / "a.hmap", "--stats",
                     self.folder / "absent" / "stats.json")
        self.assertEqual(result.returncode, 3)
        self.assert_names()

    def test_whatever_is_not_there_is_an_error_of_the_system(self):
        absent = self.folder / "absent"
        output = ["--output", self.folder / "x"]
        mapping = ["map", "--input", self.dataset, *output]
        for arguments in (["map", "--input", absent, *output], ["tune", "--input", absent, "--frame", "0"],
                          [*mapping, "--config", absent], [*mapping, "--detections", absent],
                          [*mapping, "--model", absent], [*mapping, "--dataset", absent], ["info", absent],
                          ["query", absent, "--layer", "objects"], ["check", absent],
                          ["eval", "--map", absent, "--truth", self.archive]):
            with self.subTest(arguments):
                result = run(*arguments)
                self.assertEqual(result.returncode, 3, result.stderr)
                self.assertIn(str(absent), result.stdout + result.stderr)

    def test_a_name_may_be_no_utf8(self):
        name = os.fsdecode(b"x\xffy")
        dataset = self.folder / name
        shutil.copytree(self.dataset, dataset)
        archive = self.folder / (name + ".hmap")
        self.assertEqual(run("map", "--input", dataset, "--output", archive).returncode, 0)
        info = run_measured("info", archive, "--json")
        self.assertEqual(info.returncode, 0, info.stderr)
        self.assertEqual(json.loads(info.stdout)["provenance"]["input"], "x\\xffy")
        self.assertEqual(run("check", archive, dataset).returncode, 0)
        self.assertEqual(run("info", dataset, "--json").returncode, 0)
        absent = run("info", self.folder / (name + "z"))
        self.assertEqual(absent.returncode, 3)
        self.assertIn("x\\xffyz", absent.stderr)
        for arguments, status in ((["--layer", name, "--at", "0,0"], 2), (["--layer", "objects", "--string", name], 0),
                                  (["--nearest", name, "--at", "0,0"], 2)):
            self.assertEqual(run("query", archive, *arguments, "--json").returncode, status)
        transient = run("map", "--input", dataset, "--output", archive, "--transient", name)
        self.assertEqual(transient.returncode, 2)
        self.assertIn("UTF-8", transient.stderr)
        self.assertEqual(run(name).returncode, 4)

    def german(self):
        """An environment in which decimal numbers have a comma."""
        env = dict(os.environ, LC_ALL="de_DE.UTF-8", LANGUAGE="de")
        installed = subprocess.run(["locale", "-a"], capture_output=True, text=True, check=False).stdout
        if "de_de.utf8" in installed.lower().replace("-", ""):
            return env
        made = subprocess.run(["localedef", "-i", "de_DE", "-f", "UTF-8", self.folder / "de_DE.UTF-8"],
                              capture_output=True, check=False)
        if made.returncode != 0:
            self.skipTest("no German locale here, and none can be made")
        return dict(env, LOCPATH=str(self.folder))

    def test_the_language_changes_nothing(self):
        env = self.german()
        for arguments in (["config"], ["info", self.archive, "--json"], ["query", self.archive, "--layer", "occupancy",
                                                                      "--at", "0.5,0.5"]):
            self.assertEqual(run(*arguments, env=env).stdout, run(*arguments).stdout)
        output = self.folder / "a.hmap"
        result = run("map", "--input", self.dataset, "--output", output, "--resolution", "0.05", env=env)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(digest(output), digest(self.archive))


class Names(Case):
    """One rule for all names: case does not count, and a name that nobody knows is told with the nearest."""

    def test_case_does_not_count(self):
        for arguments in (["QUERY", self.archive, "--Layer", "Occupancy", "--STRING", "free"],
                          ["query", self.archive, "--layer", "Evidence", "--at", "0,0"],
                          ["info", self.archive, "--JSON"], ["config", "--preset", "SMAP"],
                          ["export", self.archive, "--format", "OctoMap", "--output", self.folder / "a.ot"],
                          ["export", self.archive, "--format", "Color OctoMap", "--output", self.folder / "c.ot"],
                          ["map", "--input", self.dataset, "--output", self.folder / "b.hmap", "--mode", "Discretize",
                           "--up", "-Y"],
                          ["check", "--as", "Archive", self.archive]):
            with self.subTest(arguments):
                result = run(*arguments)
                self.assertEqual(result.returncode, 0, result.stderr)

    def test_lists_are_separated_by_commas_or_repeated(self):
        for more in (["--class", "chair,cup"], ["--class", "chair", "--class", "cup"]):
            with self.subTest(more):
                result = run("export", self.archive, "--format", "ply", "--output", self.folder / "a.ply", *more)
                self.assertNotIn('"chair,cup"', result.stderr)

    def test_the_nearest_name_is_told(self):
        output = ["--output", self.folder / "x"]
        mapping = ["map", "--input", self.dataset, *output]
        query = ["query", self.archive, "--layer"]
        for arguments, status, told in (
                ([*mapping, "--preset", "Hypermpa"], 4, "hypermap"), (["config", "--preset", "smpa"], 4, "smap"),
                ([*mapping, "--mode", "projectiv"], 4, "projective"), ([*mapping, "--up", "flor"], 4, "floor"),
                ([*mapping, "--progress", "nver"], 4, "never"),
                (["tune", "--input", self.dataset, "--frame", "0", "--policy", "foregrund"], 4, "foreground"),
                (["simulate", *output, "--detector", "noizy"], 4, "noisy"),
                (["simulate", *output, "--scene", "labratory"], 2, "laboratory"),
                (["check", self.archive, "--as", "archiv"], 4, "archive"),
                (["export", self.archive, "--format", "geojsn", *output], 4, "geojson"),
                (["export", self.archive, "--format", "ros-map", "--layer", "ocupancy", *output], 2, "occupancy"),
                (["snapshot", self.archive, "--layers", "voxel", *output], 4, "voxels"),
                (["snapshot", self.archive, "--view", "topp", *output], 4, "top"),
                (["eval", "--map", self.archive, "--truth", self.archive, "--layer", "semantc"], 2, "semantic"),
                ([*query, "ocupancy", "--at", "0,0"], 2, "occupancy"),
                ([*query, "evidenc", "--at", "0,0"], 2, "evidence"),
                ([*query, "octree", "--at", "0,0", "--frame", "mpa"], 2, "map"),
                (["query", self.archive, "--nearest", "chair", "--at", "0,0", "--frame", "mpa"], 2, "map"),
                ([*query, "occupancy", "--string", "Fre"], 0, "Free")):
            with self.subTest(arguments):
                result = run(*arguments)
                self.assertEqual(result.returncode, status, result.stderr)
                self.assertIn(f'did you mean "{told}"?', result.stderr)
        self.assert_names()

    def test_options_files_and_descriptions_tell_the_nearest_choice(self):
        config = self.folder / "options.yaml"
        for text, told in (("preset: smpa", "smap"), ("integration: {mode: exat}", "exact")):
            config.write_text(text + "\n")
            refused = run("check", "--as", "config", config)
            self.assertEqual(refused.returncode, 2)
            self.assertIn(f'did you mean "{told}"?', refused.stdout)

    def test_a_name_that_is_far_from_all_choices_lists_them(self):
        result = run("config", "--preset", "garden")
        self.assertEqual(result.returncode, 4)
        self.assertIn('--preset: must be one of default, smap, hypermap, is "garden"\n', result.stderr)
        axis = run("map", "--input", self.dataset, "--output", self.folder / "x", "--up", "_x")
        self.assertEqual(axis.returncode, 4, "x or -x?")

    def test_a_state_of_space_that_is_nowhere_is_no_unknown_class(self):
        free = run("query", self.archive, "--layer", "occupancy", "--string", "free", "--area", "90 90,91 90,91 91")
        self.assertEqual((free.returncode, free.stderr), (0, ""))

    def test_an_empty_export_says_so(self):
        result = run("export", self.archive, "--format", "geojson", "--output", self.folder / "a.local.geojson")
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertIn("no file was written", result.stderr)
        self.assert_names()

    def test_outputs_that_are_no_such_files_are_refused(self):
        for arguments in (["snapshot", self.archive, "--output", self.folder / "x.jpg"], ["snapshot", self.archive, "--output", "-"],
                          ["map", "--input", self.dataset, "--output", "-"],
                          ["export", self.archive, "--format", "octomap", "--output", "-"]):
            with self.subTest(arguments):
                self.assertEqual(run(*arguments).returncode, 4)
        self.assertEqual(run("export", self.archive, "--format", "ply", "--output", self.folder / "x.jpg").returncode, 4)
        self.assert_names()

    def test_areas_are_taken_in_both_forms(self):
        layer = ["query", self.archive, "--layer", "occupancy", "--string", "Free", "--json"]
        texts = [run(*layer, "--area", area) for area in ("0 -1,2 -1,2 1,0 1", "0,-1 2,-1 2,1 0,1")]
        self.assertEqual(texts[0].returncode, 0, texts[0].stderr)
        self.assertEqual(texts[0].stdout, texts[1].stdout)
        wrong = run(*layer, "--area", "0,-1 2,-1 2 1")
        self.assertEqual(wrong.returncode, 4)
        self.assertIn('must be points "x y,x y,..."', wrong.stderr)

    def test_a_palette_of_classes_that_the_map_does_not_have_is_told(self):
        palette, names = self.folder / "palette.yaml", self.folder / "names.yaml"
        palette.write_text("Seat: '#102030'\nchiar: '#102030'\n")
        names.write_text("aliases: {chair: [seat]}\n")
        result = run("snapshot", self.archive, "--output", self.folder / "drawn.png", "--palette", palette, "--class-names", names)
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertEqual(result.stderr, f'warning: {palette}: chiar: is no class of the map, nor of its vocabulary, did you mean "chair"?\n')

    def test_a_palette_is_read_before_the_work(self):
        palette = self.folder / "palette.yaml"
        palette.write_text("chair: orange\n")
        for arguments in (["snapshot", "--output", self.folder / "x.png"],
                          ["export", "--format", "ply", "--output", self.folder / "x.ply"]):
            result = run(*arguments[:1], self.archive, *arguments[1:], "--palette", palette)
            self.assertEqual(result.returncode, 2)
            self.assertIn("palette.yaml:1: chair: must be a colour", result.stderr)
        self.assert_names("palette.yaml")

    def test_a_map_without_detections_says_what_it_lacks(self):
        dataset = self.folder / "dataset"
        shutil.copytree(self.dataset, dataset)
        (dataset / "detections_other.jsonl").write_text("")
        mapping = ["map", "--input", dataset, "--output", self.folder / "a.hmap"]
        result = run(*mapping)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("nothing was detected", result.stderr)
        self.assertIn("not used: detections_other.jsonl", result.stderr)
        (self.folder / "names.txt").write_text("chair\n")
        refused = run(*mapping, "--classes", self.folder / "names.txt")
        self.assertEqual(refused.returncode, 4)
        self.assertIn("--classes", refused.stderr)

    def test_every_command_shows_examples(self):
        commands = re.findall(r"^  ([a-z]+) ", run("--help").stdout.split("Subcommands:")[1], re.MULTILINE)
        self.assertGreater(len(commands), 10)
        for command in commands:
            self.assertIn(f"Examples:\n  hypermap {command} ", run(command, "--help").stdout)
        self.assertIn("trajectory", run("snapshot", "--help").stdout)

    def test_a_reader_that_goes_is_told_nothing(self):
        reader, writer = os.pipe()
        os.close(reader)
        with os.fdopen(writer, "w") as pipe:
            result = run("config", stdout=pipe)
        self.assertEqual(result.returncode, 3)
        self.assertEqual(result.stderr, "")


if __name__ == "__main__":
    unittest.main(verbosity=1)
