#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What is learnt or detected, with a fault of the system or a kill at the program's calls. See faults_test.py.

Usage: detections_faults_test.py PROGRAM [unittest args]"""

import unittest

from faults import FaultCase, OLD
from faults_inputs import Inputs
from program import DATA

NUM_FAULTS = 4


def setUpModule():
    Inputs.make()


def tearDownModule():
    Inputs.remove()


class Detections(FaultCase):
    MODEL = DATA / "models/yolox_nano/yolox_nano.onnx"

    @unittest.skipUnless(MODEL.exists(), "recorded data are absent")
    def test_what_a_model_detects(self):
        output = self.out / "found.json"
        command = ["detect", "--input", Inputs.simulation(1), "--max-frames", 1, "--model", self.MODEL, "--output", output]
        self.check_faults(lambda: output.write_bytes(OLD), command, count=NUM_FAULTS)


class Combining(FaultCase):
    def test_what_was_learnt(self):
        output = self.out / "combiner.json"
        said = Inputs.simulation(12) / "detections.jsonl"
        command = ["combine", "--input", Inputs.simulation(12), "--detections", said, "--labels", said, "--output", output]
        self.check_faults(lambda: output.write_bytes(OLD), command, count=NUM_FAULTS)


if __name__ == "__main__":
    unittest.main(verbosity=1)
