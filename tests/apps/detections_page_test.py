#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What docs/DETECTIONS.md shows is read, and refused, as it says. Usage: detections_page_test.py PROGRAM [unittest args]"""

import pathlib
import re
import shutil
import tempfile
import unittest

from program import SOURCE, run
from tiny_dataset import color_png, make_dataset

PAGE = (SOURCE / "docs/DETECTIONS.md").read_text(encoding="utf-8")
SIZE = (640, 480)
# <!-- file: NAME --> or <!-- example: NAME [ARGUMENT...] --> before a block; behind an example what tune says of it.
BLOCK = re.compile(r"^<!-- (file|example): (\S+)((?: \S+)*) -->\n```\w+\n(.*?)^```\n(?:```text\n(.*?)^```\n)?", re.M | re.S)
REFUSAL = re.compile(r"^\| (file |text |)`(.*?)`(?: \(.*\))? \| `(.*)` \|$", re.M)


class DetectionsPage(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="hypermap-page-"))
        self.addCleanup(shutil.rmtree, self.folder)

    def dataset(self):
        """Two images, rgb/000001.png of stamp 1.0 and rgb/000002.png of 1.1."""
        folder = make_dataset(self.folder / "dataset", size=SIZE)
        (folder / "rgb").mkdir()
        for name in ("000001", "000002"):
            (folder / f"rgb/{name}.png").write_bytes(color_png(*SIZE, 128))
        (folder / "rgb.txt").write_text("1.0 rgb/000001.png\n1.1 rgb/000002.png\n")
        return folder

    def test_every_example_is_read_as_it_says(self):
        dataset = self.dataset()
        blocks = BLOCK.findall(PAGE)
        self.assertEqual(len(blocks), len(re.findall(r"^<!-- ", PAGE, re.M)), "a block that is not found")
        for _, name, _, text, _ in blocks:
            (self.folder / name).parent.mkdir(exist_ok=True)
            (self.folder / name).write_text(text, encoding="utf-8")
        examples = [block for block in blocks if block[0] == "example"]
        self.assertGreaterEqual(len(examples), 9)
        for _, name, arguments, _, said in examples:
            with self.subTest(name):
                arguments = [self.folder / word if (self.folder / word).is_file() else word for word in arguments.split()]
                told = run("tune", "--input", dataset, "--frame", "0", "--detections", self.folder / name, *arguments)
                self.assertEqual(told.returncode, 0, told.stderr)
                self.assertEqual(re.findall(r"^detection .*$", told.stdout, re.M), said.splitlines())
                if not arguments:
                    checked = run("check", "--as", "detections", self.folder / name)
                    self.assertEqual(checked.returncode, 0, checked.stdout)
                    self.assertIn(f" {len(said.splitlines())} detection", checked.stdout)

    def test_a_folder_of_text_is_read(self):
        (self.folder / "yolo").mkdir()
        (self.folder / "yolo/000001.txt").write_text("56 0.3125 0.5 0.3125 0.5 0.9\n")
        told = run("tune", "--input", self.dataset(), "--frame", "0", "--detections", self.folder / "yolo")
        self.assertIn("detection 0: chair, score 0.90, box 100 120 300 360\n", told.stdout)

    def test_every_refusal_is_one(self):
        table = PAGE.split("| refused | message |\n")[1]
        refusals = REFUSAL.findall(table)
        self.assertEqual(len(refusals), len(table.splitlines()) - 1, "a row that is not found")
        for kind, text, message in refusals:
            with self.subTest(text):
                path = self.folder / ("a.txt" if kind == "text " else "a.json")
                frame = f'{{"image": "a.png", "width": {SIZE[0]}, "height": {SIZE[1]}, "detections": [{text}]}}'
                path.write_text((text if kind else frame) + "\n", encoding="utf-8")
                checked = run("check", "--as", "detections", path)
                self.assertEqual(checked.returncode, 2, checked.stdout)
                self.assertIn(message, checked.stdout)

    def test_the_limits_are_those(self):
        one = '{"label": "%s", "score": 0.5, "bbox": [1, 2, 3, 4]}'
        path = self.folder / "a.json"
        for detections, status, told in (([one % "chair"] * 1000, 0, "1000 detections"),
                                         ([one % "chair"] * 1001, 2, "at most 1000 detections of a frame are read, has 1001"),
                                         ([one % ("c" * 256)], 0, "1 detection"),
                                         ([one % ("c" * 257)], 2, "at most 256 bytes are read, has 257")):
            path.write_text(f'{{"image": "a.png", "detections": [{", ".join(detections)}]}}')
            checked = run("check", "--as", "detections", path)
            self.assertEqual(checked.returncode, status)
            self.assertIn(told, checked.stdout)

    def test_the_keys_are_those_that_are_known(self):
        keys = set(re.findall(r"`(\w+)`", "".join(re.findall(r"^\| (`.*?) \|", PAGE.split("## Frame JSON")[1].split("##")[0],
                                                             re.M))))
        values = {"image": '"a.png"', "timestamp": "1.5", "width": "640", "height": "480", "detections": "[]",
                  "label": '"chair"', "score": "0.5", "bbox": "[1, 2, 3, 4]", "scores": '{"chair": 1}', "mask": "null",
                  "embedding": '{"model": "clip", "vector": [1]}'}
        frame_keys = {"image", "timestamp", "width", "height", "detections", "index", "detector"}
        source = (SOURCE / "io/dataset/src/detections/detections_json.cpp").read_text(encoding="utf-8")
        known = "".join(re.findall(r"k(?:Frame|Detection)Keys\{(.*?)\}", source, re.S))
        self.assertEqual(keys, set(re.findall(r'"(\w+)"', known)))
        head = ", ".join(f'"{key}": {values.get(key, "0")}' for key in sorted(frame_keys - {"detections"}))
        path = self.folder / "a.json"
        for key in sorted(keys - frame_keys):
            members = {name: values[name] for name in ("label", "score", "bbox")}
            if key == "bbox_xywh":
                members = {"label": values["label"], "score": values["score"], key: "[1, 2, 2, 2]"}
            members.setdefault(key, values.get(key, '"chair"'))
            one = ", ".join(f'"{name}": {value}' for name, value in members.items())
            path.write_text(f'{{{head}, "detections": [{{{one}}}]}}')
            checked = run("check", "--as", "detections", path)
            self.assertEqual((checked.returncode, checked.stdout.count("unknown key")), (0, 0), checked.stdout)
        path.write_text('{"image": "a.png", "seen": 1, "detections": []}')
        unknown = run("check", "--as", "detections", path)
        self.assertEqual(unknown.returncode, 1)
        self.assertIn("$.seen: unknown key, ignored", unknown.stdout)


if __name__ == "__main__":
    unittest.main(verbosity=1)
