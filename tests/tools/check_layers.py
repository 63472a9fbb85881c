#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Includes follow the arrows of ARCHITECTURE.md, and third-party headers stay where they belong."""

import re
import sys

import source_tree

# Which folders' headers a folder may include besides its own.
BELOW = {
    "core": (),
    "octree_semantic": ("core",),
    "projection": ("core",),
    "io": ("core", "octree_semantic", "projection"),
    "viewer_offscreen": ("core", "octree_semantic", "projection", "io"),
    "apps": ("core", "octree_semantic", "projection", "io", "viewer_offscreen"),
}

# Third-party headers that any public header may include.
PUBLIC_EVERYWHERE = ("Eigen/", "tl/expected.hpp")
# And those that only the named public headers may.
PUBLIC_IN = {
    "octree_semantic/include/hypermap/octree_semantic/octomap_interchange.hpp": ("octomap/",),
    "io/include/hypermap/io/atomic_file.hpp": ("sys/types.h",),  # POSIX: a file's mode
}
# Third-party headers of one folder's sources only, whatever folder asks for them.
SOURCES_IN = {
    "pcl/": ("core",),
    "octomap/": ("octree_semantic",),
    "yaml-cpp/": ("io",),
    "zip.h": ("io",),
    "png.h": ("io",),
    "nlohmann/": ("io", "apps"),
    "EGL/": ("viewer_offscreen",),
    "CLI/": ("apps",),
}

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.MULTILINE)
STANDARD = re.compile(r"^[a-z_0-9]+$")


def own_include_problem(folder, target):
    match = re.match(r"hypermap/(\w+)/", target)
    if match is None or match.group(1) in (folder, *BELOW[folder]):
        return None
    return f"{folder} may not include {match.group(1)} ({target})"


def public_problem(name, bracket, target):
    if bracket == '"':
        return None if target.startswith("hypermap/") else f"public header includes private {target}"
    allowed = PUBLIC_EVERYWHERE + PUBLIC_IN.get(name, ())
    if STANDARD.match(target) or target.startswith(allowed):
        return None
    return f"third-party header in a public header: {target}"


def source_problem(folder, target):
    for prefix, folders in SOURCES_IN.items():
        if target.startswith(prefix) and folder not in folders:
            return f"{target} belongs to {', '.join(folders)} only"
    return None


def check(root):
    problems = []
    for folder in source_tree.FOLDERS:
        for path in source_tree.files(root, [folder], [".hpp", ".cpp"]):
            name = path.relative_to(root).as_posix()
            code = source_tree.without_comments(source_tree.read(path))
            for match in INCLUDE.finditer(code):
                bracket, target = match.groups()
                found = [own_include_problem(folder, target), source_problem(folder, target)]
                if ".." in target:
                    found.append(f"relative include {target}")
                if "/include/" in name:
                    found.append(public_problem(name, bracket, target))
                line = source_tree.line_of(code, match.start())
                problems += [f"{name}:{line}: {problem}" for problem in found if problem]
    return problems


GOOD = {
    "core/include/hypermap/core/a.hpp": "#include <Eigen/Core>\n#include <vector>\n",
    "core/src/a.cpp": '#include "hypermap/core/a.hpp"\n#include <pcl/point_types.h>\n',
    "io/src/b.cpp": '#include "hypermap/projection/a.hpp"\n// #include "hypermap/apps/x.hpp"\n',
}
BAD = [
    ("core includes io", {"core/src/x.cpp": '#include "hypermap/io/b.hpp"\n'}),
    ("siblings", {"projection/src/x.cpp": '#include "hypermap/octree_semantic/b.hpp"\n'}),
    ("PCL in public", {"core/include/hypermap/core/x.hpp": "#include <pcl/point_types.h>\n"}),
    ("octomap in another header",
     {"octree_semantic/include/hypermap/octree_semantic/x.hpp": "#include <octomap/OcTree.h>\n"}),
    ("PCL outside core", {"io/src/x.cpp": "#include <pcl/point_types.h>\n"}),
    ("private header in public", {"core/include/hypermap/core/x.hpp": '#include "x_detail.hpp"\n'}),
    ("upward path", {"core/src/x.cpp": '#include "../secret.hpp"\n'}),
]

if __name__ == "__main__":
    sys.exit(source_tree.main(__doc__, check, GOOD, BAD))
