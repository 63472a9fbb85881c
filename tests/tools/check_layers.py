#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Includes follow the arrows that the CMake files declare between libraries and rooms, every declared arrow is used, the
drawing in ARCHITECTURE.md has the same arrows, third-party headers stay where they belong, and a library links what its
sources include. `--arrows` prints the arrows."""

import collections
import re
import sys

import source_tree

# Third-party headers that any public header may include.
PUBLIC_EVERYWHERE = ("Eigen/", "tl/expected.hpp")
# Third-party headers: the target that their includer links, and the libraries whose sources may include them.
ANYWHERE = None
THIRD_PARTY = {
    "Eigen/": ("Eigen3::Eigen", ANYWHERE),
    "tl/expected.hpp": ("tl::expected", ANYWHERE),
    "boost/": ("Boost::headers", ANYWHERE),
    "tbb/": ("TBB::tbb", ANYWHERE),
    "pcl/": ("PclLite::pcl", ("core",)),
    "octomap/": ("octomap", ()),  # the oracle of tests only
    "embree3/": ("embree", ("octree_semantic", "simulator")),
    "hwy/": ("hwy::hwy", ("octree_semantic",)),
    "opencv2/core": ("opencv_core", ("combiner", "detector", "grid_registration", "viewer_offscreen")),
    "opencv2/dnn": ("opencv_dnn", ("detector",)),
    "opencv2/features2d": ("opencv_features2d", ("grid_registration",)),
    "opencv2/freetype": ("opencv_freetype", ("viewer_offscreen",)),
    "opencv2/ml": ("opencv_ml", ("combiner",)),
    "opencv2/imgproc": ("opencv_imgproc", ("detector", "viewer_offscreen")),
    "sqlite3.h": ("SQLite::SQLite3", ("geopackage",)),
    "yaml-cpp/": ("yaml-cpp", ("codec",)),
    "zlib.h": ("ZLIB::ZLIB", ("codec",)),
    "libdeflate.h": ("LibDeflate::LibDeflate", ("codec",)),
    "png.h": ("PNG::PNG", ("codec",)),
    "jpeglib.h": ("JPEG::JPEG", ("codec",)),
    "jerror.h": ("JPEG::JPEG", ("codec",)),
    "nlohmann/": ("nlohmann_json::nlohmann_json", ("exports", "jobs", "apps")),
    "epoxy/": ("epoxy", ("viewer_offscreen",)),
    "pcre2.h": ("Pcre2::Pcre2", ("core",)),
    "xxhash.h": ("XxHash::headers", ("archive",)),
    "CLI/": ("CLI11::CLI11", ("apps",)),
    "histedit.h": ("LibEdit::LibEdit", ("apps",)),
    "mpi.h": ("MPI::MPI_CXX", ("apps",)),
}
# Of the C library.
SYSTEM = re.compile(r"^(dirent|dlfcn|fcntl|poll|unistd|sys/\w+)\.h$")

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.MULTILINE)
STANDARD = re.compile(r"^[a-z_0-9]+$")
MODULE = re.compile(r"hypermap_add_module\((\w+)(.*?)\)\s*$", re.MULTILINE | re.DOTALL)
APPS = re.compile(r"target_link_libraries\(hypermap_(?:commands|ranks_cli)\s(.*?)\)", re.DOTALL)
SECTION = re.compile(r"\b(SOURCES|ROOMS|PACKAGES|PUBLIC_LINK|PRIVATE_LINK)\b")
OURS = re.compile(r"hypermap::(\w+)")
DRAWN = re.compile(r"^    (\w+) -> ([\w, ]+)$", re.MULTILINE)


class Library:
    """What one CMake call declares: where it lies, what it may include, its rooms."""

    def __init__(self, name, folder, sections):
        self.name, self.folder = name, folder
        self.public = set(OURS.findall(sections.get("PUBLIC_LINK", "")))
        self.private = set(OURS.findall(sections.get("PRIVATE_LINK", "")))
        links = sections.get("PUBLIC_LINK", "") + " " + sections.get("PRIVATE_LINK", "")
        self.links = set(links.replace("$<BUILD_INTERFACE:", " ").replace(">", " ").split())
        self.rooms = {}
        for room in re.findall(r'"([^"]+)"', sections.get("ROOMS", "")):
            source, _, targets = room.partition("->")
            self.rooms[source.strip()] = set(targets.split())
        # In io a library is a room: its headers lie in hypermap/io/<room>.
        self.include = f"hypermap/io/{name}/" if folder.startswith("io/") else f"hypermap/{name}/"


def sections_of(body):
    parts = SECTION.split(body)
    return dict(zip(parts[1::2], parts[2::2]))


def libraries(root):
    found = {}
    for path in sorted(root.rglob("CMakeLists.txt")):
        folder = path.parent.relative_to(root).as_posix()
        if folder.split("/")[0] not in source_tree.FOLDERS:
            continue
        code = re.sub(r"#.*", "", source_tree.read(path))
        for match in MODULE.finditer(code):
            found[match.group(1)] = Library(match.group(1), folder, sections_of(match.group(2)))
        links = " ".join(match.group(1) for match in APPS.finditer(code))
        if links:
            found["apps"] = Library("apps", "apps", {"PRIVATE_LINK": links})
    return found


def room_of(library, path):
    """The room in which a file of a library with rooms lies; None in one without."""
    if not library.rooms:
        return None
    inside = path[len(library.folder) + 1:]
    inside = inside.removeprefix("src/").removeprefix("include/" + library.include)
    return inside.split("/")[0]


def own_include(library, path, target, known):
    """(arrow between libraries, arrow between rooms, problem), each None when there is none."""
    for other in known.values():
        if not target.startswith(other.include) or other.name == "apps":
            continue
        if other.name == library.name:
            return None, room_arrow(library, path, target[len(other.include):]), None
        if other.name in library.public | library.private:
            problem = None
            if "/include/" in path and other.name not in library.public:
                problem = f"{library.name} links {other.name} PRIVATE, so its headers may not include {target}"
            return (library.name, other.name), None, problem
        return None, None, f"{library.name} may not include {other.name} ({target})"
    return None, None, f"no library has {target}"


def room_arrow(library, path, inside):
    here, there = room_of(library, path), inside.split("/")[0]
    return None if here is None or here == there else (library.name, here, there)


def private_include(library, path, target):
    """A quoted include of a private header: beside the file, or from src/, then with its room."""
    if not library.rooms or "/" not in target or target.split("/")[0] not in library.rooms:
        return None
    return room_arrow(library, path, target)


def public_problem(bracket, target):
    if bracket == '"':
        return None if target.startswith("hypermap/") else f"public header includes private {target}"
    if STANDARD.match(target) or target.startswith(PUBLIC_EVERYWHERE):
        return None
    return f"third-party header in a public header: {target}"


def linked(library, known):
    """Targets that a library links, through the public links of others too."""
    found = set(library.links)
    for name in OURS.findall(" ".join(library.links)):
        if name in known:
            found |= linked(known[name], known)
    return found


def source_problem(library, bracket, target, known):
    """Of a third-party header: its place, and whether its target is linked."""
    if bracket == '"' or STANDARD.match(target) or SYSTEM.match(target):
        return None
    for prefix, (needed, owners) in THIRD_PARTY.items():
        if not target.startswith(prefix):
            continue
        if owners is not ANYWHERE and library.name not in owners:
            return f"{target} belongs to {', '.join(owners) or 'tests'} only"
        is_public = target.startswith(PUBLIC_EVERYWHERE)
        links = linked(library, known) if is_public else library.links
        return None if needed in links else f"{library.name} includes {target} and does not link {needed}"
    return f"{target} is of no third-party package that is known here"


class Findings:
    def __init__(self):
        self.problems, self.used = [], set()


def check_include(findings, known, library, name, line, match):
    bracket, target = match.groups()
    found = [source_problem(library, bracket, target, known)]
    if ".." in target.split("/"):
        found.append(f"relative include {target}")
    if "/include/" in name:
        found.append(public_problem(bracket, target))
    room = None
    if target.startswith("hypermap/"):
        arrow, room, problem = own_include(library, name, target, known)
        found.append(problem)
        findings.used.add(arrow)
    elif bracket == '"':
        room = private_include(library, name, target)
    if room is not None:
        findings.used.add(room)
        if room[2] not in library.rooms.get(room[1], ()):
            found.append(f"room {room[1]} of {library.name} may not include {room[2]} ({target})")
    findings.problems += [f"{name}:{line}: {problem}" for problem in found if problem]


def unused_arrows(known, used):
    problems = []
    for library in known.values():
        place = f"{library.folder}/CMakeLists.txt"
        for other in sorted(library.public | library.private):
            if (library.name, other) not in used:
                problems.append(f"{place}: nothing in {library.name} includes {other}")
        for room, targets in library.rooms.items():
            for other in sorted(targets):
                if (library.name, room, other) not in used:
                    problems.append(f"{place}: nothing in room {room} includes {other}")
    return problems


def direct(known):
    """The arrows between libraries without those that follow from others."""
    below = {name: library.public | library.private for name, library in known.items()}

    def reach(name):
        found = set()
        for other in below.get(name, ()):
            found |= {other} | reach(other)
        return found

    arrows = collections.OrderedDict()
    for name in sorted(below):
        implied = set().union(*(reach(other) for other in below[name])) if below[name] else set()
        if below[name] - implied:
            arrows[name] = sorted(below[name] - implied)
    return arrows


def drawing_problems(root, known):
    path = root / "ARCHITECTURE.md"
    if not path.exists():
        return []
    drawn = {source: sorted(targets.replace(",", " ").split())
             for source, targets in DRAWN.findall(source_tree.read(path))}
    return [f"ARCHITECTURE.md: the arrows of {name} are {', '.join(direct(known).get(name, ['none']))}, "
            f"drawn: {', '.join(drawn.get(name, ['none']))}"
            for name in sorted(set(drawn) | set(direct(known)))
            if drawn.get(name) != direct(known).get(name)]


def check(root):
    known = libraries(root)
    findings = Findings()
    for library in known.values():
        for path in source_tree.files(root, [library.folder], [".hpp", ".cpp"]):
            name = path.relative_to(root).as_posix()
            code = source_tree.without_comments(source_tree.read(path))
            for match in INCLUDE.finditer(code):
                check_include(findings, known, library, name, source_tree.line_of(code, match.start()), match)
            if library.rooms and room_of(library, name) not in library.rooms:
                findings.problems.append(f"{name}: lies in no declared room of {library.name}")
    return findings.problems + unused_arrows(known, findings.used) + drawing_problems(root, known)


def print_arrows(root):
    for name, targets in direct(libraries(root)).items():
        print(f"    {name} -> {', '.join(targets)}")


GOOD = {
    "core/CMakeLists.txt": 'hypermap_add_module(core SOURCES a.cpp ROOMS "base" "objects -> base" PUBLIC_LINK Eigen3::Eigen '
                           'PRIVATE_LINK $<BUILD_INTERFACE:PclLite::pcl>)\n',
    "projection/CMakeLists.txt": "hypermap_add_module(projection SOURCES a.cpp PUBLIC_LINK hypermap::core)\n",
    "io/codec/CMakeLists.txt": "hypermap_add_module(codec SOURCES a.cpp\n  PRIVATE_LINK hypermap::core)\n",
    "ARCHITECTURE.md": "text\n\n    projection -> core\n    codec -> core\n",
    "core/include/hypermap/core/base/a.hpp": "#include <Eigen/Core>\n#include <vector>\n",
    "core/src/base/a.cpp": '#include "hypermap/core/base/a.hpp"\n#include <pcl/point_types.h>\n',
    "core/src/objects/a.cpp": '#include "base/inner.hpp"\n',
    "projection/include/hypermap/projection/a.hpp": '#include "hypermap/core/base/a.hpp"\n',
    "io/codec/include/hypermap/io/codec/b.hpp": "#include <string>\n",
    "io/codec/src/b.cpp": '#include "hypermap/core/base/a.hpp"\n// #include "hypermap/apps/x.hpp"\n',
}
BAD = [
    ("core includes io", {"core/src/base/x.cpp": '#include "hypermap/io/codec/b.hpp"\n'}),
    ("an arrow that is not declared", {"io/codec/src/x.cpp": '#include "hypermap/projection/a.hpp"\n'}),
    ("a header uses a private arrow", {"io/codec/include/hypermap/io/codec/x.hpp": '#include "hypermap/core/base/a.hpp"\n'}),
    ("an unused arrow",
     {"io/codec/CMakeLists.txt": "hypermap_add_module(codec SOURCES a.cpp PRIVATE_LINK hypermap::core hypermap::projection)\n"}),
    ("rooms against their arrow", {"core/src/base/x.cpp": '#include "objects/inner.hpp"\n'}),
    ("public headers of rooms against their arrow",
     {"core/include/hypermap/core/base/x.hpp": '#include "hypermap/core/objects/y.hpp"\n'}),
    ("an unused arrow between rooms",
     {"core/CMakeLists.txt": 'hypermap_add_module(core SOURCES a.cpp ROOMS "base" "objects -> base" "other -> base")\n'}),
    ("a file in no room", {"core/src/x.cpp": "int x;\n"}),
    ("a drawing that is not the code's", {"ARCHITECTURE.md": "    projection -> core\n    codec -> core, projection\n"}),
    ("PCL in public", {"core/include/hypermap/core/base/x.hpp": "#include <pcl/point_types.h>\n"}),
    ("PCL outside core", {"io/codec/src/x.cpp": "#include <pcl/point_types.h>\n"}),
    ("a package that is not linked", {"core/src/base/x.cpp": "#include <boost/geometry.hpp>\n"}),
    ("a package that nobody knows", {"core/src/base/x.cpp": "#include <lz4.h>\n"}),
    ("private header in public", {"core/include/hypermap/core/base/x.hpp": '#include "x_detail.hpp"\n'}),
    ("upward path", {"core/src/base/x.cpp": '#include "../secret.hpp"\n'}),
]

if __name__ == "__main__":
    if "--arrows" in sys.argv[1:]:
        print_arrows(source_tree.ROOT)
        sys.exit(0)
    sys.exit(source_tree.main(__doc__, check, GOOD, BAD))
