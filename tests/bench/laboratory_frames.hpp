// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Frames of the simulated laboratory for benchmarks.
#pragma once

#include "hypermap/core/segmentation/rgbd_frame.hpp"
#include "hypermap/io/simulator/scene_file.hpp"
#include "hypermap/io/simulator/simulator.hpp"
#include "support/test_data.hpp"

#include <cstddef>
#include <utility>
#include <vector>

namespace hypermap::test {

/// Frames of the laboratory that show at least ten objects, the first ten of them detected.
inline std::vector<RgbdFrame> laboratory_frames(std::size_t max_frames) {
  constexpr std::size_t kNumDetections = 10;
  std::vector<RgbdFrame> frames;
  const auto scene = load_scene(source_path("data/scenes/laboratory.yaml"));
  if (!scene) return frames;
  SimulationOptions options;
  options.num_frames = 200;
  options.detector.min_visible_px = 100;
  options.detector.miss_rate = 0.0;
  const auto simulator = Simulator::create(*scene, options);
  if (!simulator) return frames;
  for (std::size_t i = 0; i < simulator->size() && frames.size() < max_frames; i += 4) {
    RgbdFrame frame = simulator->render(i).frame;
    if (frame.detections.size() < kNumDetections) continue;
    frame.detections.resize(kNumDetections);
    frames.push_back(std::move(frame));
  }
  return frames;
}

}  // namespace hypermap::test
