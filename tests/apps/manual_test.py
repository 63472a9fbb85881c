#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The manual and the completion for bash say what `--help` says, and man and bash take them.

Usage: manual_test.py PROGRAM [unittest args]; beside the program lie its manual and hypermap_manual, which writes it."""

import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

from program import PROGRAM, SOURCE, run, tree_digest
from usage_test import COMMANDS

MANUAL = PROGRAM.parent / "manual"
COMPLETION = MANUAL / "bash-completion" / "hypermap"
SECTIONS = ["NAME", "SYNOPSIS", "DESCRIPTION", "OPTIONS", "EXIT STATUS", "EXAMPLES", "SEE ALSO"]
ESCAPES = {r"\-": "-", r"\(aq": "'", r"\(ga": "`", r"\(ha": "^", r"\(ti": "~", r"\(dq": '"', r"\&": "", r"\e": "\\"}


def page_of(command):
    name = f"hypermap-{command}.1" if command else "hypermap.1"
    return (MANUAL / "man1" / name).read_text(encoding="utf-8")


def plain(roff):
    """The words of a page: its lines without fonts and escapes."""
    roff = re.sub(r"\\f[BIR]", "", roff)
    return re.sub(r"\\(-|e|&|\(..)", lambda found: ESCAPES[found.group(0)], roff)


def helped_options(command):
    """(names, rest of the line, effect) of each option in `--help`."""
    text = run(*command.split(), "--help").stdout.split("\nExamples:")[0].split("\nSubcommands:")[0]
    found = re.findall(r"^  (-\S+)(.*(?:\n {20,}\S.*)*)$", text, re.MULTILINE)
    return [(names.split(","), " ".join(rest.split())) for names, rest in found]


def entry_of(page, name):
    """What stands in a page of an option."""
    for entry in plain(page).split(".TP\n")[1:]:
        if name in entry.split("\n")[0].replace(",", " ").split():
            return entry
    return None


def completed(*words):
    """What bash offers for the last word."""
    script = 'source "$1"; shift; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _hypermap; printf "%s\\n" "${COMPREPLY[@]}"'
    result = subprocess.run(["bash", "--norc", "-c", script, "bash", str(COMPLETION), *words], capture_output=True,
                            text=True, check=False)
    assert result.returncode == 0 and result.stderr == "", result.stderr
    return result.stdout.split()


class Manual(unittest.TestCase):
    def test_there_is_a_page_for_the_program_and_for_each_command(self):
        self.assertEqual(sorted(os.listdir(MANUAL / "man1")),
                         sorted(["hypermap.1", *(f"hypermap-{command}.1" for command in COMMANDS)]))
        for command in ["", *COMMANDS]:
            sections = re.findall(r"^\.SH (.*)$", page_of(command), re.MULTILINE)
            for section in SECTIONS:
                self.assertIn(section, sections, command)

    def test_every_option_of_the_help_stands_in_its_page_and_in_the_completion(self):
        for command in ["", *COMMANDS]:
            options = helped_options(command)
            self.assertGreater(len(options), 1, command)
            offered = completed("hypermap", *command.split(), "-")
            for names, said in options:
                with self.subTest(command=command, option=names):
                    entry = entry_of(page_of(command), names[-1])
                    self.assertIsNotNone(entry)
                    self.assertTrue(all(name in entry for name in names))
                    effect = " ".join(entry.split("\n")[1].split())
                    self.assertTrue(said.endswith(effect) and effect, (said, effect))
                    self.assertLessEqual(set(names), set(offered))

    def test_an_entry_tells_value_range_default_and_what_it_goes_with(self):
        for command, name, told in (
                ("map", "--preset", "--preset CHOICE\n"), ("map", "--preset", "One of default, smap, hypermap."),
                ("map", "--preset", "Default: default."), ("map", "--resolution", "Range: 0.001 .. 10 m. Default: 0.05."),
                ("map", "--max-skipped", "Range: 0 .. 1. Default: 0.05."), ("map", "--threads", "Range: 0 .. 256."),
                ("map", "--transform", "Needs --append. Excludes --same-world."), ("map", "--input", "\nRequired.\n"),
                ("map", "--detections", "May be repeated, or"), ("export", "--format", "One of ros-map, class-grids,")):
            self.assertIn(told, entry_of(page_of(command), name))

    def test_the_exit_statuses_are_those_of_the_documentation(self):
        rows = re.findall(r"^\| ([\d, ]+) \| (.*) \|$", (SOURCE / "docs/CLI.md").read_text(encoding="utf-8"), re.MULTILINE)
        self.assertEqual([numbers for numbers, _ in rows], ["0", "1", "2", "3", "4", "5", "130, 143"])
        for command in ["", *COMMANDS]:
            for numbers, meaning in rows:
                self.assertIn(f".TP\n{numbers}\n{meaning.replace('`', '')}\n", plain(page_of(command)))

    def test_the_examples_are_those_of_the_help(self):
        for command in COMMANDS:
            examples = run(command, "--help").stdout.split("\nExamples:\n")[1].splitlines()
            for example in examples:
                self.assertIn(f".nf\n{example.strip()}\n.fi\n", plain(page_of(command)))

    def test_man_has_nothing_to_say_of_the_pages(self):
        groff = shutil.which("groff")
        if groff is None:
            self.skipTest("no groff here (package groff-base)")
        for command in ["", *COMMANDS]:
            result = subprocess.run([groff, "-man", "-ww", "-z", "-Tascii"], input=page_of(command), capture_output=True,
                                    text=True, check=False)
            self.assertEqual((result.returncode, result.stdout, result.stderr), (0, "", ""), command)
        shown = subprocess.run([groff, "-man", "-Tascii", "-P-cbou"], input=page_of("query"), capture_output=True, text=True,
                               check=True).stdout
        self.assertIn('hypermap query lab.hmap --layer occupancy --area "0 0,1 0,1 1" --string Free', shown)

    def test_the_same_definition_gives_the_same_bytes(self):
        with tempfile.TemporaryDirectory() as folder:
            written = pathlib.Path(folder) / "manual"
            subprocess.run([PROGRAM.parent / "hypermap_manual", written], check=True)
            self.assertEqual(tree_digest(written), tree_digest(MANUAL))
        self.assertEqual(subprocess.run([PROGRAM.parent / "hypermap_manual"], capture_output=True, check=False).returncode, 4)
        version = run("--version").stdout.strip()
        self.assertIn(f'.TH HYPERMAP\\-MAP 1 "" "{version}" "hypermap"', page_of("map"))


class Completion(unittest.TestCase):
    def test_commands_and_options(self):
        self.assertEqual(completed("hypermap", ""), COMMANDS)
        self.assertEqual(completed("hypermap", "s"), [name for name in COMMANDS if name.startswith("s")])
        self.assertEqual(completed("hypermap", "map", "--pre"), ["--preset"])
        self.assertEqual(completed("hypermap", "map", "--prog"), ["--progress"], "an option of the program")
        self.assertEqual(completed("hypermap", "--progress", "never", "con"), ["config"])
        self.assertIn("--output", completed("hypermap", "map", ""))
        self.assertNotIn("--preset", completed("hypermap", "query", "--"))

    def test_choices(self):
        presets = ["default", "smap", "hypermap"]
        self.assertEqual(completed("hypermap", "map", "--preset", ""), presets)
        self.assertEqual(completed("hypermap", "map", "--preset", "=", "s"), ["smap"])
        self.assertEqual(completed("hypermap", "map", "--preset", "="), presets)
        self.assertEqual(completed("hypermap", "map", "--up", "-"), ["-x", "-y", "-z"])
        self.assertEqual(completed("hypermap", "export", "lab.hmap", "--format", "o"), ["octomap"])
        self.assertEqual(completed("hypermap", "--progress", "a"), ["auto", "always"])

    def test_files_otherwise(self):
        with tempfile.TemporaryDirectory() as folder:
            for name in ("lab.hmap", "lab.yaml"):
                (pathlib.Path(folder) / name).touch()
            for words in (["info"], ["map", "--config"], ["export", "x.hmap", "--output"], ["check", "one.hmap"]):
                self.assertEqual(sorted(completed("hypermap", *words, folder + "/l")),
                                 [folder + "/lab.hmap", folder + "/lab.yaml"], words)
        self.assertIn("-F _hypermap hypermap", subprocess.run(
            ["bash", "--norc", "-c", f'source "{COMPLETION}"; complete -p hypermap'], capture_output=True, text=True,
            check=True).stdout)


if __name__ == "__main__":
    unittest.main(verbosity=1)
