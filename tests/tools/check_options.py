#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Every number of an options struct has a default and a comment, and every real number its unit in
the name or in the comment. Fields of a type of ours are explained by that type.

Each options struct has an option table, and its `validate` asks that one; WITHOUT_TABLE says which
have none and why. Each field that a row can hold stands there, with an effect, and with the unit
that its name or type says; of the options of a map (MapOptions and all that it holds) each field."""

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


MAP_OPTIONS = "MapOptions"
NO_OPTION_OF_A_FILE = {
    "AssociationOptions.transient_classes": "classes by number have no meaning elsewhere",
}
WITHOUT_TABLE = {
    "CloudObservationOptions": "the mapper fills it from options that have one",
    "CutawayOptions": "a snapshot fills it; leaving out voxels cannot fail",
    "DetectionReadOptions": "names and limits of a reader, of any size",
    "FileCheckOptions": "a kind, a size and a flag, each of any value",
    "FootprintOptions": "fields of ConfirmationOptions, whose table has them",
    "LabelLayoutOptions": "placing labels cannot fail",
    "OctreeConversionOptions": "limits of a reader, of any size",
    "OctreeMergeOptions": "names and a choice, each of any value",
    "RayCastOptions": "casting a ray cannot fail",
    "SaveOptions": "a flag and limits of any size",
    "SemanticReadOptions": "a flag and limits of any size",
}
TABLE = re.compile(r"\boption_table\(const (\w+)&")
VALIDATE = re.compile(r"^Result<void> validate\(const (\w*Options)& \w+\) \{\n(.*?)^\}",
                      re.MULTILINE | re.DOTALL)
HELD_BY_A_ROW = re.compile(r"^(std::optional<)?(double|float|bool|int|unsigned|std::u?int\d+_t|"
                           r"std::size_t|Probability|LogOdds|\w+Options)>?$|"
                           r"^std::vector<std::string>$")
ALIAS = re.compile(r"^using (\w+) = (\w+Options);", re.MULTILINE)
ROW = re.compile(r"option::(\w+)<&(\w+)::(\w+)>\(")
UNIT_OF_NAME = {"_m": "m", "_px": "px", "_s": "s", "_deg": "degrees", "_rad": "rad", "_m2": "m2",
                "_per_m": "m/m", "_per_m2": "1/m", "_m_per_s": "m/s", "_bytes": "bytes"}
UNIT_OF_TYPE = {"LogOdds": "log-odds", "Probability": "probability"}
SAYS_NO_UNIT = ("flag", "choice", "names", "section")


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


def structs_of(root):
    """(path, text, match) of each options struct of the public headers."""
    for path in source_tree.public_headers(root):
        text = source_tree.read(path)
        for struct in STRUCT.finditer(text):
            yield path, text, struct


def check_comments(root):
    problems = []
    for path, text, struct in structs_of(root):
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


def row_text(text, start):
    """The arguments of a row, from its opening parenthesis to the closing one."""
    code = source_tree.without_comments_and_strings(text)
    depth = 0
    for end in range(start, len(code)):
        depth += {"(": 1, ")": -1}.get(code[end], 0)
        if depth == 0:
            return text[start:end + 1]
    return text[start:]


def rows_of(root):
    """{"Struct.field": (kind, arguments)} of all tables."""
    rows = {}
    for path in source_tree.files(root, source_tree.LIBRARIES, [".cpp"]):
        text = source_tree.read(path)
        if "option::" not in text:
            continue
        aliases = dict(ALIAS.findall(text))
        for row in ROW.finditer(text):
            struct = aliases.get(row.group(2), row.group(2))
            rows[f"{struct}.{row.group(3)}"] = (row.group(1), row_text(text, row.end() - 1))
    return rows


def expected_unit(kind, name):
    bare = kind.strip().removeprefix("std::optional<").rstrip(">")
    if bare in UNIT_OF_TYPE:
        return UNIT_OF_TYPE[bare]
    endings = [ending for ending in UNIT_OF_NAME if name.endswith(ending)]
    return UNIT_OF_NAME[max(endings, key=len)] if endings else None


def row_problem(kind, name, row):
    if row is None:
        return "stands in no option table"
    function, arguments = row
    if function == "section":
        return None
    if ".effect" not in arguments:
        return "has no effect in its table"
    unit = expected_unit(kind, name)
    if function in SAYS_NO_UNIT or unit is None or f'.unit = "{unit}"' in arguments:
        return None
    return f'has not the unit "{unit}" in its table'


def held_by_map_options(structs):
    """Names of the structs that MapOptions holds, itself included."""
    held, waiting = set(), [MAP_OPTIONS]
    while waiting:
        name = waiting.pop()
        if name in held or name not in structs:
            continue
        held.add(name)
        fields = FIELD.finditer(structs[name][2].group(2))
        waiting += [field.group(1).strip() for field in fields]
    return held


def needs_row(kind, is_in_map_options):
    return is_in_map_options or (kind not in WITHOUT_TABLE and HELD_BY_A_ROW.match(kind))


def table_problem(name, tables):
    if (name in tables) != (name in WITHOUT_TABLE):
        return None
    return "stands in WITHOUT_TABLE and has a table" if name in tables else "has no option table"


def check_tables(root):
    structs = {struct.group(1): (path, text, struct) for path, text, struct in structs_of(root)}
    in_map_options = held_by_map_options(structs)
    rows = rows_of(root)
    problems = []
    for name, (path, text, struct) in structs.items():
        place = path.relative_to(root).as_posix()
        problem = table_problem(name, TABLE.findall(text))
        if problem is not None:
            line = source_tree.line_of(text, struct.start())
            problems.append(f"{place}:{line}: {name} {problem}")
        if problem is not None or name in WITHOUT_TABLE:
            continue
        for field in FIELD.finditer(struct.group(2)):
            kind, member = field.group(1).strip(), field.group(2)
            key = f"{name}.{member}"
            if key in NO_OPTION_OF_A_FILE or not needs_row(kind, name in in_map_options):
                continue
            problem = row_problem(kind, member, rows.get(key))
            if problem is None:
                continue
            line = source_tree.line_of(text, struct.start(2) + field.start())
            problems.append(f"{place}:{line}: {key} {problem}")
    return problems


def check_validation(root):
    problems = []
    for path in source_tree.files(root, source_tree.LIBRARIES, [".cpp"]):
        text = source_tree.read(path)
        for function in VALIDATE.finditer(text):
            if "check_options(" in function.group(2):
                continue
            line = source_tree.line_of(text, function.start())
            problems.append(f"{path.relative_to(root).as_posix()}:{line}: "
                            f"validate({function.group(1)}) does not ask the option table")
    return problems


def check(root):
    return check_comments(root) + check_tables(root) + check_validation(root)


HEADER = "core/include/hypermap/core/a.hpp"


def declared(name):
    return f"const OptionTable& option_table(const {name}& options);\n"


def header(fields):
    return "struct AOptions {\n" + fields + "};\n" + declared("AOptions")


GOOD = {HEADER: header("  double range_m = 1.0;  ///< Farther is dropped.\n"
                       "  /// Names to keep.\n  std::vector<std::string> names = {};\n"
                       "  /// Larger keeps more. Unit: standard deviation.\n  double spread = 0.3;\n"
                       "  friend bool operator==(const AOptions&, const AOptions&) = default;\n")}
MAP_HEADER = "io/options/include/hypermap/io/b.hpp"
TABLE_FILE = "core/src/a.cpp"
CORE_HEADER = "core/include/hypermap/core/c.hpp"
GOOD[MAP_HEADER] = "struct MapOptions {\n  CoreOptions core;\n};\n" + declared("MapOptions")
GOOD[CORE_HEADER] = ("struct CoreOptions {\n  double range_m = 1.0;  ///< Farther is dropped.\n};\n"
                     + declared("CoreOptions"))
GOOD["core/src/d.cpp"] = "".join(
    f'auto {name} = option::number<&AOptions::{name}>("{name}", {{0, 1}}, {{.unit = "m", .effect = "x"}});\n'
    for name in ("range_m", "names", "spread", "a", "b"))
VALIDATION = "core/src/e.cpp"
GOOD[VALIDATION] = ("Result<void> validate(const AOptions& options) {\n"
                    "  return check_options(options);\n}\n")
GOOD["io/options/src/b.cpp"] = 'auto a = option::section<&MapOptions::core>("core");\n'


def table(notes):
    return ("using Core = CoreOptions;\n"
            f'auto a = option::number<&Core::range_m>("range_m", {{0, 1}}, {{{notes}}});\n')


GOOD[TABLE_FILE] = table('.unit = "m", .effect = "Farther (than this) is dropped."')
BAD = [
    ("no comment", {HEADER: header("  double range_m = 1.0;\n")}),
    ("no default", {HEADER: header("  double range_m;  ///< Farther is dropped.\n")}),
    ("no unit", {HEADER: header("  double spread = 0.3;  ///< Larger keeps more.\n")}),
    ("second field", {HEADER: header("  int a = 1;  ///< Many.\n  int b = 1;\n")}),
    ("no table", {HEADER: GOOD[HEADER].replace(declared("AOptions"), "")}),
    ("a table in vain", {HEADER: GOOD[HEADER].replace("AOptions", "SaveOptions")}),
    ("no row", {HEADER: header("  bool is_wide = true;  ///< Wider.\n")}),
    ("validated by hand", {VALIDATION: GOOD[VALIDATION].replace("check_options(options)", "{}")}),
    ("not in a table", {CORE_HEADER: "struct CoreOptions {\n"
                                     "  double range_m = 1.0;  ///< Farther is dropped.\n"
                                     "  Frame more = {};  ///< Many.\n};\n"
                                     + declared("CoreOptions")}),
    ("no unit in the table", {CORE_HEADER: GOOD[CORE_HEADER],
                              TABLE_FILE: table('.effect = "Farther is dropped."')}),
    ("no effect in the table", {CORE_HEADER: GOOD[CORE_HEADER], TABLE_FILE: table('.unit = "m"')}),
    ("no section", {MAP_HEADER: GOOD[MAP_HEADER], "io/options/src/b.cpp": ""}),
]

if __name__ == "__main__":
    sys.exit(source_tree.main(__doc__, check, GOOD, BAD))
