#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What a damaged archive still holds.

Usage: repair_test.py PROGRAM [unittest args]"""

import json
import shutil
import unittest
import zipfile

from laboratory import SmallLaboratoryCase
from program import DATA, digest, repetitions, run, run_measured

HOSTILE = DATA / "hostile/zip"


class Repair(SmallLaboratoryCase):
    def setUp(self):
        super().setUp()
        self.damaged = self.folder / "damaged.hmap"
        self.output = self.folder / "repaired.hmap"
        self.output.unlink(missing_ok=True)

    def without(self, *names, **replaced):
        """The map without some members, and with other bytes of others (key: a name without its dot)."""
        with zipfile.ZipFile(self.map) as old, zipfile.ZipFile(self.damaged, "w", zipfile.ZIP_DEFLATED) as new:
            for name in old.namelist():
                if name not in names:
                    new.writestr(name, replaced.get(name.replace(".", "_"), old.read(name)))

    def repaired(self, status=1):
        before = digest(self.damaged)
        result = run("repair", self.damaged, "--output", self.output)
        self.assertEqual(result.returncode, status, result.stdout + result.stderr)
        self.assertEqual(digest(self.damaged), before)
        self.assertEqual(self.output.exists(), status in (0, 1))
        if status in (0, 1):
            self.assertEqual(run("check", self.output).returncode, 0)
        return result

    def layers(self, archive):
        return {layer["name"]: layer for layer in json.loads(run("info", archive, "--json").stdout)["layers"]}

    def test_a_sound_map_stays_what_it_is(self):
        shutil.copy(self.map, self.damaged)
        told = self.repaired(status=0).stdout
        self.assertEqual(digest(self.output), digest(self.map))
        self.assertRegex(told, r"layer occupancy +kept")

    def test_a_map_whose_directory_is_cut_comes_back_whole(self):
        content = self.map.read_bytes()
        self.damaged.write_bytes(content[:content.index(b"PK\x01\x02") + 100])
        self.assertEqual(run("info", self.damaged).returncode, 2)
        told = self.repaired().stdout
        self.assertEqual(digest(self.output), digest(self.map))
        self.assertRegex(told, r"directory +rebuilt")

    def test_what_is_derived_is_made_anew(self):
        self.without("occupancy.png", "semantic", "class_grid_0.yaml")
        told = self.repaired().stdout
        self.assertEqual(digest(self.output), digest(self.map), told)
        for part in ("layer occupancy", "layer semantic", "class grid "):
            self.assertRegex(told, rf"{part}.* rebuilt +from octree and objects")

    def test_a_lost_configuration_is_made_anew(self):
        self.without("hmap_config.yaml")
        self.repaired()
        expected = self.layers(self.map)
        for name in ("occupancy", "semantic"):
            self.assertTrue(expected[name]["subscribe_mode"])
            expected[name]["subscribe_mode"] = False  # flags are lost with the configuration (docs/DAMAGE.md)
        self.assertEqual(self.layers(self.output), expected)

    def test_what_depends_on_nothing_else_is_lost_alone(self):
        self.without("objects.jsonl", "octree.bt")
        told = self.repaired().stdout
        self.assertRegex(told, r"extension objects +lost")
        before = self.layers(self.map)
        before.pop("objects")
        after = self.layers(self.output)
        self.assertEqual(list(after), list(before))
        self.assertEqual(after["occupancy"], before["occupancy"])

    def test_the_twin_stands_for_a_lost_octree(self):
        self.without("octree.ot")
        told = self.repaired().stdout
        self.assertRegex(told, r"extension octree +lost")
        self.assertRegex(told, r"extension octree_twin +repaired +stands for the octree")
        before, after = self.layers(self.map), self.layers(self.output)
        self.assertEqual(set(after), set(before))
        for end in ("min", "max"):
            for is_now, was in zip(after["octree"]["bounds"][end], before["octree"]["bounds"][end]):
                self.assertAlmostEqual(is_now, was)

    def test_a_damaged_member_is_named(self):
        content = bytearray(self.map.read_bytes())
        content[content.index(b"octree.ot") + 3000] ^= 0xFF
        self.damaged.write_bytes(content)
        told = self.repaired().stdout
        self.assertRegex(told, r"member octree.ot +lost +\S")
        self.assertRegex(told, r"layer occupancy +kept")

    def test_a_map_that_is_cut_anywhere_is_repaired_or_refused(self):
        content = self.map.read_bytes()
        for part in range(1, repetitions(24)):
            with self.subTest(part=part):
                self.output.unlink(missing_ok=True)
                self.damaged.write_bytes(content[:len(content) * part // repetitions(24)])
                self.repaired()

    def test_what_is_no_archive_is_refused(self):
        for name, content in (("text", b"no archive at all"), ("empty", b""), ("magic", b"PK")):
            with self.subTest(name):
                self.damaged.write_bytes(content)
                self.assertIn("damaged.hmap", self.repaired(status=2).stderr)
        self.assertEqual(run("repair", self.folder / "none.hmap", "--output", self.output).returncode, 3)
        self.assertEqual(run("repair", self.map, "--output", self.map).returncode, 4)
        self.assertEqual(run("repair", self.map).returncode, 4)
        self.damaged.write_bytes(b"kept")
        self.assertEqual(run("repair", self.map, "--output", self.folder / "no/such/folder.hmap").returncode, 3)

    @unittest.skipUnless(HOSTILE.is_dir(), "no hostile archives")
    def test_hostile_archives_end_clean_and_within_limits(self):
        beside = set(self.folder.iterdir())
        for archive in sorted(HOSTILE.iterdir()):
            with self.subTest(archive.name):
                result = run_measured("repair", archive, "--output", self.output)
                self.assertIn(result.returncode, (0, 1, 2), result.stderr)
                self.assertLess(result.cpu_s, 20)
                self.assertEqual(self.output.exists(), result.returncode in (0, 1))
                if self.output.exists():
                    # What nothing names is kept, and said.
                    self.assertIn(run("check", self.output).returncode, (0, 1))
                    self.output.unlink()
                self.assertEqual(set(self.folder.iterdir()), beside)


if __name__ == "__main__":
    unittest.main()
