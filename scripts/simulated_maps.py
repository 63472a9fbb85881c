# SPDX-License-Identifier: BSD-3-Clause
"""What the scripts of this folder share that map simulated sequences and compare the maps."""

import json
import math
import shutil
import statistics
import subprocess
import sys

STUDENT_95 = {1: 12.71, 2: 4.30, 3: 3.18, 4: 2.78, 5: 2.57, 6: 2.45, 7: 2.36, 8: 2.31, 9: 2.26}


def run(program, *arguments):
    """What it prints; ends with what it says where it fails."""
    done = subprocess.run([program, *map(str, arguments)], check=False, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(done.stderr.strip() or f"{program} {arguments[0]}: ended with {done.returncode}")
    return done.stdout


def simulated(program, folder, seed, *options):
    run(program, "simulate", "--seed", seed, "--output", folder, *options)


def kept_sequence(program, folder, scene, seed, *options):
    """The scene's sequence in `folder`; one that is there is not made again."""
    data = folder / f"{scene}-{seed}"
    if not data.exists():
        making = folder / f"making-{scene}-{seed}"
        shutil.rmtree(making, ignore_errors=True)  # of a run that was interrupted
        simulated(program, making, seed, "--scene", scene, *options)
        making.rename(data)
    return data


def mapped(program, preset, folder, archive, *options, data=None):
    """Maps the sequence `data`, the folder itself where none is given; returns what `--stats` says, which stays there."""
    stats = f"{folder}/stats.json"
    run(program, "map", "--input", data or folder, "--output", archive, "--preset", preset, "--stats", stats, *options)
    with open(stats, encoding="utf-8") as file:
        return json.load(file)


def evaluated(program, archive, truth, *options):
    return json.loads(run(program, "eval", "--map", archive, "--truth", truth, "--json", *options))


def with_interval(values):
    """The mean and its 95 % interval (Student's t)."""
    mean = statistics.mean(values)
    if len(values) - 1 not in STUDENT_95:
        return f"{mean:.3f}"
    half = STUDENT_95[len(values) - 1] * statistics.stdev(values) / math.sqrt(len(values))
    return f"{mean:.3f} +- {half:.3f}"
