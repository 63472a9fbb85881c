#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Archives that are too much as a whole: refused quickly and by name, raised limits, ended by signals.

Usage: budget_test.py PROGRAM [unittest args]"""

import os
import pathlib
import shutil
import signal
import subprocess
import tempfile
import threading
import time
import unittest

import hostile_archives
from program import IS_SANITIZED, PROGRAM, repetitions, run_measured

MAX_CPU_S = 2.0
MAX_BYTES = 256 << 20
UNLIMITED = str(1 << 62)


def user_seconds(pid):
    """CPU time of a process so far."""
    fields = pathlib.Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return int(fields[11]) / os.sysconf("SC_CLK_TCK")


class Case(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="hypermap-budget-"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.archive = self.folder / "a.hmap"
        self.outputs = self.folder / "outputs"
        self.outputs.mkdir()

    def commands(self):
        """Each command that loads an archive; nothing may be left in `outputs`."""
        path, out = self.archive, self.outputs
        return [["info", path],
                ["query", path, "--layer", "semantic", "--at", "0,0"],
                ["export", path, "--format", "geojson", "--output", out / "a.local.geojson"],
                ["snapshot", path, "--output", out / "a.png", "--size", "64x64"],
                ["eval", "--map", path, "--truth", path],
                ["check", path]]


class BudgetRefusals(Case):
    """The member that crosses a limit is named, with the limit, whatever the member by itself is."""

    def assert_refused(self, member, rule, *arguments):
        result = run_measured(*arguments)
        told = result.stdout + result.stderr
        self.assertEqual(result.returncode, 2, told)
        self.assertIn(f"a.hmap!{member}", told)
        self.assertRegex(told, r"brings .* to \d+ .*, the limit for all together is \d+ \(" + rule + r"\)")
        if not IS_SANITIZED:
            self.assertLess(result.cpu_s, MAX_CPU_S, arguments)
            self.assertLess(result.peak_bytes, MAX_BYTES, arguments)

    def test_every_command_refuses(self):
        hostile_archives.many_opaque_members(self.archive)
        for arguments in self.commands()[:repetitions(8)]:  # all; all load by the same code
            with self.subTest(arguments[0]):
                # 256 members of 1 MiB are 2^28 bytes, the limit itself.
                self.assert_refused("part0256", "max_opaque_bytes", *arguments)
        self.assertEqual(list(self.outputs.iterdir()), [])

    def test_images(self):
        hostile_archives.many_images(self.archive)
        # Five images of 2^28 pixels are the limit itself.
        self.assert_refused("grid005.png", "max_pixels", "info", self.archive)

    def test_shapes(self):
        hostile_archives.many_stars(self.archive)
        self.assert_refused(r"semantic:", "max_edge_tests", "info", self.archive)

    def test_octrees(self):
        hostile_archives.many_octrees(self.archive)
        # 2^27 nodes are 56 octrees of 2,396,745.
        self.assert_refused("tree056.bt", "max_octree_nodes", "info", self.archive)

    def test_images_of_a_folder_under_several_names(self):
        names = [f"grid{i}" for i in range(6)]
        (self.folder / "hmap_config.yaml").write_text(
            hostile_archives.layers_of("OccupancyGridLayer", names))
        (self.folder / "one.png").write_bytes(hostile_archives.blank_png(16384))
        for i, name in enumerate(names):
            image = "./" * i + "one.png"
            (self.folder / f"{name}.yaml").write_text(hostile_archives.OCCUPANCY.format(image=image))
        result = run_measured("info", self.folder / "hmap_config.yaml")
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertRegex(result.stderr, r"one\.png: .*\(max_pixels\)")

    def test_a_semantic_layer_by_itself(self):
        shape = hostile_archives.star(449, 223)
        (self.folder / "shapes.yaml").write_text("".join(
            f'- {{name: star{i:04}, shape: "{shape}"}}\n' for i in range(50)))
        result = run_measured("check", self.folder / "shapes.yaml")
        self.assertEqual(result.returncode, 2, result.stdout)
        self.assertIn("max_edge_tests", result.stdout)


class BudgetLimits(Case):
    """Limits are options, and what is within them loads."""

    def test_a_raised_limit_admits(self):
        hostile_archives.many_opaque_members(self.archive, count=300)
        self.assertEqual(run_measured("info", self.archive).returncode, 2)
        raised = run_measured("info", self.archive, "--max-opaque-bytes", 300 << 20)
        self.assertEqual(raised.returncode, 1, raised.stderr)  # kept members are findings

    def test_a_lowered_limit_refuses(self):
        hostile_archives.many_images(self.archive, count=3, side_px=10)
        for limit, status in ((300, 0), (299, 2)):
            result = run_measured("info", self.archive, "--max-pixels", limit)
            self.assertEqual(result.returncode, status, result.stderr)
        hostile_archives.many_stars(self.archive, count=2, num_points=5, step=2)
        self.assertEqual(run_measured("info", self.archive, "--max-edge-tests", 0).returncode, 2)
        hostile_archives.many_octrees(self.archive, count=2, depth=1)
        for limit, status in ((18, 0), (17, 2)):
            result = run_measured("info", self.archive, "--max-octree-nodes", limit)
            self.assertEqual(result.returncode, status, result.stderr)

    def test_more_than_4_gib_need_large(self):
        with open(self.archive, "wb") as file:  # a hole behind its first bytes: it takes no room
            file.write(b"PK\x03\x04")
            file.truncate((4 << 30) + 1)
        for arguments in (("check", self.archive), ("info", self.archive),
                          ("repair", self.archive, "--output", self.outputs / "b.hmap")):
            with self.subTest(arguments[0]):
                refused = run_measured(*arguments)
                self.assertEqual(refused.returncode, 2)
                self.assertIn("a.hmap: archive of 4294967297 bytes, the limit is 4294967296; --large allows 68719476736",
                              refused.stdout + refused.stderr)
        allowed = run_measured("check", self.archive, "--large")
        self.assertEqual(allowed.returncode, 2)
        self.assertNotIn("the limit is", allowed.stdout)  # it is read: there is no directory in it
        self.assertIn("a.hmap: ", allowed.stdout)
        self.assertEqual(list(self.outputs.iterdir()), [])

    def test_what_is_no_number_is_a_wrong_command_line(self):
        for value in ("-1", "many", "1.5"):
            self.assertEqual(run_measured("info", self.archive, "--max-pixels", value).returncode, 4, value)


class LoadSignals(Case):
    """A load that would take minutes ends when it is asked to."""

    def ended(self, number, arguments):
        """Sends the signal once the program has worked for a while; (exit code, what it said)."""
        with subprocess.Popen([str(PROGRAM), *map(str, arguments)], stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, text=True) as child:
            watchdog = threading.Timer(60, child.send_signal, [signal.SIGKILL])
            watchdog.start()
            while child.poll() is None and user_seconds(child.pid) < 0.5:
                time.sleep(0.01)
            child.send_signal(number)
            told = "".join(child.communicate())
            watchdog.cancel()
        return child.returncode, told

    def test_every_command_ends(self):
        hostile_archives.many_stars(self.archive)
        for number in (signal.SIGINT,) if IS_SANITIZED else (signal.SIGINT, signal.SIGTERM):
            for arguments in self.commands():
                with self.subTest(arguments[0], number=number):
                    status, told = self.ended(number, [*arguments, "--max-edge-tests", UNLIMITED])
                    self.assertEqual(status, 128 + number, told)
                    self.assertIn("interrupted", told)
        self.assertEqual(list(self.outputs.iterdir()), [])


if __name__ == "__main__":
    unittest.main()
