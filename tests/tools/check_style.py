#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Rules that a compiler does not keep: licence lines, no printing or chance in libraries, no flags
that change results, no leftovers, no long file without a reason in its head."""

import re
import sys

import source_tree

SPDX = "SPDX-License-Identifier: BSD-3-Clause"
CODE = [".hpp", ".cpp"]
MAX_LINES = 300
HEAD_LINES = 12
REASON = re.compile(r"\bLong because: \S")

# In the code of libraries; comments and strings do not count.
BANNED_IN_LIBRARIES = [
    (r"std::(cout|cerr|clog)\b|#\s*include\s*<iostream>", "a library does not print"),
    (r"\b(std::)?(printf|puts|fprintf)\s*\(", "a library does not print"),
    (r"\b(std::)?s?rand\s*\(|std::random_device", "chance has to be seeded by the caller"),
    (r"\b(std::)?(abort|exit|_Exit|quick_exit)\s*\(", "a library does not end its host"),
    (r"\bstd::(stod|stof|stoi|stol|stoul|stoull|atof|atoi|strtod)\b", "depends on the locale"),
]
BANNED_IN_HEADERS = [(r"^\s*using namespace\b", "headers open no namespace")]
# Anywhere, comments included.
BANNED_IN_ALL_TEXT = [(r"\b(TODO|FIXME|XXX|HACK)\b", "leftover"), (r"/(home|root)/\w", "path of one machine")]
BANNED_IN_BUILD = [(r"-ffast-math|-Ofast|-funsafe-math", "changes results"),
                   (r"-march=native|-mtune=native", "runs on one machine only")]


def findings(text, rules):
    for pattern, reason in rules:
        for match in re.finditer(pattern, text, re.MULTILINE):
            yield source_tree.line_of(text, match.start()), f"{reason}: {match.group(0).strip()}"


def spdx_problem(text):
    first_lines = text.splitlines()[:2]
    return [] if any(SPDX in line for line in first_lines) else [(1, "no SPDX line")]


def length_problems(text):
    lines = text.splitlines()
    if len(lines) <= MAX_LINES or any(REASON.search(line) for line in lines[:HEAD_LINES]):
        return []
    return [(1, f"has {len(lines)} lines, over {MAX_LINES}: split it by topic, or say 'Long because: ...' in its "
                f"first {HEAD_LINES} lines")]


def code_problems(root, path, text):
    folder = path.relative_to(root).parts[0]
    is_header = path.suffix == ".hpp"
    code = source_tree.without_comments_and_strings(text)
    problems = spdx_problem(text) + list(findings(text, BANNED_IN_ALL_TEXT))
    if folder in source_tree.LIBRARIES:
        problems += findings(code, BANNED_IN_LIBRARIES)
    if is_header:
        problems += findings(code, BANNED_IN_HEADERS)
        if "#pragma once" not in text:
            problems.append((1, "no #pragma once"))
    return problems


def text_problems(text):
    problems = []
    for number, line in enumerate(text.split("\n"), start=1):
        if line.endswith("\r"):
            problems.append((number, "carriage return"))
        elif line != line.rstrip():
            problems.append((number, "space at the end of the line"))
        if "\t" in line:
            problems.append((number, "tab"))
    if text and not text.endswith("\n"):
        problems.append((text.count("\n") + 1, "no newline at the end"))
    return problems


def check(root):
    problems = []

    def report(path, found):
        name = path.relative_to(root).as_posix()
        problems.extend(f"{name}:{line}: {problem}" for line, problem in found)

    folders = [*source_tree.FOLDERS, "tests"]
    for path in source_tree.files(root, folders, CODE):
        text = source_tree.read(path)
        report(path, code_problems(root, path, text) + text_problems(text) + length_problems(text))
    for path in source_tree.files(root, folders, [".py"]):
        text = source_tree.read(path)
        report(path, spdx_problem(text) + text_problems(text) + length_problems(text))
    build_files = source_tree.files(root, [*folders, "cmake"], ["CMakeLists.txt", ".cmake"])
    top = [root / name for name in ("CMakeLists.txt", "CMakePresets.json")]
    for path in build_files + [path for path in top if path.exists()]:
        text = source_tree.read(path)
        report(path, list(findings(text, BANNED_IN_BUILD)) + text_problems(text))
    return problems


LINE = "// SPDX-License-Identifier: BSD-3-Clause\n"
GOOD = {
    "core/src/a.cpp": LINE + '// std::cout is not used\nauto text = "std::cerr";\nint brand(int);\n',
    "core/include/hypermap/core/a.hpp": LINE + "#pragma once\n",
    "apps/src/main.cpp": LINE + "#include <iostream>\nvoid f() { std::cout << 1; }\n",
    "core/CMakeLists.txt": "target_compile_options(core PRIVATE -O2)\n",
    "core/src/full.cpp": LINE + "int x;\n" * 299,
    "core/src/long.cpp": LINE + "// Long because: one table of many rows.\n" + "int x;\n" * 299,
}
BAD = [
    ("no licence", {"core/src/x.cpp": "int x;\n"}),
    ("prints", {"core/src/x.cpp": LINE + "void f() { std::cout << 1; }\n"}),
    ("chance", {"io/src/x.cpp": LINE + "int f() { return rand(); }\n"}),
    ("locale", {"io/src/x.cpp": LINE + "double f() { return std::stod(s); }\n"}),
    ("fast math", {"core/CMakeLists.txt": "add_compile_options(-ffast-math)\n"}),
    ("native", {"CMakeLists.txt": "add_compile_options(-march=native)\n"}),
    ("namespace in header",
     {"core/include/hypermap/core/x.hpp": LINE + "#pragma once\nusing namespace std;\n"}),
    ("no guard", {"core/include/hypermap/core/x.hpp": LINE + "int x;\n"}),
    ("leftover", {"core/src/x.cpp": LINE + "// TO" + "DO later\n"}),
    ("trailing space", {"core/src/x.cpp": LINE + "int x; \n"}),
    ("long", {"core/src/x.cpp": LINE + "int x;\n" * 300}),
    ("long test script", {"tests/x.py": "# " + SPDX + "\n" + "x = 1\n" * 300}),
    ("long without a reason", {"core/src/x.cpp": LINE + "// Long because:\n" + "int x;\n" * 300}),
    ("a reason that nobody reads", {"core/src/x.cpp": LINE + "int x;\n" * 300 + "// Long because: so.\n"}),
    ("no final newline", {"tests/core/x_test.cpp": LINE + "int x;"}),
]

if __name__ == "__main__":
    sys.exit(source_tree.main(__doc__, check, GOOD, BAD))
