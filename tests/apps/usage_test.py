#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Help, version and wrong command lines. Usage: usage_test.py PROGRAM [unittest args]"""

import unittest

from program import run

COMMANDS = ("simulate detect combine map map-many import crop split transform update merge info classes config query shell export stack "
            "cells snapshot eval diff tune check repair").split()


class Usage(unittest.TestCase):
    def test_help_is_on_stdout_and_ends_with_0(self):
        for arguments in [["--help"], *[[command, "--help"] for command in COMMANDS]]:
            with self.subTest(arguments):
                result = run(*arguments)
                self.assertEqual(result.returncode, 0, result.stderr)
                self.assertIn("Usage", result.stdout)

    def test_version(self):
        self.assertRegex(run("--version").stdout, r"^hypermap \d+\.\d+\.\d+\n$")

    def test_wrong_command_lines_end_with_4(self):
        for arguments in [[], ["nonsense"], ["map"], ["map", "--input"], ["map", "--no-such-option"],
                          ["map", "--input", "x", "--output", "y", "--resolution", "nan"],
                          ["map", "--input", "x", "--output", "y", "--resolution", "-1"],
                          ["map", "--input", "x", "--output", "y", "--mode", "fast"],
                          ["map", "--input", "x", "--output", "y", "--weights", "yolo=-1"],
                          ["map", "--input", "x", "--output", "y", "--weights", "yolo=1e7"],
                          ["map", "--input", "x", "--output", "y", "--weights", "yolo"],
                          ["map", "--input", "x", "--output", "y", "--detector", "yolo"],
                          ["map-many"], ["map-many", "x"], ["map-many", "x", "--output", "x"],
                          ["map-many", "x", "--output", "y", "--jobs", "-1"],
                          ["map-many", "x", "--output", "y", "--detector", "yolo"],
                          ["classes", "x", "--set", "y", "--clear"],
                          ["update", "x"], ["update", "x", "--batch", "y", "--grid", "z"],
                          ["simulate", "--output", "x", "--frames", "0"],
                          ["snapshot", "x", "--output", "y", "--size", "0x7"],
                          ["query", "x", "--at", "1,2"], ["query", "x", "--string", "chair"],
                          ["export", "x", "--format", "octomap", "--output", "y.o"]]:
            with self.subTest(arguments):
                result = run(*arguments)
                self.assertEqual(result.returncode, 4, result.stderr)
                self.assertNotEqual(result.stderr.strip(), "")

    def test_numbers_are_refused_by_their_rule(self):
        whole = "must be a whole number from 0 on, is '{}'"
        for arguments, words in [(["simulate", "--output", "x", "--seed", "1.5"], whole.format("1.5")),
                                 (["simulate", "--output", "x", "--seed", "9" * 23], whole.format("9" * 23)),
                                 (["tune", "--input", "x", "--frame", "0x1"], whole.format("0x1")),
                                 (["simulate", "--output", "x", "--size", "60000x60000"],
                                  "must have at most 67108864 pixels, is '60000x60000'")]:
            with self.subTest(arguments):
                result = run(*arguments)
                self.assertEqual(result.returncode, 4, result.stderr)
                self.assertIn(words, result.stderr)

    def test_only_options_that_there_are_are_proposed(self):
        for arguments in (["stack", "--file", "m.hmap"], ["info", "--file", "m.hmap"], ["stack", "--files", "m.hmap"]):
            with self.subTest(arguments):
                result = run(*arguments)
                self.assertEqual(result.returncode, 4)
                self.assertNotIn('"--file"', result.stderr)
        self.assertIn('did you mean "--tiles"?', run("stack", "--tile", "drive", "--output", "grids").stderr)

    def test_words_that_are_missing_are_told_with_what_they_are(self):
        for arguments, words in ((["diff"], "missing: before (archive of the earlier map), after (archive of the later map)"),
                                 (["diff", "monday.hmap"], "missing: after (archive of the later map)"),
                                 (["crop", "--area", "0 0,1 0,1 1", "--output", "x.hmap"], "missing: map (archive)"),
                                 (["merge", "--output", "x.hmap"], "missing: files (archives, two or more;")):
            with self.subTest(arguments):
                result = run(*arguments)
                self.assertEqual(result.returncode, 4)
                self.assertIn(words, result.stderr)

    def test_a_full_device_is_no_success(self):
        with open("/dev/full", "w", encoding="utf-8") as full:
            self.assertEqual(run("config", stdout=full).returncode, 3)

    def test_a_missing_input_is_named(self):
        for arguments in [["info", "/nonexistent/a.hmap"], ["check", "/nonexistent/a.hmap"],
                          ["eval", "--map", "/nonexistent/a.hmap", "--truth", "/nonexistent/b.hmap"]]:
            with self.subTest(arguments):
                result = run(*arguments)
                self.assertIn(result.returncode, (2, 3))
                self.assertIn("/nonexistent/", result.stderr + result.stdout)


if __name__ == "__main__":
    unittest.main(verbosity=1)
