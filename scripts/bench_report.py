"""Writes the tables and plots of docs/BENCHMARKS.md from the benchmarks' JSON files.

Usage: bench_report.py ROOT

Between the lines `<!-- begin NAME -->` and `<!-- end NAME -->` of the document stands what this
script makes; all else is written by hand and stays.
"""
import json
import pathlib
import platform
import re
import subprocess
import sys

GROUPS = ("octree", "pipeline", "cloud", "snapshot", "occlusion", "archive", "scale", "crowd")


def load(folder):
    """Figures of the benchmarks that were run, by group and name (without the suffixes of Google Benchmark)."""
    figures = {}
    for group in GROUPS:
        path = folder / f"{group}.json"
        if not path.exists():
            continue
        rows = json.loads(path.read_text())["benchmarks"]
        figures[group] = {re.sub(r"/(iterations:\d+|manual_time)", "", row["name"]): row for row in rows
                          if not row.get("error_occurred")}
    return figures


def command_output(*command):
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout


def machine():
    cpu = re.search(r"Model name:\s*(.*)", command_output("lscpu")).group(1)
    cores = re.search(r"^CPU\(s\):\s*(\d+)", command_output("lscpu"), re.M).group(1)
    compiler = command_output("c++", "--version").splitlines()[0]
    system = re.search(r'PRETTY_NAME="(.*)"', pathlib.Path("/etc/os-release").read_text()).group(1)
    return f"{cpu}, {cores} logical cores, {platform.machine()}; {system}; {compiler}; build type Release."


class Target:
    """One row of the table of targets. `larger`: whether larger figures are better."""

    def __init__(self, what, value, must, goal, unit="", larger=True):
        self.what, self.value, self.must, self.goal = what, value, must, goal
        self.unit, self.larger = unit, larger

    def reaches(self, limit):
        return self.value >= limit if self.larger else self.value <= limit

    def row(self):
        if self.value is None:
            return f"| {self.what} | not run: data absent | {self.must:g} | {self.goal:g} | |"
        if self.reaches(self.goal):
            status = "goal"
        elif self.reaches(self.must):
            status = "must"
        else:
            status = "**missed**"
        digits = 4 if self.must < 1 else 3
        return f"| {self.what} | {self.value:.{digits}g}{self.unit} | {self.must:g} | {self.goal:g} | {status} |"


def targets(figures):
    octree, frame = figures["octree"], figures["pipeline"]
    occlusion, archive = figures["occlusion"], figures["archive"]

    def of(rows, name, counter):
        return rows[name][counter] if name in rows else None

    rows = []
    plan = [("exact_vs_insertPointCloud", "exact, times `insertPointCloud`",
             {"room/5cm": (5, 10), "kitchen/5cm": (4, 10), "room/2cm": (20, 30), "kitchen/2cm": (7, 15)}),
            ("discretize_vs_octomap_discretize", "discretize, times OctoMap's discretize",
             {"room/5cm": (12, 15), "kitchen/5cm": (5, 8), "room/2cm": (45, 50), "kitchen/2cm": (18, 25)}),
            ("projective_vs_insertPointCloud", "projective, times `insertPointCloud`",
             {"room/5cm": (130, 200), "kitchen/5cm": (80, 200)})]
    for name, what, scenes in plan:
        for scene, (must, goal) in scenes.items():
            rows.append(Target(f"{what}, {scene}", of(octree, f"{name}/{scene}", "cpu_ratio"), must, goal))
    for name, scenes in (("exact_vs_insertPointCloud", {s: 0.999 for s in plan[0][2]}),
                         ("discretize_vs_octomap_discretize", {s: 0.999 for s in plan[0][2]}),
                         ("projective_vs_insertPointCloud",
                          {"room/5cm": 0.99, "room/2cm": 0.99, "kitchen/5cm": 0.97, "kitchen/2cm": 0.97})):
        for scene, must in scenes.items():
            rows.append(Target(f"occupied IoU, {name.split('_')[0]}, {scene}",
                               of(octree, f"{name}/{scene}", "occupied_iou"), must, max(must, 0.99)))
    for name in ("exact_vs_insertPointCloud", "discretize_vs_octomap_discretize"):
        for scene in plan[0][2]:
            rows.append(Target(f"free IoU, {name.split('_')[0]}, {scene}",
                               of(octree, f"{name}/{scene}", "free_iou"), 0.99, 0.99))
    for scene in ("room/5cm", "kitchen/5cm", "room/2cm", "kitchen/2cm"):
        rows.append(Target(f"memory per occupied voxel with labels, {scene}",
                           of(octree, f"projective_vs_insertPointCloud/{scene}", "bytes_per_occupied"),
                           48, 32, " B", larger=False))
    rows.append(Target("whole frame, laboratory, 10 detections, 5 cm, one thread",
                       of(frame, "frame/laboratory/5cm/threads:1", "frame_ms"), 15, 10, " ms", larger=False))
    for resolution, voxels, objects, must in (("5cm", 10000, 100, 5), ("5cm", 1000000, 100, 5),
                                              ("5cm", 1000000, 10000, 5), ("2cm", 10000, 100, 25),
                                              ("2cm", 1000000, 10000, 25)):
        name = f"publish/{resolution}/voxels:{voxels}/objects:{objects}"
        rows.append(Target(f"publishing every frame, {resolution}, {voxels} voxels, {objects} objects",
                           of(figures["snapshot"], name, "more_percent"), must, must, " %", larger=False))
    for size in ("100k", "1M"):
        rows.append(Target(f"occlusion rays, {size} voxels",
                           of(occlusion, f"occlusion_rays/{size}", "million_per_s"), 9, 12, " M/s"))
    rows.append(Target("scene of 1M voxels built",
                       of(occlusion, "occlusion_rays/1M", "build_ms"), 10, 10, " ms", larger=False))
    rows.append(Target("archive over `.ot`, laboratory 5 cm",
                       of(archive, "archive/laboratory/5cm", "archive_over_ot"), 1, 1, larger=False))
    lab = archive["archive/laboratory/5cm"]
    rows.append(Target("load and save over the time to map, laboratory 5 cm",
                       (lab["load_ms"] + lab["save_ms"]) / lab["mapping_ms"], 1, 1, larger=False))
    return ["| what | measured | must | goal | reached |", "|---|---|---|---|---|"] + [row.row() for row in rows]


