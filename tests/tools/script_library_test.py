#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""scripts/lib.sh: what a build shows of its progress, and that it ends as the build ended."""

import os
import pathlib
import subprocess
import tempfile
import unittest

LIBRARY = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "lib.sh"


def bash(script, text="", env=None):
    return subprocess.run(["bash", "-c", f"set -euo pipefail; . {LIBRARY}; {script}"], input=text, env=env,
                          capture_output=True, text=True, check=False)


class Tenths(unittest.TestCase):
    def shown(self, text):
        result = bash("only_tenths", text)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result.stdout.splitlines()

    def test_each_tenth_is_a_line(self):
        lines = self.shown("".join(f"[{i}/25] Building a_{i}.o\n" for i in range(1, 26)))
        # 10 %: 2.5 of 25 files, so 3; 20 %: 5; 30 %: 7.5, so 8; ...
        self.assertEqual(lines, [f"built {i} of 25 files" for i in (3, 5, 8, 10, 13, 15, 18, 20, 23, 25)])

    def test_a_large_step_is_one_line(self):
        self.assertEqual(self.shown("[1/3] a\n[2/3] b\n[3/3] c\n"), [f"built {i} of 3 files" for i in (1, 2, 3)])

    def test_what_is_no_status_stays_as_it_is(self):
        text = "FAILED: a.o\na.cpp:1: error: [1/2] no\n[see above]\n  note\n"
        self.assertEqual(self.shown("[1/100] a\n" + text), text.splitlines())

    def test_nothing_to_do_is_no_line(self):
        self.assertEqual(self.shown("ninja: Entering directory `x'\nninja: no work to do.\n"), [])


class Builds(unittest.TestCase):
    """With a `cmake` that says what it was called with, as ninja would."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="hypermap-scripts-")
        self.addCleanup(folder.cleanup)
        self.env = dict(os.environ, PATH=f"{folder.name}:{os.environ['PATH']}")
        self.cmake = pathlib.Path(folder.name) / "cmake"

    def built(self, call, status=0):
        self.cmake.write_text("#!/bin/sh\n[ \"$1\" = --build ] || exit 0\necho \"$* $NINJA_STATUS\" >&2\n"
                              f"echo '[1/2] a'\necho '[2/2] b'\nexit {status}\n")
        self.cmake.chmod(0o755)
        return bash(f"jobs=3; {call}", env=self.env)

    def test_a_build_is_quiet(self):
        result = self.built("build release one two")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("--build --preset release -j 3 --target one two -- --quiet", result.stderr)
        self.assertIn("--build --preset dev -j 3 -- --quiet", self.built("build dev").stderr)

    def test_progress_is_shown_on_demand(self):
        result = self.built("build_showing_progress release one")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(result.stderr, "--build --preset release -j 3 --target one [%f/%t] \n")
        self.assertTrue(result.stdout.endswith("built 1 of 2 files\nbuilt 2 of 2 files\n"), result.stdout)

    def test_a_build_that_fails_fails_either_way(self):
        self.assertEqual(self.built("build release", status=7).returncode, 7)
        self.assertEqual(self.built("build_showing_progress release", status=7).returncode, 7)


if __name__ == "__main__":
    unittest.main(verbosity=1)
