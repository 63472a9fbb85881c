#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Every name that a Python file uses is one that it has: a name that is left over from a renaming is
found before the line that uses it runs, which may be the last of ten minutes."""

import builtins
import symtable
import sys

import source_tree

KNOWN = set(dir(builtins)) | {"__file__", "__name__", "__doc__"}


def python_files(root):
    """Python by the ending of its name or by its first line."""
    for path in source_tree.files(root, ["scripts", "tests"], [""]):
        if path.suffix == ".py":
            yield path
        elif path.is_file() and not path.suffix:
            with path.open("rb") as file:
                if b"python" in file.readline():
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


def check(root):
    return [f"{path.relative_to(root).as_posix()}: nothing is named {name}"
            for path in python_files(root) for name in unknown_names(source_tree.read(path), str(path))]


GOOD = {
    "scripts/report.py": "import sys\n\nLIMIT = 1\n\n\ndef row(value):\n    status = value > LIMIT\n"
                         "    return [f'{status} {len(part)}' for part in sys.argv]\n",
    "scripts/check": "#!/usr/bin/env python3\nprint(__file__)\n",
    "scripts/build": "#!/usr/bin/env bash\necho \"$1\"\n",
}
BAD = [
    ("old name in a text", {"scripts/report.py": "def row():\n    status = 1\n    return f'{verdict}'\n"}),
    ("a local of another function", {"tests/x.py": "def a():\n    b = 1\n\n\ndef c():\n    return b\n"}),
    ("a module that is not imported", {"scripts/check": "#!/usr/bin/env python3\njson.dumps(1)\n"}),
]

if __name__ == "__main__":
    sys.exit(source_tree.main(__doc__, check, GOOD, BAD))