def table(rows, columns):
    """`columns`: title to counter and format."""
    lines = ["| benchmark | " + " | ".join(columns) + " |", "|---|" + "---|" * len(columns)]
    for name, row in rows.items():
        cells = [format(row[counter], spec) if counter in row else "" for counter, spec in columns.values()]
        lines.append(f"| {name} | " + " | ".join(cells) + " |")
    return lines


def octree_tables(figures):
    compared = {n: r for n, r in figures["octree"].items() if "_vs_" in n}
    by_size = {n: r for n, r in figures["octree"].items() if n.startswith("resolution/")}
    return (table(compared, {"times OctoMap": ("cpu_ratio", ".1f"), "ns a ray": ("ns_per_ray", ".1f"),
                             "OctoMap's": ("octomap_ns_per_ray", ".0f"), "occupied IoU": ("occupied_iou", ".4f"),
                             "free IoU": ("free_iou", ".4f"), "B per occupied": ("bytes_per_occupied", ".1f")}) +
            [""] +
            table(by_size, {"ns a ray": ("ns_per_ray", ".1f"), "occupied voxels": ("occupied", ".0f"),
                            "B per occupied": ("bytes_per_occupied", ".1f")}))


def frame_table(figures):
    return table(figures["pipeline"],
                 {"CPU ms": ("frame_ms", ".1f"), "wall ms": ("frame_wall_ms", ".1f"),
                  "smooth": ("smooth_ms", ".1f"), "segment": ("segment_ms", ".1f"),
                  "associate": ("associate_ms", ".1f"), "integrate": ("integrate_ms", ".1f"), "visibility": ("visibility_ms", ".2f"),
                  "detections": ("detections", ".1f")})


def cloud_table(figures):
    return table(figures["cloud"],
                 {"CPU ms a scan": ("scan_ms", ".1f"), "points": ("points", ".0f"),
                  "working MB": ("working_mb", ".1f"), "occupied voxels": ("occupied_voxels", ".0f"),
                  "free voxels": ("free_voxels", ".0f"), "map MB": ("map_mb", ".1f")})


def snapshot_tables(figures):
    published = {n: r for n, r in figures["snapshot"].items() if n.startswith("publish/")}
    taken = {n: r for n, r in figures["snapshot"].items() if n.startswith("snapshot/")}
    return (table(published,
                  {"CPU ms a frame": ("frame_ms", ".1f"), "published": ("published_ms", ".1f"),
                   "more, %": ("more_percent", ".1f"), "voxels": ("voxels", ".0f"),
                   "octree MB": ("alone_mb", ".1f"), "published MB": ("published_mb", ".1f")}) +
            [""] +
            table(taken, {"ns": ("cpu_time", ".0f")}))


def occlusion_table(figures):
    return table(figures["occlusion"],
                 {"M answers/s": ("million_per_s", ".1f"), "times castRay": ("ratio", ".0f"),
                  "build ms": ("build_ms", ".1f"), "update ms": ("update_ms", ".2f"), "bricks": ("bricks", ".0f")})


def archive_table(figures):
    return table(figures["archive"],
                 {"archive kB": ("archive_kb", ".0f"), "`.ot` kB": ("ot_kb", ".0f"), "save ms": ("save_ms", ".0f"),
                  "load ms": ("load_ms", ".0f"), "mapping ms": ("mapping_ms", ".0f")})


TENTHS = [f"tenth{i:02d}" for i in range(1, 11)]


def scale_table(figures):
    lines = ["| way | figure | " + " | ".join(str(i) for i in range(1, 11)) + " |", "|---|---|" + "---|" * 10]
    for name, row in figures["scale"].items():
        for title, counter, spec in (("CPU ms a frame", "ms_", ".1f"), ("octree MB", "octree_mb_", ".1f"),
                                     ("resident MB", "rss_mb_", ".0f")):
            lines.append(f"| {name} | {title} | " +
                         " | ".join(format(row[counter + tenth], spec) for tenth in TENTHS) + " |")
    return lines


