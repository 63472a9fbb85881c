#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The shell: a golden transcript, scripts, a terminal.

Usage: shell_test.py PROGRAM [unittest args]; HYPERMAP_WRITE_GOLDEN=1 writes the transcript anew."""

import os
import pathlib
import re
import shutil
import signal
import subprocess
import tempfile
import unittest

from laboratory import SmallLaboratoryCase
from program import PROGRAM, SOURCE, digest, run

FILES = SOURCE / "tests/apps/shell"


def scripted(lines, *arguments, cwd=None, env=None):
    """A session whose lines come through a pipe."""
    text = lines if isinstance(lines, bytes) else lines.encode()
    return subprocess.run([str(PROGRAM), "shell", *map(str, arguments)], input=text, capture_output=True, timeout=120,
                          cwd=cwd, env=env, check=False)


class ShellScripts(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="hypermap-shell-"))
        for file in FILES.iterdir():
            shutil.copy(file, cls.folder)

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def said(self, lines, *arguments, status=0):
        result = scripted(lines, *arguments, cwd=self.folder)
        self.assertEqual(result.returncode, status, result.stdout + result.stderr)
        return result.stdout.decode(), result.stderr.decode()

    def test_the_transcript_is_as_it_was(self):
        """Each line goes in once the line before is answered, behind which a line says so that no one can type."""
        lines = (FILES / "session.txt").read_text().splitlines(keepends=True)
        told = []
        with subprocess.Popen([str(PROGRAM), "shell"], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, cwd=self.folder) as child:
            for line in lines:
                told.append("> " + line)
                if line == "exit\n":
                    child.stdin.close()
                    break
                child.stdin.write((line + "\x01\n").encode())
                child.stdin.flush()
                for answer in iter(child.stdout.readline, b""):
                    if b"control character in column 1" in answer:
                        break
                    told.append(re.sub(r"standard input:\d+", "standard input:N", answer.decode()))
        self.assertEqual(child.returncode, 3)
        transcript = "".join(told)
        golden = FILES / "session.golden"
        if os.environ.get("HYPERMAP_WRITE_GOLDEN"):
            golden.write_text(transcript)
        self.maxDiff = None
        self.assertEqual(transcript, golden.read_text())

    def test_a_script_ends_at_its_end_without_prompt_or_echo(self):
        self.assertEqual(self.said("getLayerCount\ngetInt plan -0.75,0.75", "house.yaml"),
                         ("2\n100\n", "note: the map of house.yaml was saved to no archive\n"))
        self.assertEqual(self.said(""), ("", ""))
        self.assertEqual(self.said("getLayerCount\nexit\ngetLayerCount\n"), ("0\n", ""))
        self.assertEqual(self.said("\r\n# nothing\r\ngetLayerCount\r\n"), ("0\n", ""))

    def test_errors_name_their_line_and_the_next_line_is_done(self):
        out, err = self.said("getLayerCount\nload none.hmap\n\ngetString plan\ngetLayerCount\n", "house.yaml", status=3)
        self.assertEqual(out, "2\n2\n")
        self.assertRegex(err, r"hypermap: standard input:2: load: none\.hmap: .*No such file")
        self.assertRegex(err, r'hypermap: standard input:4: getString: is typed as "getString LAYER LOCATION", has 1 word')
        out, _ = self.said("getLayerCount\nnonsense\ngetLayerCount\n", "--stop-at-errors", status=2)
        self.assertEqual(out, "0\n")

    def test_a_failed_load_or_save_changes_nothing(self):
        (self.folder / "cut.hmap").write_bytes(b"PK\x03\x04 and no more")
        kept = digest(self.folder / "cut.hmap")
        out, err = self.said("load cut.hmap\nloadConfig plan.pgm\ngetString plan -0.75,0.75\nsave no/folder/here.hmap\n"
                             "getLayerCount\n", "house.yaml", status=3)
        self.assertEqual(out, "Occupied\n2\n")
        self.assertIn("no/folder", err)
        self.assertEqual(digest(self.folder / "cut.hmap"), kept)
        self.assertEqual(scripted("getLayerCount", "cut.hmap", cwd=self.folder).returncode, 2)

    def test_what_bears_another_name_than_an_archive_is_not_saved_over(self):
        before = digest(self.folder / "house.yaml")
        _, err = self.said("save house.yaml\n", "house.yaml", status=2)
        self.assertIn("must end in .hmap, is 'house.yaml'", err)
        self.assertEqual(digest(self.folder / "house.yaml"), before)

    def test_load_and_save_lose_nothing(self):
        self.said("save once.hmap\nload once.hmap\nsave twice.hmap\n", "house.yaml")
        self.assertEqual(digest(self.folder / "once.hmap"), digest(self.folder / "twice.hmap"))
        # Without a file it goes to where it came from.
        self.said("save\n", "twice.hmap")
        self.assertEqual(digest(self.folder / "once.hmap"), digest(self.folder / "twice.hmap"))

    def test_names_with_blanks_and_quotes(self):
        name = self.folder / "a map's \"name\".hmap"
        self.said("save \"a map's \\\"name\\\".hmap\"", "house.yaml")
        self.assertTrue(name.is_file())
        self.assertEqual(self.said("load 'a map'\\''s \"name\".hmap'\ngetLayerCount")[0], "2\n")

    def test_lines_that_no_one_types(self):
        cases = ((b"get\x00LayerCount\n", "standard input:1: has a control character in column 4"),
                 (b"x" * (5 << 20) + b"\n", "standard input:1: is longer than 4194304 bytes"),
                 (b"getString '\n", "standard input:1: the quote ' is not closed"),
                 (b"\xff\xfe\n", "standard input:1: no command is named '"),
                 (b"getString plan " + b"(" * 100000 + b"\n", "standard input:1: getString: location: must be X,Y"))
        for line, told in cases:
            with self.subTest(line=line[:20]):
                out, err = self.said(line + b"getLayerCount\n", "house.yaml", status=2)
                self.assertEqual(out, "2\n")
                self.assertIn(told, err)
                self.assertLess(len(err), 1000)

    def test_a_full_disk_is_no_success(self):
        with open("/dev/full", "wb") as full:
            result = subprocess.run([str(PROGRAM), "shell", str(FILES / "house.yaml")], input=b"getLayerCount\n" * 3,
                                    stdout=full, stderr=subprocess.PIPE, timeout=60, check=False)
        self.assertEqual(result.returncode, 3)
        self.assertIn(b"standard output", result.stderr)

    def test_a_signal_ends_a_script_that_waits(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            with subprocess.Popen([str(PROGRAM), "shell"], stdin=subprocess.PIPE, stdout=subprocess.PIPE) as child:
                child.stdin.write(b"getLayerCount\n")
                child.stdin.flush()
                self.assertEqual(child.stdout.readline(), b"0\n")
                child.send_signal(number)
                self.assertEqual(child.wait(timeout=30), 128 + number)

    def test_nothing_is_kept_of_a_script(self):
        state = self.folder / "state"
        scripted("getLayerCount\n", env={**os.environ, "XDG_STATE_HOME": str(state)})
        self.assertFalse(state.exists())


class ShellObjects(SmallLaboratoryCase):
    """Maps that were mapped: parts are read once something asks for them."""

    def said(self, lines, status=0):
        result = scripted(lines, self.map)
        self.assertEqual(result.returncode, status, result.stderr)
        return result.stdout.decode()

    def test_objects_are_told_as_query_tells_them(self):
        self.assertEqual(self.said("objects"), run("query", self.map, "--layer", "objects").stdout)
        found = run("query", self.map, "--layer", "objects", "--string", "chair")
        self.assertEqual(self.said("objects chair"), found.stdout)
        nearest = run("query", self.map, "--nearest", "chair", "--at", "0,0")
        self.assertEqual(self.said("nearest chair 0,0"), nearest.stdout)
        first = re.search(r"chair +(\d+)", found.stdout).group(1)
        self.assertEqual(self.said(f"why {first}"), run("query", self.map, "--why", first).stdout)
        self.assertEqual(self.said("whyNot 0,0"), run("query", self.map, "--why-not", "0,0").stdout)

    def test_every_layer_answers_as_query_does(self):
        for layer in ("occupancy", "semantic", "octree", "evidence", "objects", "chair", "topological_map"):
            with self.subTest(layer=layer):
                self.assertEqual(len(self.said(f"getString {layer} 0,0").split()) > 0 or layer in ("semantic", "objects",
                                                                                                  "topological_map"), True)
                asked = run("query", self.map, "--layer", layer, "--area", "-1 -1,1 -1,1 1,-1 1", "--json")
                names = re.findall(r'"name": "([^"]*)",\n      "value"', asked.stdout)
                told = self.said(f"getStrings {layer} -1 -1,1 -1,1 1,-1 1")
                self.assertEqual(told.splitlines(), list(dict.fromkeys(names)))

    def test_layers_are_known_before_they_are_read(self):
        listed = self.said("layers\ngetLayerCount\nobjects chair\nwhyNot 0,0\nrepublish\nlayers\ngetLayerCount")
        before, after = listed.split("layer ", 1)[1].split("layer ")[0], listed.rsplit("layer ", 1)[1]
        names = [line.split()[0] for line in before.splitlines()[1:] if len(line.split()) == 3]
        self.assertEqual(names, [line.split()[0] for line in after.splitlines()[1:] if len(line.split()) == 3])
        self.assertIn("octree", names)
        self.assertEqual(str(len(names)), listed.splitlines()[-1])

    def test_a_flat_layer_needs_no_octree(self):
        """A map whose octree is damaged answers what does not need it, and says what is wrong with the rest."""
        damaged = self.folder / "damaged.hmap"
        content = bytearray(self.map.read_bytes())
        at = content.index(b"octree.ot") + 2000
        content[at] ^= 0xFF
        damaged.write_bytes(content)
        result = scripted("getLayerCount\ngetStrings occupancy -1 -1,1 -1,1 1,-1 1\ngetString octree 0,0\n"
                          "getStrings occupancy -1 -1,1 -1,1 1,-1 1\n", damaged)
        self.assertEqual(result.returncode, 2)
        self.assertIn(b"standard input:3: getString: ", result.stderr)
        self.assertIn(b"octree.ot", result.stderr)
        self.assertEqual(len(re.findall(b"^Free$", result.stdout, re.MULTILINE)), 2)

    def test_a_file_that_changed_is_not_mixed_with_the_one_before(self):
        other = self.folder / "other.hmap"
        shutil.copy(self.map, other)
        with subprocess.Popen([str(PROGRAM), "shell", str(other)], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE) as child:
            child.stdin.write(b"getLayerCount\n")
            child.stdin.flush()
            child.stdout.readline()
            os.truncate(other, 1000)
            _, err = child.communicate(b"objects\ngetString occupancy 0,0\n", timeout=60)
        self.assertEqual(child.returncode, 3)
        self.assertIn(b"has changed since it was loaded", err)

    def test_saving_saves_the_whole(self):
        saved = self.folder / "saved.hmap"
        self.said(f"getString semantic 0,0\nsave {saved}\n")
        self.assertEqual(digest(saved), digest(self.map))


if __name__ == "__main__":
    unittest.main()
