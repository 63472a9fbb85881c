# SPDX-License-Identifier: BSD-3-Clause
"""What the cases of the contract share."""

import os
import pathlib
import shutil
import tempfile
import unittest

from program import run
from tiny_dataset import make_dataset


class Case(unittest.TestCase):
    """A small dataset and its archive, and an empty folder for each test."""

    @classmethod
    def setUpClass(cls):
        cls.shared = pathlib.Path(tempfile.mkdtemp(prefix="hypermap-contract-"))
        cls.dataset = make_dataset(cls.shared / "dataset", stamps=[f"{i / 10:.1f}" for i in range(1, 41)],
                                   size=(160, 120))
        cls.archive = cls.shared / "a.hmap"
        cls.mapped = run("map", "--input", cls.dataset, "--output", cls.archive)

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.shared)

    def setUp(self):
        self.assertEqual(self.mapped.returncode, 0, self.mapped.stderr)
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="hypermap-contract-"))
        self.addCleanup(shutil.rmtree, self.folder)

    def assert_names(self, *names):
        self.assertEqual(sorted(os.listdir(self.folder)), sorted(names))
