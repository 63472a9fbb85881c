#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Every equation that a header cites has a test that cites it; prints which file has which."""

import collections
import re
import sys

import source_tree

# "[smap] Eq. (3.14) to (3.16)", "[sogm] Eq. (7), Eq. (8)": a key, then equations until the next key.
CITATION = re.compile(r"\[(\w+)\]((?:(?!\[\w+\]).)*?Eqs?\.\s*(?:(?!\[\w+\]).)*)", re.DOTALL)
LIST = re.compile(
    r"Eqs?\.\s*(\(\d+(?:\.\d+)?\)(?:(?:,\s*and\s*|,\s*|\s+and\s+|\s+to\s+)(?:Eqs?\.\s*)?"
    r"\(\d+(?:\.\d+)?\))*)")
MEMBER = re.compile(r"(to\s+(?:Eqs?\.\s*)?)?\((\d+)(?:\.(\d+))?\)")
KEYS = ("smap", "hypermap", "sogm")


def comments(text):
    """The comments of a file, markers removed and lines joined; each block by itself."""
    blocks, current = [], []
    for line in text.splitlines() + [""]:
        match = re.search(r"//[/!]?<?\s?(.*)$", line)
        if match:
            current.append(match.group(1).strip())
        elif current:
            blocks.append(" ".join(current))
            current = []
    return blocks


def expand(text):
    """The equations of "(3.14) to (3.16)" or "(3.10), (3.11)"."""
    out = []
    for is_range, major, minor in MEMBER.findall(text):
        number = (int(major), int(minor) if minor else None)
        if is_range and out:
            first, last = out[-1], number
            position = 1 if last[1] is not None else 0
            for value in range(first[position] + 1, last[position]):
                out.append((first[0], value) if position == 1 else (value, None))
        out.append(number)
    return [f"{a}" if b is None else f"{a}.{b}" for a, b in out]


def equations(text):
    found = set()
    for block in comments(text):
        for key, rest in CITATION.findall(block):
            if key in KEYS:
                for listed in LIST.findall(rest):
                    found |= {(key, number) for number in expand(listed)}
    return found


def citations(root, paths):
    cited = collections.defaultdict(list)
    for path in paths:
        for equation in sorted(equations(source_tree.read(path))):
            cited[equation].append(path.relative_to(root).as_posix())
    return cited


def both_sides(root):
    headers = citations(root, source_tree.files(root, source_tree.FOLDERS, [".hpp"]))
    tests = citations(root, source_tree.files(root, ["tests"], ["_test.cpp"]))
    return headers, tests


def check(root):
    headers, tests = both_sides(root)
    return [f"{path}: [{key}] Eq. ({number}) is cited by no test"
            for (key, number), paths in sorted(headers.items(), key=order)
            if (key, number) not in tests for path in paths]


def order(item):
    (key, number), _ = item
    return key, [int(part) for part in number.split(".")]


def print_table(root):
    headers, tests = both_sides(root)
    print("| equation | header | test |\n|---|---|---|")
    for (key, number), paths in sorted(headers.items(), key=order):
        print(f"| [{key}] ({number}) | {', '.join(paths)} | "
              f"{', '.join(tests.get((key, number), ['-']))} |")


HEADER = "core/include/hypermap/core/a.hpp"
GOOD = {
    HEADER: "/// Source: [smap] Eq. (3.14) to\n/// (3.16).\n/// Source: [sogm] Eq. (7), (9).\n",
    "tests/core/a_test.cpp": "// [smap] Eq. (3.14), Eq. (3.15) and (3.16)\n\n// [sogm] Eq. (7) to (9)\n",
}
BAD = [
    ("not tested at all", {HEADER: "/// Source: [smap] Eq. (3.19).\n"}),
    ("middle of a range not tested", {HEADER: "/// [smap] Eq. (3.14) to (3.17)\n"}),
    ("same number of another source", {HEADER: "/// Source: [sogm] Eq. (3.14)\n"}),
]

if __name__ == "__main__":
    sys.exit(source_tree.main(__doc__, check, GOOD, BAD, after=print_table))
