#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""scripts/simulated_maps.py: a program that fails is told of in its own words."""

import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "scripts"))

from simulated_maps import run  # noqa: E402  (found only now)

SAYS = "import sys; print(sys.argv[1]); print('no such map', file=sys.stderr); sys.exit(int(sys.argv[2]))"


class Run(unittest.TestCase):
    def test_gives_what_is_printed(self):
        self.assertEqual(run(sys.executable, "-c", SAYS, "found", 0), "found\n")

    def test_ends_with_what_the_program_says(self):
        with self.assertRaises(SystemExit) as ended:
            run(sys.executable, "-c", SAYS, "found", 2)
        self.assertEqual(ended.exception.code, "no such map")

    def test_says_what_failed_without_a_word(self):
        with self.assertRaises(SystemExit) as ended:
            run(sys.executable, "-c", "raise SystemExit(3)")
        self.assertIn("ended with 3", ended.exception.code)


if __name__ == "__main__":
    unittest.main()
