#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""How progress is shown: written over on a terminal, else a line for each per cent, or not at all.

Usage: progress_test.py PROGRAM [unittest args]"""

import fcntl
import os
import re
import struct
import subprocess
import termios
import unittest

from contract_case import Case
from program import PROGRAM, run

NUM_FRAMES = 40
# Rate and time stand there when there was the time to measure them.
LINE = r"mapping (\d+)/40 \((\d+) %\)(, \S+ (a second|s each)(, .* left)?)?"


class ProgressLines(Case):
    def mapping(self, *more):
        return [*more, "map", "--input", self.dataset, "--output", self.folder / "a.hmap"]

    def on_terminal(self, columns, *arguments):
        """What a terminal of that width is sent."""
        ours, theirs = os.openpty()
        fcntl.ioctl(theirs, termios.TIOCSWINSZ, struct.pack("HHHH", 24, columns, 0, 0))
        with subprocess.Popen([str(PROGRAM), *map(str, arguments)], stdout=subprocess.DEVNULL, stderr=theirs) as child:
            os.close(theirs)
            sent = b""
            try:
                while piece := os.read(ours, 4096):
                    sent += piece
            except OSError:  # the other end is closed
                pass
        os.close(ours)
        self.assertEqual(child.returncode, 0)
        return sent.decode()

    def test_a_terminal_has_one_line_that_is_written_over(self):
        sent = self.on_terminal(120, *self.mapping())
        lines = [line for line in sent.split("\r") if line.startswith("mapping")]
        self.assertGreaterEqual(len(lines), NUM_FRAMES)
        for line in lines:
            self.assertRegex(line.rstrip(), f"^{LINE}$")
        self.assertTrue(lines[-1].startswith("mapping 40/40 (100 %)"), lines)
        self.assertEqual(sent.count("\n"), 1 + sent.count("map: "))

    def test_a_line_is_no_longer_than_the_terminal_is_wide(self):
        sent = self.on_terminal(16, *self.mapping())
        lines = [line.strip("\n") for line in sent.split("\r") if line.startswith("mapping")]
        self.assertEqual(max(map(len, lines)), 15)
        self.assertIn("mapping 10/40 (", lines)

    def test_elsewhere_each_percent_is_a_line(self):
        result = run(*self.mapping("--progress", "always"))
        lines = [line for line in result.stderr.splitlines() if line.startswith("mapping")]
        self.assertEqual(len(lines), NUM_FRAMES)
        for number, line in enumerate(lines, 1):
            self.assertEqual(re.match(f"{LINE}$", line).group(1), str(number))
        self.assertNotIn("\r", result.stderr)

    def test_it_is_silent_elsewhere_unless_wanted_and_when_never(self):
        self.assertNotIn("mapping", run(*self.mapping()).stderr)
        self.assertNotIn("mapping", self.on_terminal(120, *self.mapping("--progress", "never")))


if __name__ == "__main__":
    unittest.main(verbosity=1)
