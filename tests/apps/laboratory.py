# SPDX-License-Identifier: BSD-3-Clause
"""Cases that all ask the same small map of the simulated laboratory."""

import pathlib
import shutil
import tempfile
import unittest

from program import run


class LaboratoryCase(unittest.TestCase):
    """`map`, made once a class in `folder`, where cases may write."""

    SIMULATION = ("--frames", 40)
    RESOLUTION_M = 0.05

    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="hypermap-laboratory-"))
        cls.map = cls.folder / "lab.hmap"
        steps = [("simulate", *cls.SIMULATION, "--seed", 1, "--detector", "perfect", "--output", cls.folder / "lab"),
                 ("map", "--input", cls.folder / "lab", "--output", cls.map, "--resolution", cls.RESOLUTION_M)]
        cls.failed = [result.stderr for result in (run(*step) for step in steps) if result.returncode not in (0, 1)]

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def setUp(self):
        self.assertEqual(self.failed, [])


class SmallLaboratoryCase(LaboratoryCase):
    """Of a few small frames and large voxels: for what does not depend on what is in the map."""

    SIMULATION = ("--frames", 12, "--size", "320x240")
    RESOLUTION_M = 0.1
