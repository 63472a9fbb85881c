#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Each equation of tests/tools/equations.txt has a header, a test and a user; prints which file has which."""

import collections
import pathlib
import re
import sys

import source_tree

LIST_FILE = "tests/tools/equations.txt"
KEYS = ("smap", "hypermap", "sogm")
# "[smap] Eq. (3.14) to (3.16)", "[sogm] Eq. (7), Eq. (8)": a key, then its citations until the next key.
KEYED = re.compile(r"\[(\w+)\]((?:(?!\[\w+\]).)*)", re.DOTALL)
NUMBER = r"(?:\d+|[A-Z])(?:\.\d+)?"
JOINED = r"(?:,\s*and\s*|,\s*|\s+and\s+|\s+to\s+)"
EQUATIONS = re.compile(rf"Eqs?\.\s*(\({NUMBER}\)(?:{JOINED}(?:Eqs?\.\s*)?\({NUMBER}\))*)")
DRAWN = re.compile(rf"(pseudocode|figure)s?\s+({NUMBER}(?:{JOINED}{NUMBER}\b)*)")
MEMBER = re.compile(r"(to\s+(?:Eqs?\.\s*)?)?\(?\b(\d+|[A-Z])(?:\.(\d+))?\b\)?")
INCLUDE = re.compile(r'^#include "([^"]+)"', re.MULTILINE)
NOT_YET = "not yet"

Row = collections.namedtuple("Row", "what used note line")


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
    """The numbers of "(3.14) to (3.16)" or "3.22 and 3.23"."""
    out = []
    for is_range, major, minor in MEMBER.findall(text):
        if is_range and out:
            first = out[-1]
            if minor:
                out += [(major, str(i)) for i in range(int(first[1]) + 1, int(minor))]
            else:
                out += [(str(i), "") for i in range(int(first[0]) + 1, int(major))]
        out.append((major, minor))
    return [f"{a}.{b}" if b else a for a, b in out]


def equations(text):
    """What a file cites: (key, "(3.14)"), (key, "figure 3.23")."""
    found = set()
    for block in comments(text):
        for key, rest in KEYED.findall(block):
            if key not in KEYS:
                continue
            for listed in EQUATIONS.findall(rest):
                found |= {(key, f"({number})") for number in expand(listed)}
            for kind, listed in DRAWN.findall(rest):
                found |= {(key, f"{kind} {number}") for number in expand(listed)}
    return found


def citations(root, paths):
    cited = collections.defaultdict(list)
    for path in paths:
        for equation in sorted(equations(source_tree.read(path))):
            cited[equation].append(path)
    return cited


def both_sides(root):
    headers = citations(root, source_tree.files(root, source_tree.FOLDERS, [".hpp"]))
    tests = citations(root, source_tree.files(root, ["tests"], ["_test.cpp"]))
    return headers, tests


def full_list(root):
    """The rows of the list by (key, number), in its order."""
    rows = {}
    for line, text in enumerate(source_tree.read(root / LIST_FILE).splitlines(), 1):
        if not text or text.startswith("#"):
            continue
        name, what, used, note = (part.strip() for part in text.split("|"))
        key, number = re.fullmatch(r"\[(\w+)\] (.+)", name).groups()
        rows[(key, number)] = Row(what, used, note, line)
    return rows


def last_word(used):
    return re.findall(r"\w+", used)[-1]


def declares(code, used):
    return re.search(rf"\b{last_word(used)}\b", code) is not None


def is_free_function(code, used):
    """Whether a header that has it has a function, and neither a method nor a type with constructors."""
    word = last_word(used)
    is_type = re.search(rf"^(?:struct|class|enum class) {word}\b", code, re.MULTILINE)
    return "." not in used and not is_type and re.search(rf"\b{word}\(", code) is not None


def is_own_file(code, used):
    """Whether it defines what is used at the start of a line: a method, or a function or type."""
    word = last_word(used)
    if "." in used:
        return re.search(rf"^\w.*::{word}\(", code, re.MULTILINE) is not None
    return re.search(rf"^(?:(?:\[\[nodiscard\]\] )?\w[^\n;=]*[\s&*:])?{word}\(|^(?:struct|class|enum class) {word} ",
                     code, re.MULTILINE) is not None


def is_used(code, used, is_function):
    """Whether it is named; a free function must be called, since a field may have its name."""
    name = rf"(?<![\w.>]){re.escape(used)}(?:<[^;()]*>)?\(" if is_function else rf"(?<!\w){re.escape(used)}(?!\w)"
    return re.search(name, code) is not None and not is_own_file(code, used)


