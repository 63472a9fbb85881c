#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Many sequences as one map, with a fault of the system or a kill at the program's calls. See faults_test.py.

Usage: sequences_faults_test.py PROGRAM [unittest args]"""

import os
import unittest

from faults import OLD, FaultCase
from program import run
from tiny_dataset import make_dataset


class Sequences(FaultCase):
    """Parts stay until the whole is there."""

    PARTS = "a.hmap.parts"

    def setUp(self):
        super().setUp()
        for name, stamps in (("a", ("1.0", "1.1")), ("b", ("2.0", "2.1")), ("c", ("3.0", "3.1"))):
            make_dataset(self.folder / name, stamps)
        (self.folder / "list.yaml").write_text("sequences: [a, b, c]\n")
        self.archive = self.out / "a.hmap"
        self.command = ["map-many", self.folder / "list.yaml", "--output", self.archive, "--resolution", 0.1, "--threads", 1]

    def pieces(self):
        return {name: content for name, content in super().pieces().items() if name != self.PARTS}

    def check_error(self, result, reason, is_new):
        """A line for each sequence that failed, as on a disk that is full; what is said of the whole is true of it."""
        lines = [line for line in result.stderr.splitlines() if line.startswith("hypermap: ")]
        self.assertGreater(len(lines), 0)
        for line in lines:
            self.assertIn(os.strerror(reason), line)
            self.assertIn(str(self.folder), line)
        self.assertEqual(any(f" {self.archive}: replaced" in line for line in lines), is_new, lines)

    def test_the_whole_is_old_or_new_and_a_killed_run_goes_on(self):
        self.check_faults(lambda: self.archive.write_bytes(OLD), self.command, count=40)
        self.assertEqual(run(*self.command).returncode, 0)  # after a fault the parts may stay
        self.assertFalse((self.out / self.PARTS).exists())

    def test_so_is_each_part(self):
        self.check_faults(lambda: None, [*self.command, "--keep-parts"], count=20)
        parts = {path.name for path in (self.out / self.PARTS).iterdir() if path.suffix == ".hmap"}
        self.assertEqual(parts, {"a.hmap", "b.hmap", "c.hmap"})


if __name__ == "__main__":
    unittest.main(verbosity=1)
