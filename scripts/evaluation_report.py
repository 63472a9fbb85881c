#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What the reports of scripts/evaluate say together: of one scene line by line, of several as a table.

Usage: evaluation_report.py FOLDER | --table FOLDER..., each folder of one scene: SEED.json of `hypermap eval --json`, and
together.json, whose calibration is that over all seeds."""

import collections
import json
import pathlib
import sys


def shown(value, digits=3):
    return "-" if value is None else f"{value:.{digits}f}"


def mean(values):
    values = [value for value in values if value is not None]
    return sum(values) / len(values) if values else None


def least(values):
    return min((value for value in values if value is not None), default=None)


class Scene:
    """The reports of one scene, by seed."""

    def __init__(self, folder):
        self.name = folder.name
        self.reports = {path.stem: json.loads(path.read_text()) for path in sorted(folder.glob("[0-9]*.json"))}
        self.calibration = json.loads((folder / "together.json").read_text())["calibration"]
        self.rows = [report["one_to_one"] for report in self.reports.values()]
        self.voxels = [report["voxels"] or {} for report in self.reports.values()]
        self.occupancy = [report.get("occupancy") or {} for report in self.reports.values()]

    def mean(self, key):
        return mean(row[key] for row in self.rows)

    def voxel_mean(self, key):
        return mean(voxels.get(key) for voxels in self.voxels)

    def occupancy_mean(self, key):
        return mean(grid.get(key) for grid in self.occupancy)

    def duplicates(self):
        return sum(row["duplicates"] for row in self.rows)

    def worst_jaccard(self):
        return least(row["worst_jaccard_in_place"] for row in self.rows)


def print_seeds(scene):
    for (seed, _), row, voxels in zip(scene.reports.items(), scene.rows, scene.voxels):
        print(f"{seed}: F1 {shown(row['f1'])}, precision {shown(row['precision'])}, recall {shown(row['recall'])}, "
              f"distance {shown(row['distance_m'])} m, Jaccard {shown(row['jaccard_in_place'])}, "
              f"worst {shown(row['worst_jaccard_in_place'])}, half seen {shown(row['seen_jaccard_in_place'])}, "
              f"box IoU {shown(row['box_iou'])}, duplicates {row['duplicates']}, "
              f"labels: precision {shown(voxels.get('precision'))}, recall {shown(voxels.get('recall'))}, "
              f"wrong class {shown(voxels.get('wrong_class_share'))}")


def print_means(scene):
    f1 = [row["f1"] for row in scene.rows]
    print(f"{scene.name}: F1 mean {shown(mean(f1))}, worst {shown(least(f1))}; "
          f"Jaccard mean {shown(scene.mean('jaccard_in_place'))}, worst {shown(scene.worst_jaccard())}, "
          f"half seen {shown(scene.mean('seen_jaccard_in_place'))}; box IoU {shown(scene.mean('box_iou'))}; "
          f"covered: footprints {shown(scene.mean('footprint_covered'))}, "
          f"surfaces {shown(scene.voxel_mean('surface_covered'))}; "
          f"labels: precision {shown(scene.voxel_mean('precision'))}, recall {shown(scene.voxel_mean('recall'))}, "
          f"wrong class {shown(scene.voxel_mean('wrong_class_share'))}; "
          f"free cells: precision {shown(scene.occupancy_mean('free_precision'))}, "
          f"recall {shown(scene.occupancy_mean('free_recall'))}; duplicates {scene.duplicates()}; "
          f"excluded {sum(row['excluded'] for row in scene.rows)}, "
          f"rarely seen {sum(row['rarely_seen'] for row in scene.rows)}")
    for key, name in (("best_class", "P(best class)"), ("real", "P(real)")):
        report = scene.calibration[key]
        low, high = report["interval_95"] or (None, None)
        print(f"{name}: calibration error {shown(report['expected_error'])} ({shown(low)} .. {shown(high)}), "
              f"log loss {shown(report['log_loss'])}, {report['n']} objects")


def sum_of_voxels(scene, name, key):
    return sum(voxels.get("classes", {}).get(name, {}).get(key, 0) for voxels in scene.voxels)


def confusion(scene, name):
    """The class that most voxels of this one wrongly bear, and which share of its voxels they are."""
    counts = collections.Counter()
    for voxels in scene.voxels:
        counts.update(voxels.get("classes", {}).get(name, {}).get("confused_for", {}))
    true = sum_of_voxels(scene, name, "true")
    if not counts or not true:
        return "-"
    worst, count = max(sorted(counts.items()), key=lambda item: item[1])
    return f"{worst} {count / true:.2f}"


def share(part, whole):
    return part / whole if whole else None


def print_classes(scene):
    classes = collections.defaultdict(list)
    for report in scene.reports.values():
        for name, metrics in report["classes"].items():
            classes[name].append(metrics["one_to_one"])
    print("class: found of true, false, F1, distance m, Jaccard, box IoU; labels: precision, recall, most confused for")
    for name, metrics in sorted(classes.items()):
        true, found = sum(m["truths"] for m in metrics), sum(m["matched"] for m in metrics)
        false = sum(m["objects"] - m["matched"] for m in metrics)
        if true + found + false == 0:
            continue  # a class that the detector has no word for
        precision = share(sum_of_voxels(scene, name, "right"), sum_of_voxels(scene, name, "labelled"))
        recall = share(sum_of_voxels(scene, name, "found"), sum_of_voxels(scene, name, "true"))
        print(f"{name}: {found} of {true}, {false}, {shown(2 * found / (true + found + false))}, "
              f"{shown(mean(m['distance_m'] for m in metrics))}, {shown(mean(m['jaccard_in_place'] for m in metrics))}, "
              f"{shown(mean(m['box_iou'] for m in metrics))}; {shown(precision, 2)}, {shown(recall, 2)}, "
              f"{confusion(scene, name)}")


HEADING = ["scene", "F1", "worst", "precision", "recall", "distance m", "Jaccard", "worst", "half seen", "box IoU",
           "duplicates", "label precision", "label recall", "wrong class", "free precision", "free recall", "error P(class)",
           "error P(real)"]


def print_table(scenes):
    print("| " + " | ".join(HEADING) + " |")
    print("|---" * len(HEADING) + "|")
    for scene in scenes:
        cells = [scene.name, shown(scene.mean("f1")), shown(least(row["f1"] for row in scene.rows)),
                 shown(scene.mean("precision")), shown(scene.mean("recall")), shown(scene.mean("distance_m")),
                 shown(scene.mean("jaccard_in_place")), shown(scene.worst_jaccard()),
                 shown(scene.mean("seen_jaccard_in_place")), shown(scene.mean("box_iou")), str(scene.duplicates()),
                 shown(scene.voxel_mean("precision")), shown(scene.voxel_mean("recall")),
                 shown(scene.voxel_mean("wrong_class_share")),
                 shown(scene.occupancy_mean("free_precision")), shown(scene.occupancy_mean("free_recall")),
                 shown(scene.calibration["best_class"]["expected_error"]),
                 shown(scene.calibration["real"]["expected_error"])]
        print("| " + " | ".join(cells) + " |")


def main(arguments):
    if arguments and arguments[0] == "--table":
        print_table([Scene(pathlib.Path(folder)) for folder in arguments[1:]])
        return
    scene = Scene(pathlib.Path(arguments[0]))
    print_seeds(scene)
    print_means(scene)
    print_classes(scene)


if __name__ == "__main__":
    main(sys.argv[1:])
