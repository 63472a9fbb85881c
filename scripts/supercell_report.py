"""What scripts/supercells measured: chooses settings, writes the tables of docs/RESULTS.md and a plot.

Usage: supercell_report.py ROOT [--choose FILE]

Between the lines `<!-- begin NAME -->` and `<!-- end NAME -->` of the document stands what this
script makes; all else is written by hand and stays.
"""
import collections
import json
import pathlib
import re
import statistics
import sys

from signed_rank import p_greater

METHODS = ("SEVDS", "SEVDS, any K", "cell-weighted", "SEEDS", "SLIC", "SLICO", "LSC")
SCENES = ("one table", "corner table", "two tables", "crowded")
THEIRS = ("SEEDS", "SLIC", "SLICO", "LSC")
SMALLEST_LEVEL = 3
CURVE_SEED = 101
#         key, title, whether larger is better, format
METRICS = (("icv", "intra-cluster variation", False, ".4f"), ("ev", "explained variation", True, ".4f"),
           ("ue", "undersegmentation error", False, ".5f"), ("br", "boundary recall", True, ".5f"),
           ("pureness", "pureness", True, ".4f"))


def rows_of(folder, pattern):
    return [json.loads(line) for path in sorted(folder.glob(pattern)) for line in path.read_text().splitlines()]


def choose(rows):
    """Of each method, the number of the setting with the least mean of (1 - BR) + UE among those that
    gave the wanted number of segments everywhere."""
    costs = collections.defaultdict(list)
    runs = {(row["scene"], row["seed"]) for row in rows}
    for row in rows:
        if "count" in row:
            costs[row["method"], row["setting"]].append(1 - row["br"] + row["ue"])
    best = {}
    for (method, setting), values in costs.items():
        if len(values) < len(runs):
            continue
        cost = statistics.fmean(values)
        if method not in best or cost < best[method][0]:
            best[method] = (cost, setting)
    return [best[method][1] for method in METHODS]


class Measured:
    """Rows by scene and method, paired by seed."""

    def __init__(self, rows):
        self.rows = {(r["scene"], r["method"], r["seed"]): r for r in rows if "count" in r}
        self.seeds = sorted({r["seed"] for r in rows})

    def values(self, scene, method, key):
        return [self.rows[scene, method, seed][key] for seed in self.seeds if (scene, method, seed) in self.rows]

    def comparison(self, scene, method, other, key, larger_is_better):
        """How the method compares with the other one at 95 %, over seeds that both have."""
        seeds = [s for s in self.seeds if (scene, method, s) in self.rows and (scene, other, s) in self.rows]
        ours = [self.rows[scene, method, s][key] for s in seeds]
        theirs = [self.rows[scene, other, s][key] for s in seeds]
        if not larger_is_better:
            ours, theirs = theirs, ours
        if p_greater(ours, theirs) < 0.05:
            return "better"
        return "**worse**" if p_greater(theirs, ours) < 0.05 else "alike"


def means_table(measured):
    lines = ["| scene | method | segments | " + " | ".join(title for _, title, _, _ in METRICS) + " | CPU s |",
             "|---|---|---|" + "---|" * (len(METRICS) + 1)]
    for scene in SCENES:
        for method in METHODS:
            counts = measured.values(scene, method, "count")
            if not counts:
                lines.append(f"| {scene} | {method} | none |" + " |" * (len(METRICS) + 1))
                continue
            cells = [format(statistics.fmean(measured.values(scene, method, key)), spec) for key, _, _, spec in METRICS]
            seconds = statistics.fmean(measured.values(scene, method, "seconds"))
            missing = f" ({len(counts)} seeds)" if len(counts) < len(measured.seeds) else ""
            lines.append(f"| {scene} | {method} | {statistics.fmean(counts):.0f}{missing} | " + " | ".join(cells) +
                         f" | {seconds:.3f} |")
    return lines