def folder_of_sources(path):
    """The folder that a quoted name which is no public header is looked for in, besides the file's own."""
    parts = path.parts
    return pathlib.Path(*parts[:parts.index("src") + 1]) if "src" in parts else path.parent


def included_by(paths):
    """By file, the headers of ours that it includes."""
    public = {path.as_posix().rpartition("/include/")[2]: path for path in paths if "include" in path.parts}
    known = set(paths)
    found = {}
    for path in paths:
        names = INCLUDE.findall(source_tree.without_comments(source_tree.read(path)))
        places = [[public.get(name), path.parent / name, folder_of_sources(path) / name] for name in names]
        found[path] = {place for choices in places for place in choices if place in known}
    return found


def sees(path, used, declaring, includes):
    """Whether it includes one of the headers, itself or by at most two headers of ours.

    A member, which is written with what has it, is seen by any way: it comes with the type of something else.
    """
    seen, new = {path}, {path}
    steps = 0
    while new and ("." in used or steps < 3):
        new = set().union(*(includes[one] for one in new)) - seen
        seen |= new
        steps += 1
    return not declaring.isdisjoint(seen)


def faults_of(equation, row, headers, tests, codes, includes):
    """What is missing of one equation."""
    cited = headers.get(equation, [])
    if row.used == NOT_YET:
        return [f"is cited by {path.name}: name its function instead of '{NOT_YET}'" for path in cited]
    faults = []
    if not cited:
        faults.append("is cited by no header")
    if not tests.get(equation):
        faults.append("is cited by no test")
    for used in re.split(r",\s*", row.used):
        declaring = {path for path in cited if declares(codes[path], used)}
        if cited and not declaring:
            faults.append(f"is cited by no header that has {used}")
        is_function = any(is_free_function(codes[path], used) for path in declaring)
        if not any(is_used(code, used, is_function) and sees(path, used, declaring, includes)
                   for path, code in codes.items()):
            faults.append(f"has no caller: nobody who sees its header uses {used} outside its own file and tests")
    return faults


def check(root):
    headers, tests = both_sides(root)
    rows = full_list(root)
    # Benchmarks are callers: figures of merit are there to be measured.
    paths = source_tree.files(root, (*source_tree.FOLDERS, "tests/bench"), [".hpp", ".cpp"])
    codes = {path: source_tree.without_comments_and_strings(source_tree.read(path)) for path in paths}
    includes = included_by(paths)
    problems = []
    for (key, number), row in rows.items():
        problems += [f"{LIST_FILE}:{row.line}: [{key}] {number} {fault}"
                     for fault in faults_of((key, number), row, headers, tests, codes, includes)]
    for (key, number), cited in sorted(headers.items(), key=order):
        if not number.startswith("("):
            continue
        listed = key == "hypermap" or (key, number) in rows
        for path in cited:
            if not listed:
                problems.append(f"{path.relative_to(root)}: [{key}] {number} is not in {LIST_FILE}")
            if (key, number) not in tests and (key, number) not in rows:
                problems.append(f"{path.relative_to(root)}: [{key}] {number} is cited by no test")
    return problems


def order(item):
    (key, number), _ = item
    return key, [(0, int(part)) if part.isdigit() else (1, part) for part in re.findall(r"\w+", number)]


def print_table(root):
    headers, tests = both_sides(root)
    print("| equation | what | header | test | not as printed |\n|---|---|---|---|---|")
    for (key, number), row in full_list(root).items():
        sides = [", ".join(path.relative_to(root).as_posix() for path in side.get((key, number), []))
                 for side in (headers, tests)]
        note = NOT_YET if row.used == NOT_YET else row.note
        print(f"| [{key}] {number} | {row.what} | {sides[0] or '-'} | {sides[1] or '-'} | {note} |")


