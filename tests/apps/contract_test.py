#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What the program survives: signals, full disks, small limits, targets of every kind.

Usage: contract_test.py PROGRAM [unittest args]"""

import fcntl
import os
import pathlib
import resource
import shutil
import signal
import subprocess
import unittest

from contract_case import Case
from program import IS_SANITIZED, PROGRAM, digest, run, run_measured

OLD = b"what was there before"
SMALL = ("--size", "160x120")  # its frames still take long enough to be interrupted


def limited(*arguments, **limits):
    """Runs under soft and hard limits named as in `resource`: RLIMIT_<NAME>=value."""

    def apply():
        for name, value in limits.items():
            resource.setrlimit(getattr(resource, name), (value, value))

    return run_measured(*arguments, preexec_fn=apply)


def dead_process():
    with subprocess.Popen(["true"]) as child:
        return child.pid


class Signals(Case):
    def interrupted(self, number, *arguments):
        """Sends the signal once the first frame is done."""
        command = [str(PROGRAM), "--progress", "always", *map(str, arguments)]
        with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) as child:
            child.stderr.readline()
            child.send_signal(number)
            message = child.stderr.read()
        return child.returncode, message

    def test_map_rolls_back(self):
        output = self.folder / "a.hmap"
        for number in (signal.SIGINT, signal.SIGTERM):
            with self.subTest(number):
                output.write_bytes(OLD)
                status, message = self.interrupted(number, "map", "--input", self.dataset, "--output", output)
                self.assertEqual(status, 128 + number, message)
                self.assertIn("interrupted", message)
                self.assertEqual(output.read_bytes(), OLD)
                self.assert_names("a.hmap")

    def test_simulate_rolls_back(self):
        status, message = self.interrupted(signal.SIGTERM, "simulate", "--frames", 200, "--output",
                                           self.folder / "lab", *SMALL)
        self.assertEqual(status, 128 + signal.SIGTERM, message)
        self.assert_names()

    def test_what_a_killed_run_left_goes_with_the_next(self):
        arguments = ["simulate", "--frames", 200, "--output", self.folder / "lab", *SMALL]
        status, _ = self.interrupted(signal.SIGKILL, *arguments)
        self.assertEqual(status, -signal.SIGKILL)
        self.assertNotIn("lab", os.listdir(self.folder))
        self.assertEqual(len(os.listdir(self.folder)), 1)
        arguments[2] = 2
        self.assertEqual(run(*arguments).returncode, 0)
        self.assert_names("lab")
        self.assertEqual(run(*arguments).returncode, 0, "a simulation is replaced")
        self.assert_names("lab")

    def test_temporaries_of_the_dead_go_and_those_of_the_living_stay(self):
        dead = f".hypermap-save-{dead_process()}-0.tmp"
        same_number = f".hypermap-save-{os.getpid()}-0.tmp"
        living = f".hypermap-save-{dead_process()}-1.tmp"  # perhaps of another container
        for name in (dead, same_number, living):
            (self.folder / name).write_bytes(b"half")
        output = self.folder / "a.ply"
        with open(self.folder / living, "rb") as file:
            fcntl.flock(file, fcntl.LOCK_EX)
            self.assertEqual(run("export", self.archive, "--format", "ply", "--output", output).returncode, 0)
        self.assert_names("a.ply", living)


class Limits(Case):
    def test_a_full_device_is_no_success(self):
        cases = [["--help"], ["--version"], ["map", "--help"], ["config"], ["config", "--json"],
                 ["info", self.archive], ["info", self.archive, "--json"], ["check", self.archive],
                 ["query", self.archive, "--layer", "objects"],
                 ["export", self.archive, "--format", "ply", "--output", self.folder / "a.ply"],
                 ["eval", "--map", self.archive, "--truth", self.archive]]
        for arguments in cases:
            with self.subTest(arguments), open("/dev/full", "w", encoding="utf-8") as full:
                self.assertEqual(run(*arguments, stdout=full).returncode, 3)

    def test_a_closed_output_is_no_success(self):
        result = run_measured("config", preexec_fn=lambda: os.close(1))
        self.assertEqual(result.returncode, 3, result.stderr)

    def test_a_limit_on_file_sizes_is_an_error(self):
        output = self.folder / "a.hmap"
        output.write_bytes(OLD)
        for arguments in (["map", "--input", self.dataset, "--output", output],
                          ["export", self.archive, "--format", "ply", "--output", self.folder / "a.ply"],
                          ["simulate", "--frames", 2, "--output", self.folder / "lab"]):
            with self.subTest(arguments[0]):
                result = limited(*arguments, RLIMIT_FSIZE=1024)
                self.assertEqual(result.returncode, 3, result.stderr)
                self.assertIn("File too large", result.stderr)
                self.assertEqual(len(result.error_lines), 1, result.stderr)
                self.assert_names("a.hmap")
        self.assertEqual(output.read_bytes(), OLD)

    @unittest.skipIf(IS_SANITIZED, "sanitizers want more")
    def test_few_descriptors_and_small_stacks_suffice(self):
        for limit in ({"RLIMIT_NOFILE": 16}, {"RLIMIT_STACK": 256 << 10}):
            with self.subTest(limit):
                output = self.folder / "a.hmap"
                result = limited("map", "--input", self.dataset, "--output", output, **limit)
                self.assertEqual(result.returncode, 0, result.stderr)
                self.assertEqual(digest(output), digest(self.archive))

    def take_rescued(self, result):
        """A map that memory sufficed to make but not to save is rescued; the error says where."""
        rescued = self.folder / "a.hmap.rescue"
        if not rescued.exists():
            return
        self.assertIn(str(rescued), result.stderr)
        self.assertEqual(run("info", rescued).returncode, 0)
        rescued.unlink()

    @unittest.skipIf(IS_SANITIZED, "sanitizers reserve addresses")
    def test_too_little_memory_is_an_error_or_enough(self):
        step = 12 << 20
        least = step * 16
        while limited("--version", RLIMIT_AS=least).returncode != 0:
            least += step  # the system's loader and libraries cannot even start
        output = self.folder / "a.hmap"
        commands = (["map", "--input", self.dataset, "--output", output, "--threads", "2"],
                    ["simulate", "--frames", "2", "--output", self.folder / "lab"])
        for arguments in commands:
            outcomes = set()
            for budget in range(least, least + 24 * step, step):
                output.write_bytes(OLD)
                result = limited(*arguments, RLIMIT_AS=budget)
                with self.subTest(arguments[0], budget=budget):
                    self.assertIn(result.returncode, (0, 3), result.stderr)
                    if result.returncode != 0:
                        self.assertEqual(output.read_bytes(), OLD)
                        self.take_rescued(result)
                        self.assert_names("a.hmap")
                outcomes.add(result.returncode)
                shutil.rmtree(self.folder / "lab", ignore_errors=True)
            self.assertIn(0, outcomes)

    @unittest.skipIf(IS_SANITIZED, "sanitizers reserve addresses")
    def test_a_picture_without_memory_says_so(self):
        output = self.folder / "a.png"
        outcomes = set()
        for megabytes in range(300, 1500, 60):
            result = limited("snapshot", self.archive, "--output", output, RLIMIT_AS=megabytes << 20)
            with self.subTest(megabytes=megabytes):
                self.assertIn(result.returncode, (0, 3), result.stderr)
                for reason in ("font", "install"):
                    self.assertNotIn(reason, result.stderr)
                self.assertEqual(output.exists(), result.returncode == 0)
            output.unlink(missing_ok=True)
            outcomes.add(result.returncode)
        self.assertEqual(outcomes, {0, 3})


class Targets(Case):
    def map_to(self, output, *more):
        return run("map", "--input", self.dataset, "--output", output, *more)

    def test_a_link_stays_and_its_target_is_replaced(self):
        target = self.folder / "elsewhere" / "real.hmap"
        target.parent.mkdir()
        target.write_bytes(OLD)
        target.chmod(0o640)
        link = self.folder / "link.hmap"
        link.symlink_to("elsewhere/real.hmap")
        self.assertEqual(self.map_to(link).returncode, 0)
        self.assertTrue(link.is_symlink())
        self.assertEqual(digest(target), digest(self.archive))
        self.assertEqual(target.stat().st_mode & 0o777, 0o640)
        self.assertEqual(os.listdir(target.parent), ["real.hmap"])

    def test_a_target_that_cannot_be_written_is_told_before_the_work(self):
        targets = [self.folder, self.folder / "none" / "a.hmap", pathlib.Path("/dev/null"),
                   pathlib.Path("/proc/a.hmap")]
        if os.geteuid() != 0:
            locked = self.folder / "locked"
            locked.mkdir(mode=0o500)
            targets.append(locked / "a.hmap")
        for target in targets:
            with self.subTest(target):
                result = run("--progress", "always", "map", "--input", self.dataset, "--output", target)
                self.assertEqual(result.returncode, 3, result.stderr)
                self.assertIn(str(target), result.stderr)
                self.assertNotIn("mapping", result.stderr)

    def test_a_strangers_files_may_be_kept_to_their_folder(self):
        theirs = self.folder / "theirs"
        theirs.mkdir()
        (self.folder / "ours.yaml").write_text("- {name: sink, shape: 'POLYGON((0 0,1 0,1 1,0 0))'}\n")
        (self.folder / "ours.pgm").write_bytes(b"P5 1 1 255\n\0")
        config, grid = theirs / "map.yaml", theirs / "grid.yaml"
        config.write_text("layers:\n- {class: SemanticLayer, name: s, frame_id: map, load_file: true, "
                          "file: ../ours.yaml}\n")
        grid.write_text("image: ../ours.pgm\nresolution: 1\norigin: [0, 0, 0]\nnegate: 0\n"
                        "occupied_thresh: 0.65\nfree_thresh: 0.2\nmode: trinary\n")
        for file, field in ((config, "layers[0].file"), (grid, "image")):
            for command in (["info", file], ["check", file]):
                with self.subTest(command):
                    self.assertEqual(run(*command).returncode, 0)
                    refused = run(*command, "--confined")
                    self.assertEqual(refused.returncode, 2, refused.stderr)
                    self.assertIn(field, refused.stdout + refused.stderr)
                    self.assertIn(f"lies outside {theirs.resolve()}", refused.stdout + refused.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=1)