def targets_table(measured):
    lines = ["| target | " + " | ".join(SCENES) + " |", "|---|" + "---|" * len(SCENES)]

    def add(what, method, others, key, larger):
        cells = []
        for scene in SCENES:
            found = [measured.comparison(scene, method, other, key, larger) for other in others]
            told = found if len(others) > 1 and len(set(found)) > 1 else found[:1]
            cells.append(", ".join(told))
        lines.append(f"| {what} | " + " | ".join(cells) + " |")

    for method in METHODS[:3]:
        add(f"{method}: intra-cluster variation against SEEDS, SLIC, SLICO, LSC", method, THEIRS, "icv", False)
    for method in METHODS[:3]:
        add(f"{method}: undersegmentation error against SEEDS", method, ("SEEDS",), "ue", False)
        add(f"{method}: boundary recall against SEEDS", method, ("SEEDS",), "br", True)

    def ratio(what, method, other):
        cells = []
        for scene in SCENES:
            times = [statistics.fmean(measured.values(scene, m, "seconds")) for m in (method, other)]
            cells.append(f"{times[0] / times[1]:.2f}")
        lines.append(f"| {what} | " + " | ".join(cells) + " |")

    ratio("SEVDS: CPU time over that of SEEDS, at most 3 wanted", "SEVDS", "SEEDS")
    ratio("SEVDS, any K: the same", "SEVDS, any K", "SEEDS")
    ratio("cell-weighted: CPU time over that of LSC, at most 1 wanted", "cell-weighted", "LSC")
    return lines


def settings_table(rows):
    texts = {row["method"]: row["text"] for row in rows}
    return ["| method | chosen |", "|---|---|"] + [f"| {method} | {texts[method]} |" for method in METHODS]


def plot(rows, path):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    colours = ("tab:blue", "tab:orange", "tab:green", "tab:red")
    fig, axes = plt.subplots(2, len(METRICS), figsize=(19, 8.5), layout="constrained")
    measured = Measured([r for r in rows if r["level"] == SMALLEST_LEVEL])
    for column, (key, title, _, _) in enumerate(METRICS):
        boxes, curves = axes[0][column], axes[1][column]
        for s, scene in enumerate(SCENES):
            drawn = boxes.boxplot([measured.values(scene, m, key) for m in METHODS], widths=0.16,
                                  positions=[m + 0.2 * (s - 1.5) for m in range(len(METHODS))], patch_artist=True,
                                  flierprops={"markersize": 2}, medianprops={"color": "black"}, manage_ticks=False)
            for box in drawn["boxes"]:
                box.set_facecolor(colours[s])
        boxes.set_xticks(range(len(METHODS)), METHODS, rotation=60, fontsize=8)
        boxes.set_title(title)
        for method in METHODS:
            points = collections.defaultdict(list)
            for row in rows:
                if row["method"] == method and "count" in row and row["seed"] == CURVE_SEED:
                    points[row["level"]].append(row)
            levels = sorted(points)
            curves.plot([statistics.fmean(r["count"] for r in points[level]) for level in levels],
                        [statistics.fmean(r[key] for r in points[level]) for level in levels], marker="o",
                        markersize=3, label=method)
        curves.set_xscale("log")
        curves.set_xlabel("segments")
        for panel in (boxes, curves):
            panel.grid(True, alpha=0.3)
    handles = [plt.Line2D([], [], color=c, linewidth=6, label=s) for c, s in zip(colours, SCENES)]
    axes[0][0].legend(handles=handles, fontsize=7)
    axes[1][0].legend(fontsize=7)
    fig.savefig(path, dpi=80)


def main():
    root = pathlib.Path(sys.argv[1])
    folder = root / "build" / "supercells"
    if sys.argv[2:3] == ["--choose"]:
        chosen = choose(rows_of(folder, "tune_*.jsonl"))
        pathlib.Path(sys.argv[3]).write_text("".join(f"{number}\n" for number in chosen))
        return
    rows = rows_of(folder, "compare_*.jsonl")
    measured = Measured([r for r in rows if r["level"] == SMALLEST_LEVEL])
    document = root / "docs" / "RESULTS.md"
    text = document.read_text()
    for name, lines in (("supercell-settings", settings_table(rows)), ("supercell-targets", targets_table(measured)),
                        ("supercell-means", means_table(measured))):
        pattern = re.compile(rf"(<!-- begin {name} -->\n).*?(<!-- end {name} -->)", re.S)
        if not pattern.search(text):
            sys.exit(f"supercell_report: the document has no place for `{name}`")
        made = "\n".join(lines) + "\n"
        text = pattern.sub(lambda match: match.group(1) + made + match.group(2), text)
    document.write_text(text)
    plot(rows, root / "docs" / "pictures" / "supercell_metrics.png")
    print(f"{document} is up to date")


if __name__ == "__main__":
    main()
