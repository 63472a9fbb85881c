#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Every number of an options struct has a default and a comment, and every real number its unit in
the name or in the comment. Fields of a type of ours are explained by that type."""

import re
import sys

import source_tree

STRUCT = re.compile(r"^struct (\w*Options) \{\n(.*?)^\};", re.MULTILINE | re.DOTALL)
FIELD = re.compile(r"^  (?!friend|using|static|enum|struct|\[\[|explicit|return)"
                   r"([\w:<>, ]+?[\w>&]) (\w+)(\s*=[^;]*|\s*\{[^;]*\})?;(.*)$", re.MULTILINE)
UNIT_IN_NAME = re.compile(
    r"_(m|mm|m2|m3|px|rad|deg|s|ms|ns|hz|cells|bytes|mib|per_m|per_frame|stddev)$|"
    r"share|fraction|ratio|factor|probability|score|confidence|weight|gain|agreement")
UNIT_IN_COMMENT = re.compile(
    r"[Uu]nit|metre|pixel|degree|radian|second|cell|share|fraction|ratio|probability|log-odds|"
    r"standard deviation|times|per cent|%|in \[0, 1\]|IoU|over union|weight|diagonal", re.IGNORECASE)
REAL = ("double", "float")
OWN_TYPE = re.compile(r"^(const )?[A-Z]\w*$")
HAS_NO_DEFAULT_OF_ITS_OWN = re.compile(r"^(double|float|bool|int|unsigned|char|std::u?int\d+_t|std::size_t)")


def comment_above(lines, index):
    out = []
    while index > 0 and lines[index - 1].strip().startswith("//"):
        index -= 1
        out.insert(0, lines[index].strip().lstrip("/").strip())
    return " ".join(out)


def comment_beside(lines, index, trailing):
    out = [trailing.split("///<", 1)[1].strip()] if "///<" in trailing else []
    while out and index + 1 < len(lines) and lines[index + 1].strip().startswith("///<"):
        index += 1
        out.append(lines[index].strip()[4:].strip())
    return " ".join(out)


def field_problem(kind, name, default, comment):
    if not comment and not OWN_TYPE.match(kind):
        return "has no comment"
    if default is None and HAS_NO_DEFAULT_OF_ITS_OWN.match(kind):
        return "has no default"
    if kind in REAL and not UNIT_IN_NAME.search(name) and not UNIT_IN_COMMENT.search(comment):
        return "has no unit in its name or comment"
    return None


def check(root):
    problems = []
    for path in source_tree.public_headers(root):
        text = source_tree.read(path)
        for struct in STRUCT.finditer(text):
            body = struct.group(2)
            lines = body.split("\n")
            for field in FIELD.finditer(body):
                kind, name, default, trailing = field.groups()
                index = body.count("\n", 0, field.start())
                comment = comment_above(lines, index) or comment_beside(lines, index, trailing)
                problem = field_problem(kind.strip(), name, default, comment)
                if problem is None:
                    continue
                line = source_tree.line_of(text, struct.start(2) + field.start())
                problems.append(f"{path.relative_to(root).as_posix()}:{line}: "
                                f"{struct.group(1)}.{name} {problem}")
    return problems


HEADER = "core/include/hypermap/core/a.hpp"


def header(fields):
    return "struct AOptions {\n" + fields + "};\n"


GOOD = {HEADER: header("  double range_m = 1.0;  ///< Farther is dropped.\n"
                       "  /// Names to keep.\n  std::vector<std::string> names = {};\n"
                       "  /// Larger keeps more. Unit: standard deviation.\n  double spread = 0.3;\n"
                       "  friend bool operator==(const AOptions&, const AOptions&) = default;\n")}
BAD = [
    ("no comment", {HEADER: header("  double range_m = 1.0;\n")}),
    ("no default", {HEADER: header("  double range_m;  ///< Farther is dropped.\n")}),
    ("no unit", {HEADER: header("  double spread = 0.3;  ///< Larger keeps more.\n")}),
    ("second field", {HEADER: header("  int a = 1;  ///< Many.\n  int b = 1;\n")}),
]

if __name__ == "__main__":
    sys.exit(source_tree.main(__doc__, check, GOOD, BAD))
