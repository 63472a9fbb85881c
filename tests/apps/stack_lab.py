# SPDX-License-Identifier: BSD-3-Clause
"""One small simulation and its map, which tests of stacks share."""

import json
import pathlib
import shutil
import tempfile
import unittest

from program import run

NUM_FRAMES = 12


class StackLab(unittest.TestCase):
    """One small simulation, mapped once."""

    @classmethod
    def setUpClass(cls):
        cls.shared = pathlib.Path(tempfile.mkdtemp(prefix="hypermap-stack-"))
        cls.archive = cls.shared / "lab.hmap"
        dataset = cls.shared / "lab"
        cls.made = [run("simulate", "--output", dataset, "--frames", NUM_FRAMES, "--seed", 1, "--size", "320x240",
                     "--detector", "perfect"),
                    run("map", "--input", dataset, "--resolution", 0.1, "--output", cls.archive)]

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.shared)

    def setUp(self):
        for result in self.made:
            self.assertEqual(result.returncode, 0, result.stderr)
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="hypermap-stack-"))
        self.addCleanup(shutil.rmtree, self.folder)

    def answer(self, command, *arguments, status=0):
        result = run(command, self.archive, "--output", self.folder / command, "--json", *arguments)
        self.assertEqual(result.returncode, status, result.stderr)
        return json.loads(result.stdout)

    def classes_with_a_grid(self):
        info = json.loads(run("info", self.archive, "--json").stdout)
        names = {entry["name"] for entry in info["classes"]}
        return sorted(entry["name"] for entry in info["layers"] if entry["name"] in names)
