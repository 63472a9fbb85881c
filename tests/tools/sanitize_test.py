#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""scripts/sanitize: a test is run when what it is about has changed, all are within some commits, no other is built."""

import importlib.machinery
import importlib.util
import pathlib
import sys
import unittest
from unittest import mock

SCRIPTS = pathlib.Path(__file__).resolve().parents[2] / "scripts"


def loaded():
    """The program as a module; its name has no ending."""
    sys.path.insert(0, str(SCRIPTS))
    loader = importlib.machinery.SourceFileLoader("sanitize", str(SCRIPTS / "sanitize"))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader("sanitize", loader))
    loader.exec_module(module)
    return module


sanitize = loaded()


class Topics(unittest.TestCase):
    def test_sources_of_the_folder_that_is_tested(self):
        test = "tests/core/objects/box_test.cpp"
        for changed in (test, "core/src/objects/evidence/votes.cpp", "core/include/hypermap/core/objects/object.hpp",
                        "tests/core/objects/room.hpp"):
            self.assertTrue(sanitize.is_about(test, changed), changed)
        for changed in ("core/src/geometry/box.cpp", "io/archive/src/objects/object_json.cpp", "docs/RESULTS.md"):
            self.assertFalse(sanitize.is_about(test, changed), changed)


class Programs(unittest.TestCase):
    BUILD = "/build/tsan"
    FOLDER = {"name": "WORKING_DIRECTORY", "value": "/build/tsan/tests/io"}

    def is_started(self, linked, command, *properties):
        test = {"name": "io_a_tests", "command": command, "properties": [self.FOLDER, *properties]}
        return sanitize.is_started_by(test, linked, self.BUILD)

    def test_its_own_and_no_neighbour_in_the_folder_that_it_runs_in(self):
        command = ["/build/tsan/tests/io/io_a_tests", "--gtest_brief=1"]
        self.assertTrue(self.is_started("tests/io/io_a_tests", command))
        self.assertFalse(self.is_started("tests/io/io_b_tests", command))

    def test_what_the_command_and_the_environment_name(self):
        script = ["python3", "c_test.py", "/build/tsan/apps/hypermap"]
        self.assertTrue(self.is_started("apps/hypermap", script))
        preload = {"name": "ENVIRONMENT", "value": ["FAULTS=/build/tsan/tests/support/faults.so"]}
        self.assertTrue(self.is_started("tests/support/faults.so", script, preload))
        self.assertTrue(self.is_started("tests/fuzz/seeds", ["run", "--tools=/build/tsan/tests/fuzz"]))


class Choice(unittest.TestCase):
    TESTS = [{"name": "a_tests"}, {"name": "b_tests"},
             {"name": "cli/C", "command": ["python3", f"{sanitize.ROOT}/tests/apps/c_test.py"]}, {"name": "d_tests"}]
    PROGRAMS = {"a_tests": {"tests/core/base/a_test.cpp"}, "b_tests": {"tests/io/dataset/b_test.cpp"}, "d_tests": set()}

    def chosen(self, changed, share=frozenset()):
        with mock.patch.object(sanitize, "share", lambda names, parts: set(share)):
            return sanitize.chosen(self.TESTS, self.PROGRAMS, changed)

    def test_what_changed(self):
        self.assertEqual(self.chosen({"io/dataset/src/reader.cpp", "README.md"}), ["b_tests"])
        self.assertEqual(self.chosen({"tests/apps/c_test.py"}), ["cli/C"])

    def test_a_share_besides(self):
        self.assertEqual(self.chosen({"core/src/base/a.cpp"}, {"d_tests"}), ["a_tests", "d_tests"])

    def test_everything_where_nothing_tells_what_changed(self):
        self.assertEqual(self.chosen(None), [test["name"] for test in self.TESTS])

    def test_three_commits_see_everything(self):
        import selection
        names = [f"test {i}" for i in range(11)]
        seen = []
        for count in (41, 42, 43):
            with mock.patch.object(selection, "git", lambda *arguments, count=count: [str(count)]):
                seen += selection.share(names, 3)
        self.assertEqual(sorted(seen), sorted(names))


if __name__ == "__main__":
    unittest.main()
