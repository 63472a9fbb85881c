# SPDX-License-Identifier: BSD-3-Clause
"""What the commands of the fault tests read."""

import functools
import pathlib
import shutil
import tempfile

from program import run
from tiny_dataset import make_dataset


class Inputs:
    """What commands read; what takes a while is made when somebody asks for it."""

    @staticmethod
    def make():
        Inputs.folder = pathlib.Path(tempfile.mkdtemp(prefix="hypermap-faults-"))
        Inputs.tiny = make_dataset(Inputs.folder / "tiny")

    @staticmethod
    def remove():
        shutil.rmtree(Inputs.folder)

    @staticmethod
    def succeed(*arguments):
        result = run(*arguments)
        assert result.returncode in (0, 1), result.stderr
        return arguments[-1]

    @staticmethod
    @functools.cache
    def simulation(num_frames, seed=1):
        return Inputs.succeed("simulate", "--frames", num_frames, "--seed", seed, "--detector", "perfect", "--output",
                              Inputs.folder / f"lab-{num_frames}-{seed}")

    @staticmethod
    @functools.cache
    def objects(resolution, seed=1):
        """A map with two objects."""
        return Inputs.succeed("map", "--input", Inputs.simulation(12, seed), "--resolution", resolution, "--output",
                              Inputs.folder / f"{resolution}-{seed}.hmap")
