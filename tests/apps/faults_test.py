#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Every command that writes, with a fault of the system or a kill at its calls.

Environment HYPERMAP_FAULTS_PRELOAD names the library that makes the faults; with HYPERMAP_ALL_FAULTS set all are
made, else those of the save path and a sample of the others.
Usage: faults_test.py PROGRAM [unittest args]"""

import json
import os
import re
import shutil
import subprocess
import unittest

from faults import KILL, FaultCase, OLD, with_fault
from faults_inputs import Inputs
from program import IS_SANITIZED, SOURCE, digest, run

SAMPLE = 2 if IS_SANITIZED else 8
UNSHARED = ["unshare", "--pid", "--fork", "--mount-proc", "sh", "-c", '"$@"; exit $?', "sh"]


def setUpModule():
    Inputs.make()


def tearDownModule():
    Inputs.remove()


class Mapping(FaultCase):
    def setUp(self):
        super().setUp()
        self.archive = self.out / "a.hmap"
        self.old_map = self.folder / "old.hmap"
        Inputs.succeed("map", "--input", Inputs.tiny, "--output", self.old_map)
        self.command = ["map", "--input", Inputs.tiny, "--output", self.archive, "--resolution", 0.1, "--threads", 1]

    def prepare(self):
        shutil.copy(self.old_map, self.archive)

    def is_allowed(self, name):
        """A map that could not be saved is rescued, whole; a run that was killed leaves its checkpoint."""
        return name in ("a.hmap.rescue", "a.hmap.checkpoint") and run("info", self.out / name).returncode in (0, 1)


class SavePath(Mapping):
    def test_the_map_is_old_or_new_whatever_fails(self):
        self.check_faults(self.prepare, self.command, count=12 if IS_SANITIZED else 0)

    def test_a_new_map_is_there_whole_or_not_at_all(self):
        self.check_faults(lambda: None, self.command, count=SAMPLE)


class MoreMapping(Mapping):
    def content(self, path):
        """Statistics tell times, which differ."""
        return json.loads(path.read_text())["frames"] if path.suffix == ".json" else super().content(path)

    def test_statistics_and_checkpoints(self):
        more = ["--stats", self.out / "stats.json", "--checkpoint-every", 1]
        self.check_faults(self.prepare, [*self.command, *more], count=2 * SAMPLE)

    def test_a_map_that_is_gone_on_with(self):
        self.is_repeatable = False
        append = ["map", "--input", Inputs.tiny, "--output", self.archive, "--append", "--same-world",
                  "--force", "--threads", 1]
        self.check_faults(self.prepare, append, count=SAMPLE)

    def test_a_dataset_that_cannot_be_read(self):
        shutil.copytree(Inputs.tiny, self.folder / "tiny")
        self.command[2] = self.folder / "tiny"
        self.check_faults(self.prepare, self.command, count=2 * SAMPLE, below=self.folder / "tiny")


class Resumed(Mapping):
    """The checkpoint stays until the map is there."""

    def setUp(self):
        super().setUp()
        self.saved = self.folder / "saved.checkpoint"
        self.save_checkpoint([*self.command, "--checkpoint-every", 1])

    def save_checkpoint(self, command):
        """That after the first of two frames: the run is killed at the last call that leaves it."""
        self.fill(lambda: None)
        log = self.folder / "log"
        with_fault(command, self.out, self.working, log=log)
        last = len(log.read_text().splitlines())
        checkpoint = self.out / "a.hmap.checkpoint"
        while not checkpoint.exists():
            self.assertGreater(last, 0)
            self.fill(lambda: None)
            with_fault(command, self.out, self.working, (last, KILL))
            last -= 1
        shutil.copy(checkpoint, self.saved)

    def pieces(self):
        return {name: content for name, content in super().pieces().items() if name != "a.hmap.checkpoint"}

    def prepare(self):
        super().prepare()
        shutil.copy(self.saved, self.out / "a.hmap.checkpoint")

    def check_next(self, command, prefix):
        if (self.out / "a.hmap.checkpoint").exists():
            super().check_next(command, prefix)
        else:
            self.assertEqual(self.pieces(), self.new)

    def test_a_run_that_goes_on(self):
        self.check_faults(self.prepare, [*self.command, "--resume"], count=SAMPLE)


class Namespaces(Mapping):
    def test_the_next_process_of_the_same_number_cleans_up(self):
        allowed = subprocess.run([*UNSHARED, "true"], capture_output=True, text=True, check=False)
        if allowed.returncode != 0:
            self.skipTest(f"no namespaces of process numbers here: {allowed.stderr.strip()}")
        self.check_faults(self.prepare, self.command, count=SAMPLE, prefix=UNSHARED)


class Exports(FaultCase):
    def test_single_files(self):
        for form, name in (("octomap", "a.ot"), ("octomap", "a.bt"), ("color-octomap", "a.ot"), ("ply", "a.ply"),
                           ("geojson", "a.local.geojson"), ("glb", "a.glb"), ("geopackage", "a.gpkg")):
            with self.subTest(form):
                output = self.out / name
                self.check_faults(lambda path=output: path.write_bytes(OLD),
                                  ["export", Inputs.objects(0.05), "--format", form, "--output", output], count=SAMPLE // 2)

    def test_a_map_that_is_told_what_names_mean_or_updated(self):
        archive, batch, grid = self.out / "a.hmap", self.folder / "batch.yaml", self.folder / "grid"
        Inputs.succeed("export", Inputs.objects(0.1), "--format", "ros-map", "--output", grid)
        grid = grid.with_suffix(".yaml")
        grid.write_text(grid.read_text().replace("negate: 0", "negate: 1"))
        batch.write_text('add: [{name: plant, shape: "POLYGON((0 0, 1 0, 1 1, 0 0))"}]\n')
        self.is_repeatable = False
        for change in (["classes", archive, "--set", SOURCE / "data/vocabulary.yaml"], ["update", archive, "--batch", batch],
                       ["update", archive, "--grid", grid]):
            self.check_faults(lambda: shutil.copy(Inputs.objects(0.1), archive), change, count=SAMPLE)

    def test_maps_of_others_and_what_changed(self):
        archive, grid = self.out / "a.hmap", self.folder / "grid"
        Inputs.succeed("export", Inputs.objects(0.1), "--format", "ros-map", "--output", grid)
        for made in (["import", grid.with_suffix(".yaml")], ["diff", Inputs.objects(0.1), Inputs.objects(0.1)],
                     ["repair", Inputs.objects(0.1)], ["merge", Inputs.objects(0.1), Inputs.objects(0.1, 2)]):
            with self.subTest(made[0]):
                self.check_faults(lambda: archive.write_bytes(OLD), [*made, "--output", archive], count=SAMPLE)

    def test_an_archive_that_cannot_be_read(self):
        archive = self.folder / "in" / "a.hmap"
        archive.parent.mkdir()
        shutil.copy(Inputs.objects(0.05), archive)
        output = self.out / "a.ply"
        self.check_faults(lambda: output.write_bytes(OLD), ["export", archive, "--format", "ply", "--output", output],
                          count=SAMPLE, below=archive.parent)


class Pairs(FaultCase):
    """Maps for ROS: a YAML and the image that it names are one piece."""

    REPLACES_ONE = False

    def pieces(self):
        return {path.name: digest(path) + digest(self.out / self.image_of(path)) for path in self.out.glob("*.yaml")}

    @staticmethod
    def image_of(yaml):
        return re.search(r"^image: (.*)$", yaml.read_text(), re.MULTILINE).group(1)

    def exported(self, archive, form, output):
        return ["export", archive, "--format", form, "--output", output]

    def check(self, form, output, count):
        self.check_faults(lambda: Inputs.succeed(*self.exported(Inputs.objects(0.1), form, output)),
                          self.exported(Inputs.objects(0.05), form, output), count)

    def test_a_map(self):
        self.check("ros-map", self.out / "lab", 3 * SAMPLE)

    def test_a_map_for_each_class(self):
        self.check("class-grids", self.out, 2 * SAMPLE)


class Regions(FaultCase):
    """An image and two texts of one map, each a piece of its own."""

    REPLACES_ONE = False

    def test_supercells(self):
        self.check_faults(lambda: Inputs.succeed("cells", Inputs.objects(0.1), "--output", self.out),
                          ["cells", Inputs.objects(0.05), "--output", self.out], 2 * SAMPLE)

    def test_tables_of_rates(self):
        def evaluated(resolution):
            return ["eval", "--map", Inputs.objects(resolution), "--truth", Inputs.objects(0.1), "--csv", self.out]
        self.check_faults(lambda: Inputs.succeed(*evaluated(0.1)), evaluated(0.05), 2 * SAMPLE)


class Folders(FaultCase):
    KEEPS_OLD = True

    def test_a_simulation(self):
        self.check_faults(lambda: shutil.copytree(Inputs.simulation(1, seed=2), self.out / "lab"),
                          ["simulate", "--frames", 1, "--output", self.out / "lab"], count=2 * SAMPLE)

    def test_tiles(self):
        def export(resolution):
            return ["export", Inputs.objects(resolution), "--format", "tiles", "--output", self.out / "tiles"]
        self.check_faults(lambda: Inputs.succeed(*export(0.1)), export(0.05), count=2 * SAMPLE)

    def test_a_bundle_for_nav2(self):
        def export(resolution):
            return ["export", Inputs.objects(resolution), "--format", "nav2", "--output", self.out / "nav2"]
        self.check_faults(lambda: Inputs.succeed(*export(0.1)), export(0.05), count=2 * SAMPLE)

    def test_a_stack(self):
        def stack(resolution):
            return ["stack", Inputs.objects(resolution), "--output", self.out / "grids"]
        self.check_faults(lambda: Inputs.succeed(*stack(0.1)), stack(0.05), count=2 * SAMPLE)

    def test_images_of_steps(self):
        found = self.folder / "found.jsonl"
        found.write_text('{"image": "depth/0.png", "detections": [{"label": "wall", "score": 1, '
                         '"bbox": [1, 1, 30, 20]}]}\n')
        command = ["tune", "--input", Inputs.tiny, "--detections", found, "--frame", 0, "--output", self.out]
        self.check_faults(lambda: None, command, count=2 * SAMPLE)


class Pictures(FaultCase):
    def test_a_snapshot(self):
        archive = Inputs.succeed("map", "--input", Inputs.tiny, "--output", self.folder / "a.hmap")
        snapshot = ["snapshot", archive, "--size", "64x64", "--output"]
        if run(*snapshot, self.folder / "a.png").returncode == 3:
            self.skipTest("no EGL here")
        self.check_faults(lambda: (self.out / "a.png").write_bytes(OLD),
                          [*snapshot, self.out / "a.png"], count=SAMPLE // 2)

    def test_map_and_truth_over_each_other(self):
        self.check_faults(lambda: (self.out / "a.png").write_bytes(OLD),
                          ["eval", "--map", Inputs.objects(0.1), "--truth", Inputs.objects(0.1), "--image", self.out / "a.png"],
                          count=SAMPLE // 2)


class Finalisers(FaultCase):
    """Libraries of drivers end threads and free pools after main(), and may fail at that."""

    def test_the_exit_code_is_that_of_the_work(self):
        env = os.environ | {"LD_PRELOAD": os.environ["HYPERMAP_FAULTS_PRELOAD"], "HYPERMAP_FAULT_AT_EXIT": "1"}
        archive = Inputs.objects(0.1)
        picture = self.folder / "a.png"
        for code, command in ((0, ["--version"]), (0, ["info", archive]), (0, ["snapshot", archive, "--output", picture]),
                              (2, ["info", picture]), (3, ["info", self.folder / "none.hmap"]), (4, ["unknown"])):
            with self.subTest(command):
                ended = run(*command, env=env)
                self.assertEqual(ended.returncode, code, ended.stderr)
                self.assertEqual(ended.stdout, run(*command).stdout)
        self.assertTrue(picture.stat().st_size)


if __name__ == "__main__":
    unittest.main(verbosity=1)
