#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Many sequences as one map: by threads and by the ranks of an MPI job.

Usage: map_many_test.py PROGRAM [unittest args]. Environment HYPERMAP_FAULTS_PRELOAD names the library that kills a rank."""

import json
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

from program import PROGRAM, digest, run, tree_digest
from tiny_dataset import make_dataset

NUM_ROOMS = 5
RANK_PROGRAM = PROGRAM.parent / "hypermap-ranks"
# As the superuser, and with more ranks than cores.
MPIRUN = ["mpirun", "--allow-run-as-root", "--oversubscribe"]


class ManyCase(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="hypermap-many-"))
        self.addCleanup(shutil.rmtree, self.folder)
        for i in range(NUM_ROOMS):
            make_dataset(self.folder / f"room{i}", (f"{10 * i + 1}.0", f"{10 * i + 1}.1"))
        self.list = self.folder / "list.yaml"
        self.write_list([f"room{i}" for i in range(NUM_ROOMS)])

    def write_list(self, sequences):
        self.list.write_text(json.dumps({"sequences": sequences}))

    def many(self, output, *options, status=0):
        result = run("map-many", self.list, "--output", self.folder / output, "--resolution", 0.1, *options)
        self.assertEqual(result.returncode, status, f"{options}: {result.stdout}{result.stderr}")
        return result

    def notes(self, output, *options):
        told = json.loads(self.many(output, "--json", *options).stdout)
        return [one["note"] for one in told["sequences"]]


class MapMany(ManyCase):
    def test_any_number_of_threads_and_jobs_gives_the_same_bytes(self):
        self.many("a.hmap", "--threads", 1)
        for name, options in (("b", ("--threads", 2)), ("c", ("--jobs", 3, "--threads", 3)), ("d", ("--jobs", 1, "--threads", 4))):
            self.many(f"{name}.hmap", *options)
            self.assertEqual(digest(self.folder / f"{name}.hmap"), digest(self.folder / "a.hmap"), options)
        self.assertEqual(run("check", self.folder / "a.hmap").returncode, 0)
        self.assertEqual([path.name for path in self.folder.glob("*.parts")], [])

    def test_a_folder_keeps_the_part_of_each_sequence(self):
        self.many("building")
        names = {path.name for path in (self.folder / "building/parts").glob("*.hmap")}
        self.assertEqual(names, {f"room{i}.hmap" for i in range(NUM_ROOMS)})
        self.many("a.hmap")
        self.assertEqual(digest(self.folder / "building/map.hmap"), digest(self.folder / "a.hmap"))
        alone = self.folder / "alone.hmap"
        self.assertEqual(run("map", "--input", self.folder / "room2", "--resolution", 0.1, "--output", alone).returncode, 0)
        self.assertEqual(digest(alone), digest(self.folder / "building/parts/room2.hmap"))

    def test_a_second_run_goes_on_from_what_stands(self):
        self.assertEqual(self.notes("building"), ["made"] * NUM_ROOMS)
        before = tree_digest(self.folder / "building")
        self.assertEqual(self.notes("building"), ["kept"] * NUM_ROOMS)
        self.assertEqual(tree_digest(self.folder / "building"), before)
        with open(self.folder / "building/parts/room1.hmap", "r+b") as part:
            part.seek(100)
            part.write(b"x")
        self.assertEqual(self.notes("building")[1], "made anew: is not as it was made")
        self.assertEqual(tree_digest(self.folder / "building"), before)
        self.assertEqual(self.notes("building", "--max-range", 2), ["made anew: was made with other options"] * NUM_ROOMS)
        self.assertEqual(self.notes("building", "--force"), ["made"] * NUM_ROOMS)
        self.assertEqual(tree_digest(self.folder / "building"), before)

    def test_a_single_file_keeps_its_parts_when_told(self):
        self.many("a.hmap", "--keep-parts")
        self.assertTrue((self.folder / "a.hmap.parts/room0.hmap").exists())
        self.assertEqual(self.notes("a.hmap"), ["kept"] * NUM_ROOMS)
        self.assertFalse((self.folder / "a.hmap.parts").exists())
        self.many("B.HMAP")
        self.assertEqual(digest(self.folder / "B.HMAP"), digest(self.folder / "a.hmap"))

    def test_a_sequence_that_fails_is_named_and_the_others_are_kept(self):
        (self.folder / "room3/groundtruth.txt").write_text("no numbers\n")
        failed = self.many("a.hmap", status=2)
        self.assertRegex(failed.stderr, r"hypermap: .*room3.*\(of sequence room3\)\n")
        self.assertIn("not merged", failed.stdout)
        self.assertFalse((self.folder / "a.hmap").exists())
        self.write_list(["room0", "room1", "room2", "room4"])
        self.assertEqual(self.notes("a.hmap"), ["kept"] * 4)

    def test_what_a_sequence_says_of_itself(self):
        found = self.folder / "found.jsonl"
        found.write_text('{"image": "depth/0.png", "detections": [{"label": "wall", "score": 1, "bbox": [1, 1, 30, 20]}]}\n')
        self.write_list(["room0", {"input": "room1", "name": "hall", "detections": [{"file": "found.jsonl", "detector": "eye"}],
                                   "up": "z", "transform": [6.4, 0, 0, 0]}])
        self.many("building")
        info = json.loads(run("info", self.folder / "building/map.hmap", "--json").stdout)
        self.assertIn("hall", json.dumps(info))
        self.assertIn("wall", json.dumps(info["classes"]))
        free = ("--layer", "octree", "--at")
        at = [json.loads(run("query", self.folder / "building/map.hmap", *free, place, "--json").stdout)["results"]
              for place in ("0.05,0.05,1.35", "6.45,0.05,1.35", "3.25,0.05,1.35")]
        self.assertEqual([len(results) for results in at], [1, 1, 0])

    def test_wrong_lists_are_refused_with_file_and_line(self):
        for text, words in (("sequences: []\n", "list.yaml:1: sequences: must have 1 sequence or more"),
                            ("sequences:\n- input: a\n  nmae: b\n", 'did you mean "name"?'),
                            ("sequences: [a, b/a]\n", "must have another name"),
                            ("sequences:\n- input: a\n  transform: [1, 0, 0, 0]\n", "list.yaml:3: sequences[0].transform"),
                            ("- a\n", "list.yaml"), ("", "list.yaml"), ("sequences: [\0]", "list.yaml")):
            with self.subTest(text):
                self.list.write_text(text)
                self.assertIn(words, self.many("a.hmap", status=2).stderr)
        self.list.unlink()
        self.assertIn("list.yaml", self.many("a.hmap", status=3).stderr)
        self.assertEqual([path.name for path in self.folder.glob("a.hmap*")], [])

    def test_the_same_frames_twice_are_refused(self):
        self.write_list(["room0", {"input": "room0", "name": "again"}])
        self.assertIn("frames would count twice", self.many("a.hmap", status=2).stderr)

    def test_outputs_that_cannot_be(self):
        self.many(self.list.name, status=4)
        self.many("room0", status=4)
        self.assertIn("nowhere", self.many("nowhere/a.hmap", status=3).stderr)
        (self.folder / "a.hmap.parts").write_text("no folder")
        self.assertIn("a.hmap.parts", self.many("a.hmap", status=3).stderr)
        self.assertEqual((self.folder / "a.hmap.parts").read_text(), "no folder")


@unittest.skipUnless(RANK_PROGRAM.exists() and shutil.which("mpirun"), "built without MPI, or mpirun is absent")
class Ranks(ManyCase):
    def ranks(self, output, *launch, options=()):
        """Runs by ranks that are launched so, a list of words each."""
        command = [PROGRAM, "map-many", self.list, "--output", self.folder / output, "--resolution", 0.1, "--ranks", *options]
        words = [*MPIRUN]
        for group in launch:
            words += [*([":"] if group is not launch[0] else []), *group, *map(str, command)]
        return subprocess.run(words, capture_output=True, text=True, timeout=300, check=False)

    def succeed(self, output, num_ranks, options=()):
        done = self.ranks(output, ["-n", str(num_ranks)], options=options)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done

    def test_any_number_of_ranks_gives_the_bytes_of_threads(self):
        self.many("threads.hmap", "--threads", 2)
        for num_ranks in (1, 2, 3):
            done = self.succeed(f"{num_ranks}.hmap", num_ranks, ["--json"])
            self.assertEqual(len(json.loads(done.stdout)["workers"]), num_ranks)
            self.assertEqual(digest(self.folder / f"{num_ranks}.hmap"), digest(self.folder / "threads.hmap"))

    def test_after_the_death_of_a_rank_the_same_command_goes_on(self):
        self.succeed("undisturbed", 2)
        for call in (1, 12, 25):
            with self.subTest(call=call):
                out = self.folder / f"died-{call}"
                out.mkdir()
                killed = ["env", f"LD_PRELOAD={os.environ['HYPERMAP_FAULTS_PRELOAD']}", f"HYPERMAP_FAULTS_IN={out}",
                          f"HYPERMAP_FAULT={call} kill"]
                died = self.ranks(out.name, ["-n", "1"], ["-n", "1", *killed])
                self.assertNotEqual(died.returncode, 0, died.stdout)
                self.assertFalse((out / "map.hmap").exists())
                self.succeed(out.name, 2)
                self.assertEqual(tree_digest(out), tree_digest(self.folder / "undisturbed"))

    def test_a_failure_is_said_once(self):
        (self.folder / "room3/groundtruth.txt").write_text("no numbers\n")
        failed = self.ranks("a.hmap", ["-n", "2"])
        self.assertEqual(failed.returncode, 2, failed.stderr)
        self.assertEqual(failed.stderr.count("(of sequence room3)"), 1)
        self.list.write_text("sequences: []\n")
        refused = self.ranks("a.hmap", ["-n", "3"])
        self.assertEqual(refused.returncode, 2, refused.stderr)
        self.assertEqual(refused.stderr.count("must have 1 sequence or more"), 1)


class WithoutMpi(ManyCase):
    def test_ranks_are_refused_where_their_program_is_not(self):
        alone = self.folder / "bin" / "hypermap"
        alone.parent.mkdir()
        shutil.copy(PROGRAM, alone)
        result = subprocess.run([alone, "map-many", self.list, "--output", self.folder / "a.hmap", "--ranks"],
                                capture_output=True, text=True, check=False)
        self.assertEqual(result.returncode, 3, result.stderr)
        self.assertIn("hypermap-ranks: --ranks: cannot be run", result.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=1)
