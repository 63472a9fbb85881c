#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What the program survives: signals, full disks, small limits, strange names, other languages.

Usage: contract_test.py PROGRAM [unittest args]"""

import json
import os
import pathlib
import resource
import shutil
import signal
import subprocess
import tempfile
import unittest

from program import IS_SANITIZED, PROGRAM, digest, run, run_measured
from tiny_dataset import make_dataset

OLD = b"what was there before"


def limited(*arguments, **limits):
    """Runs under soft and hard limits named as in `resource`: RLIMIT_<NAME>=value."""

    def apply():
        for name, value in limits.items():
            resource.setrlimit(getattr(resource, name), (value, value))

    return run_measured(*arguments, preexec_fn=apply)


def dead_process():
    with subprocess.Popen(["true"]) as child:
        return child.pid


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
                                           self.folder / "lab")
        self.assertEqual(status, 128 + signal.SIGTERM, message)
        self.assert_names()

    def test_what_a_killed_run_left_goes_with_the_next(self):
        arguments = ["simulate", "--frames", 200, "--output", self.folder / "lab"]
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
        living = f".hypermap-save-{os.getpid()}-0.tmp"
        for name in (dead, living):
            (self.folder / name).write_bytes(b"half")
        output = self.folder / "a.ply"
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
                        self.assert_names("a.hmap")
                outcomes.add(result.returncode)
                shutil.rmtree(self.folder / "lab", ignore_errors=True)
            self.assertIn(0, outcomes)


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
                if not str(target).startswith("/proc"):  # whose permissions say what is not so
                    self.assertNotIn("mapping", result.stderr)

    def test_nothing_is_written_over_what_is_read(self):
        dataset = self.folder / "dataset"
        shutil.copytree(self.dataset, dataset)
        archive = self.folder / "a.hmap"
        shutil.copy(self.archive, archive)
        link = self.folder / "link"
        link.symlink_to("a.hmap")
        options = self.folder / "options.yaml"
        options.write_text("octree: {resolution_m: 0.05}\n")
        mapping = ["map", "--input", dataset]
        cases = [["snapshot", archive, "--output", archive], ["snapshot", archive, "--output", link],
                 ["export", archive, "--format", "ply", "--output", self.folder / "." / "a.hmap"],
                 ["export", options, "--format", "ros-map", "--output", self.folder / "options"],
                 [*mapping, "--output", dataset / "groundtruth.txt"],
                 [*mapping, "--output", dataset / "depth" / "1.png"],
                 [*mapping, "--output", options, "--config", options],
                 [*mapping, "--output", self.folder / "new", "--stats", self.folder / "new"]]
        before = {path: path.read_bytes() for path in self.folder.rglob("*") if path.is_file()}
        for arguments in cases:
            with self.subTest(arguments):
                result = run(*arguments)
                self.assertEqual(result.returncode, 4, result.stderr)
                self.assertIn("write over", result.stderr)
        after = {path: path.read_bytes() for path in self.folder.rglob("*") if path.is_file()}
        self.assertEqual(before, after)
        self.assertEqual(run(*mapping, "--output", dataset / "map.hmap").returncode, 0)


class Words(Case):
    """Numbers, names and languages."""

    def test_numbers_that_are_none_are_wrong_command_lines(self):
        dataset = ["--input", self.dataset, "--output", self.folder / "x"]
        options = [["map", *dataset, "--resolution"], ["map", *dataset, "--max-range"],
                   ["map", *dataset, "--max-skipped"], ["map", *dataset, "--stamp-tolerance"],
                   ["simulate", "--output", self.folder / "x", "--pose-noise"],
                   ["snapshot", self.archive, "--output", self.folder / "x", "--cut-above"],
                   ["tune", "--input", self.dataset, "--frame", "0", "--leaf-size"]]
        for arguments in options:
            for text in ("nan", "-nan", "inf", "0,05", "1e300", "", "5 m", "wide"):
                with self.subTest([*arguments[:1], arguments[-1], text]):
                    result = run(*arguments[:-1], f"{arguments[-1]}={text}")
                    self.assertEqual(result.returncode, 4, result.stdout + result.stderr)
        self.assert_names()

    def test_points_and_areas_that_are_none_are_wrong_command_lines(self):
        layer = ["query", self.archive, "--layer", "occupancy"]
        for arguments, told in (([*layer, "--at", "1,b"], "'b'"), ([*layer, "--at", "1"], "2 or 3 numbers"),
                                ([*layer, "--at", "1,2,3"], "2 numbers"),
                                ([*layer], "--layer needs"),
                                ([*layer, "--area", "0 0,1 1"], "--area"),
                                (["query", self.archive, "--nearest", "chair", "--at", "1"], "2 or 3 numbers"),
                                ([*layer, "--at", "1,1", "--string", "Free"], "--at goes alone"),
                                ([*layer, "--int", "0", "--string", "Free"], "exclude each other"),
                                ([*layer, "--at", "1,1", "--nearest", "chair"], "--nearest asks the objects"),
                                (["tune", "--input", self.dataset, "--frame", "-1"], "-1"),
                                (["simulate", "--output", self.folder / "x", "--seed", "-1"], "-1")):
            with self.subTest(arguments[3:]):
                result = run(*arguments)
                self.assertEqual(result.returncode, 4, result.stderr)
                self.assertIn(told, result.stderr)

    def test_a_misspelt_option_is_named_though_another_is_missing(self):
        result = run("map", "--input", self.dataset, "--outptu", self.folder / "x")
        self.assertEqual(result.returncode, 4)
        self.assertIn(f"unknown: --outptu {self.folder / 'x'}", result.stderr)
        self.assertIn("unknown: mpa --input lab", run("mpa", "--input", "lab").stderr)
        self.assertIn("--output is required", run("map", "--input", self.dataset).stderr)

    def test_a_file_of_another_kind_is_named_as_what_it_is(self):
        octree = self.folder / "a.ot"
        self.assertEqual(run("export", self.archive, "--format", "octomap", "--output", octree).returncode, 0)
        for arguments in (["query", octree, "--layer", "objects"], ["export", octree, "--format", "ply", "--output", "x"],
                          ["snapshot", octree, "--output", "x"]):
            result = run(*arguments)
            self.assertEqual(result.returncode, 2)
            self.assertIn("kind 'octree'", result.stderr)

    def test_a_place_for_counts_is_judged_before_the_work(self):
        result = run("map", "--input", self.dataset, "--output", self.folder / "a.hmap", "--stats",
                     self.folder / "absent" / "stats.json")
        self.assertEqual(result.returncode, 3)
        self.assert_names()

    def test_whatever_is_not_there_is_an_error_of_the_system(self):
        absent = self.folder / "absent"
        output = ["--output", self.folder / "x"]
        mapping = ["map", "--input", self.dataset, *output]
        for arguments in (["map", "--input", absent, *output], ["tune", "--input", absent, "--frame", "0"],
                          [*mapping, "--config", absent], [*mapping, "--detections", absent],
                          [*mapping, "--model", absent], [*mapping, "--dataset", absent], ["info", absent],
                          ["query", absent, "--layer", "objects"], ["check", absent],
                          ["eval", "--map", absent, "--truth", self.archive]):
            with self.subTest(arguments):
                result = run(*arguments)
                self.assertEqual(result.returncode, 3, result.stderr)
                self.assertIn(str(absent), result.stdout + result.stderr)

    def test_a_name_may_be_no_utf8(self):
        name = os.fsdecode(b"x\xffy")
        dataset = self.folder / name
        shutil.copytree(self.dataset, dataset)
        archive = self.folder / (name + ".hmap")
        self.assertEqual(run("map", "--input", dataset, "--output", archive).returncode, 0)
        info = run_measured("info", archive, "--json")
        self.assertEqual(info.returncode, 0, info.stderr)
        self.assertEqual(json.loads(info.stdout)["provenance"]["input"], "x\\xffy")
        self.assertEqual(run("check", archive, dataset).returncode, 0)
        self.assertEqual(run("info", dataset, "--json").returncode, 0)
        absent = run("info", self.folder / (name + "z"))
        self.assertEqual(absent.returncode, 3)
        self.assertIn("x\\xffyz", absent.stderr)
        for arguments, status in ((["--layer", name, "--at", "0,0"], 2), (["--layer", "objects", "--string", name], 0),
                                  (["--nearest", name, "--at", "0,0"], 2)):
            self.assertEqual(run("query", archive, *arguments, "--json").returncode, status)
        transient = run("map", "--input", dataset, "--output", archive, "--transient", name)
        self.assertEqual(transient.returncode, 2)
        self.assertIn("UTF-8", transient.stderr)
        self.assertEqual(run(name).returncode, 4)

    def german(self):
        """An environment in which decimal numbers have a comma."""
        env = dict(os.environ, LC_ALL="de_DE.UTF-8", LANGUAGE="de")
        installed = subprocess.run(["locale", "-a"], capture_output=True, text=True, check=False).stdout
        if "de_de.utf8" in installed.lower().replace("-", ""):
            return env
        made = subprocess.run(["localedef", "-i", "de_DE", "-f", "UTF-8", self.folder / "de_DE.UTF-8"],
                              capture_output=True, check=False)
        if made.returncode != 0:
            self.skipTest("no German locale here, and none can be made")
        return dict(env, LOCPATH=str(self.folder))

    def test_the_language_changes_nothing(self):
        env = self.german()
        for arguments in (["config"], ["info", self.archive, "--json"], ["query", self.archive, "--layer", "occupancy",
                                                                      "--at", "0.5,0.5"]):
            self.assertEqual(run(*arguments, env=env).stdout, run(*arguments).stdout)
        output = self.folder / "a.hmap"
        result = run("map", "--input", self.dataset, "--output", output, "--resolution", "0.05", env=env)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(digest(output), digest(self.archive))


if __name__ == "__main__":
    unittest.main(verbosity=1)
