#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Identifiers use the field's terms: those of the left column of the glossary in docs/CONVENTIONS.md, none of its last column.
Words of comments and of literals are free."""

import re
import sys

import source_tree

ANYWHERE = ""
OBJECTS = r"^core/(?:.*/)?(?:objects|association)/"

# Room (of the path), whole identifiers, the term instead. An identifier is one word of the code, however long.
TERMS = [
    (ANYWHERE, r"Object[Ll]edger\w*|Ledger\w*|ledger|ledger_\w+|parse_ledger\w*", "observation_log, ObservationLog"),
    (ANYWHERE, r"PointEvidence\w*", "OccupancyVotes"),
    (ANYWHERE, r"VisibilityVerdict|[Vv]erdicts?|kVerdict|verdict_\w+", "VisibilityResult, result"),
    (ANYWHERE, r"judges?|judge_\w+|file_judges|[Jj]udgements?|FileJudgement|\w*Judge", "evaluate_visibility, check_..."),
    (ANYWHERE, r"seen_now|seen_objects", "detected, detected_objects"),
    (ANYWHERE, r"weaken_unseen", "apply_missed_detections"),
    (ANYWHERE, r"Publication\w*|published_leaves|shown_objects", "confirmed, ConfirmationOptions"),
    (r"^(?:core|projection|io)/", r"publish(?:ed)?", "confirmed, ConfirmationOptions"),
    (ANYWHERE, r"lasting|is_lasting", "transient (and its negation)"),
    (ANYWHERE, r"learn|learn_\w+", "update_object"),
    (ANYWHERE, r"Sight|Sights|Sight[A-Z]\w*|kSight\w+|sights?|sight_lines?|LineFollower|AnswerLines",
     "OcclusionRay, RayPacket, RayOutcome"),
    (ANYWHERE, r"told|untold|kUntold", "kNoDepth, num_decided"),
    (ANYWHERE, r"see_(?:corners|lanes|brick|column)", "test_corners"),
    (ANYWHERE, r"meet_\w+|meets_\w+|\w+_meets?|first_meeting", "intersect, intersects, hits"),
    (ANYWHERE, r"\w*freest\w*", "fully_free"),
    (ANYWHERE, r"\w*[Hh]andovers?_?|hand_over_voxels", "PendingRelabel, pending_relabels_"),
    (ANYWHERE, r"keep_for_ever", "leak_after_failure"),
    (ANYWHERE, r"Upright|turn_upright|upright_from_\w+", "GravityAlignment, align_to_gravity"),
    (ANYWHERE, r"\w*[Pp]icture\w*", "Image in memory, image_file on disk"),
    (ANYWHERE, r"[Tt]hings?|\w+_things?|things?_\w+|k\w*Things?(?:[A-Z]\w*)?", "object, instance"),
    (ANYWHERE, r"TouchGrid", "ProximityGrid"),
    (OBJECTS, r"Body|Body[A-Z]\w*|body|bodies_?|body_of|make_body", "PointSet"),
    (OBJECTS, r"[Cc]ontacts?", "Overlap, measure_overlap"),
    (OBJECTS, r"twins?|twin_of|merge_twins|twice", "duplicate"),
    (OBJECTS, r"favourites?", "best_candidate"),
]
# A function of a name that a member may have.
CALLS = [(re.compile(r"(?<![\w.>:&])first_seen(?=\()"), "make_object")]

WORD = re.compile(r"\b[A-Za-z_]\w*")
RAW_STRING = re.compile(r'R"([^()\\\s]{0,16})\(.*?\)\1"', re.DOTALL)
# Names of tests are sentences.
TEST_NAME = re.compile(r"\b(?:TYPED_)?TEST(?:_[FP])?\([^)]*\)")
RULES = [(re.compile(room), re.compile(words), term) for room, words, term in TERMS]


def blanked(pattern, text):
    return pattern.sub(lambda match: re.sub(r"[^\n]", " ", match.group(0)), text)


def check(root):
    problems = []
    for path in source_tree.files(root, (*source_tree.FOLDERS, "tests"), [".hpp", ".cpp", ".inl"]):
        name = path.relative_to(root).as_posix()
        text = blanked(RAW_STRING, source_tree.read(path))
        code = blanked(TEST_NAME, source_tree.without_comments_and_strings(text))
        rules = [(words, term) for room, words, term in RULES if room.search(name)]
        for match in WORD.finditer(code):
            for words, term in rules:
                if words.fullmatch(match.group(0)):
                    problems.append(f"{name}:{source_tree.line_of(code, match.start())}: {match.group(0)}: "
                                    f"the term is {term}")
        for pattern, term in CALLS:
            problems += [f"{name}:{source_tree.line_of(code, match.start())}: {match.group(0)}: the term is {term}"
                         for match in pattern.finditer(code)]
    return problems


GOOD = {
    "core/src/objects/a.cpp": "// the body of a thing; nobody judges it\nObject make_object();\nauto x = object.first_seen;\n"
                              'auto key = "ledger";\nauto text = R"({"picture": "thing"})";\n',
    "core/src/geometry/half_edges.cpp": "int twin(int half_edge);\n",
    "io/src/furniture.cpp": "double body = 0.72;\nint nothing = 0;\n",
    "tests/core/a_test.cpp": "TEST(Image, APictureOfAThing) {\n}\n",
}
BAD = [
    ("a verdict", {"octree_semantic/src/x.cpp": "int verdict = 0;\n"}),
    ("a judge", {"io/src/x.cpp": "void judge_archive();\n"}),
    ("a sight line", {"octree_semantic/include/hypermap/octree_semantic/x.hpp": "struct SightLine {\n};\n"}),
    ("a kernel", {"octree_semantic/src/kernels/x.inl": "void see_corners();\n"}),
    ("a contact", {"core/src/objects/x.cpp": "struct Contact {\n};\n"}),
    ("a twin", {"core/src/association/x.cpp": "int twin_of(int id);\n"}),
    ("a picture", {"viewer_offscreen/src/x.hpp": "void draw(ColorImage& picture);\n"}),
    ("a thing", {"core/src/x.cpp": "bool is_thing = true;\n"}),
    ("a function", {"tests/core/x_test.cpp": "auto object = first_seen(observation, {});\n"}),
]

if __name__ == "__main__":
    sys.exit(source_tree.main(__doc__, check, GOOD, BAD))
