#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The shell as somebody who types sees it.

Usage: shell_terminal_test.py PROGRAM [unittest args]. Environment HYPERMAP_FAULTS_PRELOAD names the library that
holds the program up between seeing keys and reading them."""

import os
import pathlib
import pty
import select
import shutil
import signal
import tempfile
import time
import unittest

from program import PROGRAM, SOURCE

FILES = SOURCE / "tests/apps/shell"


class Terminal:
    """The program at a terminal of its own."""

    def __init__(self, folder, *arguments, **env):
        self.child, self.screen = pty.fork()
        if self.child == 0:
            os.chdir(folder)
            os.environ.update(TERM="xterm", XDG_STATE_HOME=str(folder / "state"), HOME=str(folder), **env)
            os.execv(str(PROGRAM), [str(PROGRAM), "shell", *arguments])
        self.text = ""

    def more(self, limit_s):
        """Whether more was shown, within a time; not once the program has ended."""
        ready, _, _ = select.select([self.screen], [], [], max(limit_s, 0))
        try:
            shown = os.read(self.screen, 4096) if ready else b""
        except OSError:
            shown = b""
        self.text += shown.decode(errors="replace")
        return bool(shown)

    def until(self, told, limit_s=20):
        """What came since the last call, up to and with a text."""
        end = time.monotonic() + limit_s
        while told not in self.text:
            if not self.more(end - time.monotonic()):
                shown = self.text
                self.status(0)
                raise AssertionError(f"waited for {told!r}, has {shown!r}")
        found, self.text = self.text.split(told, 1)
        return found + told

    def type(self, keys):
        os.write(self.screen, keys.encode())

    def status(self, limit_s=20):
        """Of the end, whatever is still shown before it; the program does not outlive the time."""
        while self.more(limit_s):
            pass
        os.close(self.screen)
        end = time.monotonic() + limit_s
        while time.monotonic() < end:
            child, status = os.waitpid(self.child, os.WNOHANG)
            if child != 0:
                return os.waitstatus_to_exitcode(status)
            time.sleep(0.01)
        os.kill(self.child, signal.SIGKILL)
        os.waitpid(self.child, 0)
        return None


PROMPT = "hypermap> "


class ShellTerminal(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="hypermap-shell-"))
        for file in FILES.iterdir():
            shutil.copy(file, self.folder)
        (self.folder / "a folder").mkdir()

    def tearDown(self):
        shutil.rmtree(self.folder)

    def test_tab_completes_commands_layers_names_ids_and_files(self):
        terminal = Terminal(self.folder)
        terminal.until(PROMPT)
        terminal.type("loadC\thou\t\r")
        terminal.until("house.yaml: 2 layers")
        terminal.until(PROMPT)
        terminal.type("getCo\t")
        terminal.until("ords")
        terminal.type("\t")
        self.assertIn("getCoords  getCoordsArea", terminal.until("getCoordsArea"))
        terminal.type(" fur\toff\t\r")
        self.assertIn("ice\\ chair", terminal.until("2.500 0.250"))
        terminal.until(PROMPT)
        terminal.type("getIntCoords furniture \t")
        terminal.until("0  1  2")
        terminal.type("0\r")
        terminal.until("0.500 0.500")
        terminal.until(PROMPT)
        terminal.type("getCoords plan Occ\t\r")
        terminal.until("-0.750 0.750")
        terminal.until(PROMPT)
        terminal.type("load a\t")
        terminal.until("\\ folder/")
        terminal.type("\x15frame ya\t\rexit\r")
        terminal.until("saved to no archive")
        self.assertEqual(terminal.status(), 0)

    def test_errors_and_ctrl_c_end_no_session_and_ctrl_d_ends_it(self):
        terminal = Terminal(self.folder, "house.yaml")
        terminal.until(PROMPT)
        terminal.type("nonsense\r")
        terminal.until("no command is named 'nonsense'")
        terminal.until(PROMPT)
        for _ in range(3):
            terminal.type("getLayerC")
            terminal.until("getLayerC")
            terminal.type("\x03")
            terminal.until(PROMPT)
        terminal.type("getLayerCount\r")
        terminal.until("\n2\r\n")
        terminal.until(PROMPT)
        terminal.type("\x04")
        self.assertEqual(terminal.status(), 0)

    def test_ctrl_c_that_drops_what_was_seen_but_not_read_is_answered(self):
        terminal = Terminal(self.folder, LD_PRELOAD=os.environ["HYPERMAP_FAULTS_PRELOAD"],
                            HYPERMAP_FAULT_AFTER_POLL_MS="200")
        terminal.until(PROMPT)
        for _ in range(3):
            terminal.type("x")
            time.sleep(0.1)
            terminal.type("\x03")
            terminal.until(PROMPT)
        terminal.type("\x04")
        self.assertEqual(terminal.status(), 0)

    def test_a_session_is_ended_from_outside(self):
        terminal = Terminal(self.folder)
        terminal.until(PROMPT)
        os.kill(terminal.child, signal.SIGTERM)
        self.assertEqual(terminal.status(), 143)

    def test_lines_are_kept_for_the_next_session(self):
        for typed, shown in (("getLayerCount\r", "\n0\r\n"), ("\x1b[A\r", "\n0\r\n")):
            terminal = Terminal(self.folder)
            terminal.until(PROMPT)
            terminal.type(typed)
            terminal.until(shown)
            terminal.until(PROMPT)
            terminal.type("\x04")
            self.assertEqual(terminal.status(), 0)
        history = self.folder / "state/hypermap/history"
        self.assertEqual(history.read_text(), "getLayerCount\ngetLayerCount\n")
        # Whatever stands there, a session begins.
        history.write_bytes(b"\x00\xff\n" * 10 + b"y" * 10000 + b"\n" + b"layers\n" * 3000)
        terminal = Terminal(self.folder)
        terminal.until(PROMPT)
        terminal.type("getLayerCount\rexit\r")
        self.assertEqual(terminal.status(), 0)
        self.assertEqual(len(history.read_text().splitlines()), 1000)


if __name__ == "__main__":
    unittest.main()
