# SPDX-License-Identifier: BSD-3-Clause
"""What the checks of this folder share: walking the tree, reading code, testing a check itself."""

import argparse
import pathlib
import re
import sys
import tempfile

FOLDERS = ("core", "octree_semantic", "projection", "grid_registration", "io", "viewer_offscreen", "apps")
LIBRARIES = FOLDERS[:-1]
ROOT = pathlib.Path(__file__).resolve().parents[2]

COMMENT_OR_STRING = re.compile(
    r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])*\'', re.DOTALL)


def files(root, folders, patterns):
    """Files of the folders whose name ends as one of the patterns says, sorted."""
    found = []
    for folder in folders:
        for pattern in patterns:
            found += (root / folder).rglob("*" + pattern)
    return sorted(found)


def public_headers(root):
    return [path for path in files(root, LIBRARIES, [".hpp"]) if "include" in path.parts]


def read(path):
    return path.read_text(encoding="utf-8")


def without_comments(text):
    """The code with comments blanked out; lines keep their numbers, strings stay."""
    def blank(match):
        token = match.group(0)
        return re.sub(r"[^\n]", " ", token) if token.startswith("/") else token
    return COMMENT_OR_STRING.sub(blank, text)


def without_comments_and_strings(text):
    return COMMENT_OR_STRING.sub(lambda match: re.sub(r"[^\n]", " ", match.group(0)), text)


def line_of(text, position):
    return text.count("\n", 0, position) + 1


def self_test(check, good, bad):
    """Runs `check` on made trees: `good` must pass, each tree of `bad` must be refused.

    A tree is {path: content}. Bad trees are laid over the good one, and the check has to name
    the path that broke the rule.
    """
    failures = []
    cases = [("good tree", {}, None)] + [(name, tree, next(iter(tree))) for name, tree in bad]
    for name, tree, culprit in cases:
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            for path, content in {**good, **tree}.items():
                target = root / path
                target.parent.mkdir(parents=True, exist_ok=True)
                target.write_text(content, encoding="utf-8")
            problems = check(root)
        if culprit is None and problems:
            failures.append(f"{name}: refused: {problems}")
        if culprit is not None and not any(culprit in problem for problem in problems):
            failures.append(f"{name}: not noticed, found {problems}")
    return failures


def main(description, check, good, bad, after=None):
    """The command line of a check: `--root DIR` or `--self-test`; exit code 1 on problems."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("--root", type=pathlib.Path,
                        default=ROOT)
    parser.add_argument("--self-test", action="store_true",
                        help="show that the check can fail, on made trees")
    arguments = parser.parse_args()
    problems = self_test(check, good, bad) if arguments.self_test else check(arguments.root)
    if after is not None and not arguments.self_test:
        after(arguments.root)
    for problem in problems:
        print(problem, file=sys.stderr)
    print(f"{len(problems)} problem(s)")
    return 1 if problems else 0
