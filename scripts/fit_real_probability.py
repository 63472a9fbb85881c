#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Fits P(real), `real_probability` of the library, to maps whose objects were held against the truth.

Usage: fit_real_probability.py FOLDER, with pairs of a map NAME.hmap and the report NAME.json that `hypermap eval --json` writes of it.
Prints a coefficient a line: of a constant; of the natural logarithms of the detections, of the directions from which
they came, and of 1 + the visibility in frames without one; of the share of detections that name another class than their
detector does most often; and of whether there is one detection alone. All as the observation log of an object sums it up.
What cannot be fitted to is said in a sentence that names folder or file, and the rule; exit status 2."""

import collections
import json
import math
import pathlib
import sys
import zipfile

class UnfitInput(Exception):
    """Input that breaks a rule; its text names folder or file, and the rule."""


DETECTION = 0
NAMES = ("intercept", "per detections", "per directions", "per missed visibility", "per named otherwise",
         "detected once")


def num_of_usual_names(detections):
    """Detections of the classes that each detector named most often."""
    counts = collections.Counter()
    for row in detections:
        counts[row[1], row[2]] += row[4]
    most = {}
    for (detector, _), count in counts.items():
        most[detector] = max(most.get(detector, 0), count)
    return sum(most.values())


def features(log):
    """Of one observation log as objects.jsonl has it; None when nothing was ever detected. A row of its sums is: kind,
    detector, class, bearing bin, count, sum of scores, sum of effects, last frame."""
    detections = [row for row in log["summaries"] if row[0] == DETECTION]
    missed = sum(row[5] for row in log["summaries"] if row[0] != DETECTION)
    if not detections:
        return None
    count = sum(row[4] for row in detections)
    directions = len({row[3] for row in detections})
    named_otherwise = 1.0 - num_of_usual_names(detections) / count
    return [1.0, math.log(count), math.log(directions), math.log1p(missed), named_otherwise, 1.0 if count == 1 else 0.0]


def read_by(reader, path, kind):
    """What `reader` makes of a file that should be of this kind."""
    try:
        return reader(path)
    except OSError as error:
        raise UnfitInput(f"{path}: cannot be read: {error.strerror or error}") from error
    except (ValueError, KeyError, TypeError, IndexError, zipfile.BadZipFile) as error:
        raise UnfitInput(f"{path}: must be {kind}: {error}") from error


def truths_of(report_path):
    """Whether each object of a report is real, by its id."""
    return {row["id"]: row["truth"] is not None for row in json.loads(report_path.read_text())["objects"]}


def features_of(map_path):
    """Features of each object of a map, by its id."""
    with zipfile.ZipFile(map_path) as archive:
        head, *lines = archive.read("objects.jsonl").decode().splitlines()
    objects = map(json.loads, lines[:json.loads(head)["num_objects"]])  # Their voted cells follow, a line each.
    return {one["id"]: features(one["ledger"]) for one in objects}


def cases_of(map_path, report_path):
    """Features and whether the object is real, of each object of a map that was ever detected."""
    is_real = read_by(truths_of, report_path, "a report of `hypermap eval --json`")
    if not map_path.exists():
        raise UnfitInput(f"{map_path.parent}: each report needs its map beside it: {report_path.name} has no {map_path.name}")
    known = read_by(features_of, map_path, "a map with objects")
    return [(x, is_real[number]) for number, x in known.items() if number in is_real and x is not None]


def solved(matrix, right):
    """The solution of a system of linear equations, by elimination with pivots."""
    rows = [list(row) + [value] for row, value in zip(matrix, right)]
    n = len(rows)
    for i in range(n):
        pivot = max(range(i, n), key=lambda k: abs(rows[k][i]))
        rows[i], rows[pivot] = rows[pivot], rows[i]
        for k in range(n):
            if k != i:
                factor = rows[k][i] / rows[i][i]
                rows[k] = [a - factor * b for a, b in zip(rows[k], rows[i])]
    return [row[n] / row[i] for i, row in enumerate(rows)]


def fitted(cases, penalty=0.01):
    """Coefficients of the logistic regression with the least penalised loss, by Newton's method."""
    n = len(cases[0][0])
    weights = [0.0] * n
    for _ in range(50):
        gradient = [penalty * w for w in weights]
        curvature = [[penalty if i == k else 0.0 for k in range(n)] for i in range(n)]
        for x, truth in cases:
            p = 1.0 / (1.0 + math.exp(-max(-30.0, min(30.0, sum(w * v for w, v in zip(weights, x))))))
            for i in range(n):
                gradient[i] += (p - truth) * x[i]
                for k in range(n):
                    curvature[i][k] += p * (1.0 - p) * x[i] * x[k]
        step = solved(curvature, gradient)
        weights = [w - s for w, s in zip(weights, step)]
        if max(abs(s) for s in step) < 1e-9:
            break
    return weights


def all_cases(folder):
    """Of all pairs in a folder. There are real objects and others, or UnfitInput."""
    if not folder.is_dir():
        raise UnfitInput(f"{folder}: must be a folder")
    reports = sorted(folder.glob("*.json"))
    if not reports:
        raise UnfitInput(f"{folder}: needs a report or more, NAME.json beside the map NAME.hmap; has none")
    cases = [case for report in reports for case in cases_of(report.with_suffix(".hmap"), report)]
    real = sum(truth for _, truth in cases)
    if real in (0, len(cases)):
        raise UnfitInput(f"{folder}: needs detected objects that are real and such that are not; "
                         f"has {real} and {len(cases) - real}")
    return cases


def main(folder):
    cases = all_cases(pathlib.Path(folder))
    real = sum(truth for _, truth in cases)
    print(f"{len(cases)} objects, {real} of them real")
    for name, weight in zip(NAMES, fitted(cases)):
        print(f"{name}: {weight:.2f}")


if __name__ == "__main__":
    if len(sys.argv) != 2 or sys.argv[1] in ("-h", "--help"):
        print(__doc__)
        sys.exit(0 if len(sys.argv) == 2 else 4)
    try:
        main(sys.argv[1])
    except UnfitInput as fault:
        print(f"fit_real_probability: {fault}", file=sys.stderr)
        sys.exit(2)
