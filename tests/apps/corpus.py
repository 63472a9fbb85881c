# SPDX-License-Identifier: BSD-3-Clause
"""The hostile corpus, and what has to hold for each of its files."""

import pathlib
import shutil
import tempfile
import unittest

from program import DATA, IS_SANITIZED, run_measured

CORPUS = DATA / "hostile"
MAX_CPU_S = 2.0
MAX_BYTES = 256 << 20

# The corpus leaves a choice here: these are repaired, which is a finding, instead of refused.
REPAIRED = ("err_inner_children_disagree.ot", "err_bbox_outside.json")


def files_of(kind):
    """All of them; every fourth under a sanitizer, which sees each read by the tests of the readers."""
    return sorted((CORPUS / kind).iterdir())[::4 if IS_SANITIZED else 1]


def must_load(path):
    return path.name.startswith("ok_") or path.name in REPAIRED


class Corpus(unittest.TestCase):
    def setUp(self):
        if not CORPUS.is_dir():
            self.skipTest(f"test data not present: {CORPUS}")
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="hypermap-hostile-"))
        self.addCleanup(shutil.rmtree, self.folder)

    def measured(self, *arguments):
        result = run_measured(*arguments)
        if not IS_SANITIZED:
            self.assertLess(result.cpu_s, MAX_CPU_S, arguments)
            self.assertLess(result.peak_bytes, MAX_BYTES, arguments)
        return result

    def assert_accepted(self, *arguments):
        result = self.measured(*arguments)
        self.assertIn(result.returncode, (0, 1), f"{arguments}: {result.stderr}")
        return result

    def assert_refused(self, named, *arguments):
        """Exit code 2, one line that names the file and what is wrong in it, nothing else told."""
        result = self.measured(*arguments)
        self.assertEqual(result.returncode, 2, f"{arguments}: {result.stdout}{result.stderr}")
        self.assertEqual(len(result.error_lines), 1, result.stderr)
        self.assertIn(named, result.stderr)
        self.assertRegex(result.stderr, r"^hypermap: .+: .+")
        self.assertLess(len(result.stderr), 2000)
        self.assertEqual(result.stdout, "")
        return result
