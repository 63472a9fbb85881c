#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""docs/REQUIREMENTS.md has a row for each of F1 to F20 and for each type of layer, and the headers, commands and tests that it
names are there."""

import re
import sys

import source_tree

PAGE = "docs/REQUIREMENTS.md"
REQUIREMENTS = [f"F{number}" for number in range(1, 21)]
NAME = re.compile(r"`([^`]+)`")
LAYER = re.compile(r"class (\w+) final : public MapLayer\b")
CASE = re.compile(r"\b(?:TYPED_)?TEST(?:_[FP])?\(\s*(\w+),\s*(\w+)\s*\)")
METHOD = re.compile(r"^    def (test_\w+)\(", re.MULTILINE)
COMMAND = re.compile(r'add_subcommand\(\s*"([\w-]+)"')
SHELL_COMMAND = re.compile(r'^\s*\{"(\w+)",\s*"', re.MULTILINE)


def rows(text):
    """The cells of each row of a table, but for headings."""
    for line in text.splitlines():
        cells = [cell.strip() for cell in line.strip().strip("|").split("|")]
        if line.startswith("|") and len(cells) >= 3 and not re.fullmatch(r"[-: ]*", cells[0] + cells[1]):
            yield cells


def commands(root):
    sources = [source_tree.read(path) for path in source_tree.files(root, ["apps"], [".cpp"])]
    typed = {f"hypermap {name}" for text in sources for name in COMMAND.findall(text)}
    in_shell = source_tree.read(root / "apps/src/shell/shell_commands.cpp")
    return typed | set(SHELL_COMMAND.findall(in_shell))


def cases(path):
    text = source_tree.read(path)
    return {".".join(case) for case in CASE.findall(text)} | set(METHOD.findall(text))


def wrong_tests(root, cell):
    """A file, and behind it, where it is not the whole file, a case of it."""
    known = None
    names = NAME.findall(cell)
    if not names:
        yield "names no test"
    for name in names:
        if "/" in name:
            path = root / name
            known = cases(path) if path.is_file() else None
            if known is None:
                yield f"there is no test {name}"
        elif known is not None and name not in known:
            yield f"there is no case {name} in the test before it"


def wrong_headers(root, cell):
    names = NAME.findall(cell)
    return ([] if names else ["names no header"]) + [f"there is no header {name}" for name in names
                                                     if not (root / name).is_file()]


def wrong_commands(known, cell):
    names = NAME.findall(cell)
    return ([] if names else ["names no command"]) + [f"there is no command {name}" for name in names if name not in known]


def check(root):
    text = source_tree.read(root / PAGE)
    listed = list(rows(text))
    required = [cells for cells in listed if re.fullmatch(r"F\d+", cells[0])]
    problems = []
    if [cells[0] for cells in required] != REQUIREMENTS:
        problems.append(f"rows are {[cells[0] for cells in required]}, expected F1 to F20 in their order")
    known = commands(root)
    for cells in required:
        if len(cells) != 5:
            problems.append(f"{cells[0]}: has {len(cells)} cells, expected 5")
            continue
        wrong = [*wrong_headers(root, cells[2]), *wrong_commands(known, cells[3]), *wrong_tests(root, cells[4])]
        problems += [f"{cells[0]}: {what}" for what in wrong]
    drawn = {NAME.findall(cells[0])[0]: cells for cells in listed if NAME.fullmatch(cells[0])}
    for name, cells in drawn.items():
        problems += [f"{name}: {what}" for what in (*wrong_headers(root, cells[1]), *wrong_tests(root, cells[2]))]
    types = {name for header in source_tree.public_headers(root) for name in LAYER.findall(source_tree.read(header))}
    problems += [f"no row for the type of layer {name}" for name in sorted(types - set(drawn))]
    problems += [f"{name} is no type of layer" for name in sorted(set(drawn) - types)]
    return [f"{PAGE}: {problem}" for problem in problems]


ROW = "| {} | does | `core/include/a.hpp` | `hypermap map`, `save` | `tests/a_test.cpp` `A.B`, `tests/a_test.py` `test_c` |\n"
DRAWN = "| `Flat` | `core/include/a.hpp` | `tests/a_test.cpp` |\n"
PAGE_TEXT = "| | does | header | command | test |\n|---|---|---|---|---|\n" + "".join(map(ROW.format, REQUIREMENTS)) + \
            "\n| type | header | test |\n|---|---|---|\n" + DRAWN
GOOD = {
    PAGE: PAGE_TEXT,
    "core/include/a.hpp": "class Flat final : public MapLayer {};\n",
    "apps/src/commands/map_command.cpp": 'program.add_subcommand(\n      "map", "Maps");\n',
    "apps/src/shell/shell_commands.cpp": '    {"save",\n     "[FILE]"},\n',
    "tests/a_test.cpp": "TEST_F(A, B) {}\n",
    "tests/a_test.py": "class A:\n    def test_c(self):\n        pass\n",
}
BAD = [
    ("a requirement without a row", {PAGE: PAGE_TEXT.replace("| F7 |", "| F7b |")}),
    ("a header that went", {PAGE: PAGE_TEXT.replace("core/include/a.hpp", "core/include/b.hpp", 1)}),
    ("a command that went", {PAGE: PAGE_TEXT.replace("hypermap map", "hypermap mop", 1)}),
    ("a command of the shell that went", {PAGE: PAGE_TEXT.replace("`save`", "`keep`", 1)}),
    ("a test that went", {PAGE: PAGE_TEXT.replace("tests/a_test.cpp", "tests/b_test.cpp", 1)}),
    ("a case that went", {PAGE: PAGE_TEXT.replace("`A.B`", "`A.C`", 1)}),
    ("a method that went", {PAGE: PAGE_TEXT.replace("`test_c`", "`test_d`", 1)}),
    ("no test at all", {PAGE: PAGE_TEXT.replace("`tests/a_test.cpp` `A.B`, `tests/a_test.py` `test_c`", "by hand", 1)}),
    ("a type of layer without a row", {PAGE: PAGE_TEXT.replace(DRAWN, "")}),
    ("a row without a type of layer", {PAGE: PAGE_TEXT + DRAWN.replace("Flat", "Round")}),
]

if __name__ == "__main__":
    sys.exit(source_tree.main(__doc__, check, GOOD, BAD))
