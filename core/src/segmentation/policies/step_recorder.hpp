// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Keeps what each step of a segmentation left, when somebody wants to look at it.
#pragma once

#include "hypermap/core/segmentation/segmentation_trace.hpp"

#include <chrono>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace hypermap {

/// Collects steps and their times. The segmentation takes a pointer, null when nobody looks.
class StepRecorder {
 public:
  StepRecorder(int width_px, int height_px) : width_px_(width_px), height_px_(height_px) {}

  /// Writes down one step; `label_of(i)` is the label of pixel `pixels[i]`. Time spent in here does
  /// not count.
  template <class LabelOf>
  void record(std::string name,
              std::size_t num_points,
              std::size_t num_segments,
              std::span<const std::uint32_t> pixels,
              LabelOf label_of) {
    const std::chrono::duration<double> spent = Clock::now() - started_;
    LabelImage labels(width_px_, height_px_, kLabelAbsent);
    for (std::size_t i = 0; i < pixels.size(); ++i) labels.pixels()[pixels[i]] = label_of(i);
    steps_.push_back({.name = std::move(name),
                      .num_points = num_points,
                      .num_segments = num_segments,
                      .seconds = spent.count(),
                      .labels = std::move(labels)});
    started_ = Clock::now();
  }

  [[nodiscard]] std::vector<SegmentationStep> take() && { return std::move(steps_); }

 private:
  using Clock = std::chrono::steady_clock;
  int width_px_;
  int height_px_;
  Clock::time_point started_ = Clock::now();
  std::vector<SegmentationStep> steps_;
};

}  // namespace hypermap