HEADER = "core/include/hypermap/core/a.hpp"
SOURCE = "core/src/a.cpp"
TEST = "tests/core/a_test.cpp"
GOOD = {
    LIST_FILE: "# list\n[smap] (3.14) | a | combine |\n[smap] (3.15) | b | combine, bins.merge |\n"
               "[smap] (F.1) | c | combine |\n[smap] (3.17) | d | not yet |\n"
               "[smap] figure 3.23 | e | Angle | from the camera\n[sogm] (7) | f | combine |\n",
    HEADER: "/// Source: [smap] Eq. (3.14) to\n/// (3.15), figures 3.22 and 3.23, Eq. (F.1).\n"
            "/// Source: [sogm] Eq. (7).\n[[nodiscard]] int combine(int a);\nstruct Angle {\n  void merge();\n};\n",
    SOURCE: "int combine(int a) {\n  return a;\n}\n",
    "core/src/b.hpp": '#include "hypermap/core/a.hpp"\n',
    "core/src/c.hpp": '#include "b.hpp"\n',
    "core/src/d.hpp": '#include "c.hpp"\n',
    "core/src/c.cpp": '#include "d.hpp"\nvoid c() {\n  bins.merge();\n}\n',
    "core/src/inner/b.cpp": '#include "c.hpp"\nint b(Angle a) {\n  return combine(1);\n}\n',
    TEST: "// [smap] Eq. (3.14), Eq. (3.15) and (F.1), figure 3.23\n\n// [sogm] Eq. (7) to (9)\n",
}
CALLER = "core/src/inner/b.cpp"
BAD = [
    ("no header", {LIST_FILE: GOOD[LIST_FILE] + "[smap] (3.19) | g | combine |\n",
                   TEST: GOOD[TEST] + "\n// [smap] Eq. (3.19)\n"}),
    ("no test", {LIST_FILE: GOOD[LIST_FILE], TEST: "// [smap] Eq. (3.14), figure 3.23, [sogm] Eq. (7)\n"}),
    ("figure without test", {LIST_FILE: GOOD[LIST_FILE],
                             TEST: "// [smap] Eq. (3.14), (3.15), (F.1), [sogm] Eq. (7)\n"}),
    ("no caller but tests and its own file",
     {LIST_FILE: GOOD[LIST_FILE], CALLER: '#include "b.hpp"\nint b(Angle a);\n',
      SOURCE: "int combine(int a) {\n  return a;\n}\nint c() {\n  return combine(1);\n}\n",
      TEST: GOOD[TEST] + "int d = combine(2);\n"}),
    ("named by a comment alone",
     {LIST_FILE: GOOD[LIST_FILE],
      CALLER: '#include "b.hpp"\n// combine(1) of Angle\nint b();\n'}),
    ("called by a file that has another of the name, and not the header",
     {LIST_FILE: GOOD[LIST_FILE], CALLER: '#include "b.hpp"\nint b(Angle a);\n',
      "apps/src/c.cpp": "int c() {\n  const auto combine = [](int a) { return a; };\n  return combine(1);\n}\n"}),
    ("the name of a field alone",
     {LIST_FILE: GOOD[LIST_FILE], CALLER: GOOD[CALLER].replace("combine(1)", "stages.combine")}),
    ("a method of the name",
     {LIST_FILE: GOOD[LIST_FILE], CALLER: GOOD[CALLER].replace("combine(1)", "pot->combine(1)")}),
    ("its header included by a comment alone",
     {LIST_FILE: GOOD[LIST_FILE], CALLER: GOOD[CALLER].replace("#include", "// #include")}),
    ("a member of nothing that is included",
     {LIST_FILE: GOOD[LIST_FILE], "core/src/c.cpp": GOOD["core/src/c.cpp"].replace("#include", "// #include")}),
    ("its header three headers away",
     {LIST_FILE: GOOD[LIST_FILE], CALLER: GOOD[CALLER].replace("c.hpp", "d.hpp")}),
    ("a function that the citing header lacks",
     {LIST_FILE: GOOD[LIST_FILE].replace("| a | combine", "| a | b")}),
    ("built, and still not yet", {LIST_FILE: GOOD[LIST_FILE],
                                  HEADER: GOOD[HEADER] + "\n/// Source: [smap] Eq. (3.17)\n"}),
    ("not in the list", {"core/include/hypermap/core/c.hpp": "/// Source: [smap] Eq. (3.19).\n"}),
    ("middle of a range not in the list",
     {"core/include/hypermap/core/c.hpp": "/// [sogm] Eq. (7) to (9)\n"}),
    ("same number of another source", {"core/include/hypermap/core/c.hpp": "/// [sogm] Eq. (3.14)\n"}),
    ("of a source without a list, not tested",
     {"core/include/hypermap/core/c.hpp": "/// [hypermap] Eq. (1)\n"}),
]

if __name__ == "__main__":
    sys.exit(source_tree.main(__doc__, check, GOOD, BAD, after=print_table))
