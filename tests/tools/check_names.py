#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""A type is defined in one header: two of one name would be one to the linker, and of the wrong size to one of them."""

import collections
import re
import sys

import source_tree

# Types of a namespace stand at the beginning of a line; members are indented.
DEFINITION = re.compile(
    r"^(?:template\s*<[^;{}]*>\s*)?(?:struct|class|enum(?:\s+class)?)\s+(?:alignas\([^)]*\)\s*)?"
    r"(\w+)(?:\s+final)?\s*(?::(?!:)[^;{]*)?\{", re.MULTILINE)


def check(root):
    places = collections.defaultdict(list)
    for path in source_tree.files(root, source_tree.FOLDERS, [".hpp"]):
        code = source_tree.without_comments(source_tree.read(path))
        for match in DEFINITION.finditer(code):
            line = source_tree.line_of(code, match.start(1))
            places[match.group(1)].append(f"{path.relative_to(root).as_posix()}:{line}")
    return [f"{found[1]}: {name} is also defined in {found[0]}"
            for name, found in sorted(places.items()) if len(found) > 1]


GOOD = {
    "core/src/a.hpp": "struct Rect {\n  int a;\n};\nstruct Later;\n",
    "io/src/b.hpp": "// struct Rect {\nclass Later {\n  struct Rect {\n  };\n};\n",
    "io/src/c.hpp": "struct Rect::Corner {\n};\n",
}
BAD = [
    ("two structs", {"core/src/a.hpp": "struct Rect {\n};\n", "io/src/b.hpp": "struct Rect {\n};\n"}),
    ("a class and a template",
     {"core/src/a.hpp": "class Grid {\n};\n", "io/src/b.hpp": "template <class T>\nclass Grid : Base {\n};\n"}),
    ("enums", {"core/src/a.hpp": "enum class Kind : int { kA };\n", "io/src/b.hpp": "enum class Kind { kB };\n"}),
]

if __name__ == "__main__":
    sys.exit(source_tree.main(__doc__, check, GOOD, BAD))