def crowd_table(figures):
    return table(figures["crowd"],
                 {"objects": ("objects", ".0f"), "in range": ("in_range", ".0f"), "associate ms": ("associate_ms", ".1f"),
                  "visibility ms": ("visibility_ms", ".1f"), "confirm ms": ("confirm_ms", ".0f"),
                  "kB an object": ("kb_an_object", ".2f"), "save objects CPU s": ("objects_save_s", ".1f"),
                  "save all CPU s": ("save_s", ".1f"), "save all s": ("save_wall_s", ".1f"),
                  "load CPU s": ("load_s", ".1f"), "load s": ("load_wall_s", ".1f"), "archive MB": ("archive_mb", ".1f")})


def pyplot():
    """Matplotlib without a screen; who only wants the tables does without it."""
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot
    return matplotlib.pyplot


def plot_resolution(plt, figures, path):
    fig, axes = plt.subplots(figsize=(6.4, 4.0), layout="constrained")
    for mode, marker in (("projective", "o"), ("discretize", "s"), ("exact", "^")):
        sizes = (1, 2, 5, 10)
        rows = [figures["octree"][f"resolution/{mode}/cm/{size}"] for size in sizes]
        axes.loglog(sizes, [row["ns_per_ray"] for row in rows], marker=marker, label=mode)
    for name, label in (("exact_vs_insertPointCloud", "OctoMap"),
                        ("discretize_vs_octomap_discretize", "OctoMap, discretize")):
        points = [(size, figures["octree"][f"{name}/room/{size}cm"]["octomap_ns_per_ray"]) for size in (2, 5)]
        axes.loglog(*zip(*points), linestyle="--", marker="x", label=label)
    axes.set_xticks((1, 2, 5, 10), labels=("1", "2", "5", "10"))
    axes.minorticks_off()
    axes.set_xlabel("edge of a voxel, cm")
    axes.set_ylabel("CPU time of a ray, ns")
    axes.set_title("Cost against resolution: the simulated room, 640 x 480, to 5 m, one thread")
    axes.title.set_fontsize(9)
    axes.grid(True, which="major", alpha=0.3)
    axes.legend(fontsize=8)
    fig.savefig(path, dpi=110)


def plot_scale(plt, figures, path):
    fig, (cost, memory) = plt.subplots(1, 2, figsize=(9.0, 3.6), layout="constrained")
    for name, row in figures["scale"].items():
        label = name.split("/")[0].replace("_", " ")
        octree = [row["octree_mb_" + tenth] for tenth in TENTHS]
        cost.plot(range(1, 11), [row["ms_" + tenth] for tenth in TENTHS], marker="o", label=label)
        memory.plot(range(1, 11), octree, marker="o", label=f"{label}, octree")
        memory.plot(range(1, 11), [row["rss_mb_" + tenth] for tenth in TENTHS], marker="x", linestyle="--",
                    label=f"{label}, process")
    for axes, title in ((cost, "CPU time of a frame, ms"), (memory, "memory, MB")):
        axes.set_xlabel("tenth of the frames")
        axes.set_ylabel(title)
        axes.set_ylim(bottom=0)
        axes.grid(True, alpha=0.3)
        axes.legend(fontsize=8)
    fig.suptitle("Cost against the size of the map: 10,000 frames of 160 x 120", fontsize=10)
    fig.savefig(path, dpi=110)


# The tables of the document: what each is made of, and by what.
TABLES = {"targets": (GROUPS, targets), "octree": (("octree",), octree_tables), "frame": (("pipeline",), frame_table),
          "cloud": (("cloud",), cloud_table), "snapshot": (("snapshot",), snapshot_tables),
          "occlusion": (("occlusion",), occlusion_table), "archive": (("archive",), archive_table),
          "scale": (("scale",), scale_table), "crowd": (("crowd",), crowd_table)}


def filled(text, figures):
    """The document with those tables made anew for which there are figures."""
    blocks = {"machine": [machine()]}
    for name, (groups, lines_of) in TABLES.items():
        if all(group in figures for group in groups):
            blocks[name] = lines_of(figures)
    for name, lines in blocks.items():
        pattern = re.compile(rf"(<!-- begin {name} -->\n).*?(<!-- end {name} -->)", re.S)
        if not pattern.search(text):
            sys.exit(f"bench_report: the document has no place for `{name}`")
        made = "\n".join(lines) + "\n"
        text = pattern.sub(lambda match: match.group(1) + made + match.group(2), text)
    return text


def main():
    root = pathlib.Path(sys.argv[1])
    figures = load(root / "build" / "bench")
    document = root / "docs" / "BENCHMARKS.md"
    text = filled(document.read_text(), figures)
    for group, plot, image in (("octree", plot_resolution, "cost_by_resolution.png"),
                               ("scale", plot_scale, "cost_by_map_size.png")):
        if group in figures:
            plot(pyplot(), figures, root / "docs" / "pictures" / image)
    document.write_text(text)
    print(f"{document} is up to date with " + ", ".join(figures))


if __name__ == "__main__":
    main()
