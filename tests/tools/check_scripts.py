#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What would stop a script of ours late or by chance is found without running it.

A name that a Python file uses is one that it has: one left over from a renaming may stand in the last line of ten minutes.
No program in a pipe of a shell script stops reading before its input ends: the writer dies of a closed pipe if it has
more to say than the pipe holds, and with `pipefail` the script with it, or not, as the machine's load has it."""

import builtins
import re
import symtable
import sys

import source_tree

KNOWN = set(dir(builtins)) | {"__file__", "__name__", "__doc__"}


# `grep` with q among its letters or with -m, `sed` with the command q, `head` of lines or bytes.
STOPS_READING = re.compile(r"(?<!\|)\|\s*(head\b|grep\s+-\w*[qm]|sed\s+(-\w+\s+)*'?[^'|]*\dq)")


def files_for(root, program, suffix):
    """By the ending of their names or by their first lines."""
    for path in source_tree.files(root, ["scripts", "tests", ".ci"], [""]):
        if path.suffix == suffix:
            yield path
        elif path.is_file() and not path.suffix:
            with path.open("rb") as file:
                first = file.readline()
                if first.startswith(b"#!") and program in first:
                    yield path


def scopes(table):
    yield table
    for child in table.get_children():
        yield from scopes(child)


def unknown_names(text, name):
    module = symtable.symtable(text, name, "exec")
    known = KNOWN | {symbol.get_name() for symbol in module.get_symbols()
                     if symbol.is_assigned() or symbol.is_imported()}
    return sorted({symbol.get_name() for scope in scopes(module) for symbol in scope.get_symbols()
                   if symbol.is_global() and symbol.is_referenced()} - known)


def check_names(root):
    return [f"{path.relative_to(root).as_posix()}: nothing is named {name}"
            for path in files_for(root, b"python", ".py") for name in unknown_names(source_tree.read(path), str(path))]


def check_pipes(root):
    return [f"{path.relative_to(root).as_posix()}:{number}: a program in this pipe stops reading before its input ends"
            for path in files_for(root, b"bash", ".sh")
            for number, line in enumerate(source_tree.read(path).splitlines(), 1)
            if not line.lstrip().startswith("#") and STOPS_READING.search(line)]


def check(root):
    return check_names(root) + check_pipes(root)


GOOD = {
    "scripts/report.py": "import sys\n\nLIMIT = 1\n\n\ndef row(value):\n    status = value > LIMIT\n"
                         "    return [f'{status} {len(part)}' for part in sys.argv]\n",
    "scripts/check": "#!/usr/bin/env python3\nprint(__file__)\n",
    "scripts/build": "#!/usr/bin/env bash\n# never: ls | head -n 1\nls | shuf -n 3 | grep x | sed -n 1,2p\nls || head -n 1 list\n",
}
BAD = [
    ("old name in a text", {"scripts/report.py": "def row():\n    status = 1\n    return f'{verdict}'\n"}),
    ("a local of another function", {"tests/x.py": "def a():\n    b = 1\n\n\ndef c():\n    return b\n"}),
    ("head in a pipe", {"scripts/build": "#!/usr/bin/env bash\nls | sort -R | head -n 100 | xargs rm\n"}),
    ("a quiet grep in a pipe", {"scripts/lib.sh": "ls | grep -iq x\n"}),
    ("sed that quits", {".ci/run": "#!/usr/bin/env bash\nls |\n  sort | sed -n '1,4p;5q'\n"}),
    ("a module that is not imported", {"scripts/check": "#!/usr/bin/env python3\njson.dumps(1)\n"}),
]

if __name__ == "__main__":
    sys.exit(source_tree.main(__doc__, check, GOOD, BAD))
