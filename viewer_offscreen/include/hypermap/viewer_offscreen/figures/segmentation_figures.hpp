// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Figures of how a detection is segmented: detections, each step, the box, the depth's panels.
///
/// Source: [smap] figures C.1.1 to C.1.11. Deviation: over the camera's image instead of clouds in
/// a viewer, so that what a step took can be compared with what is there; the second view of the
/// panels is from above.
#pragma once

#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/core/base/image.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/segmentation/binned_depth_map.hpp"
#include "hypermap/core/segmentation/segmentation_trace.hpp"

#include <cstddef>
#include <filesystem>
#include <memory>

namespace hypermap {

/// Draws figures of frames, in one font. A frame without colour is drawn by its depth, near bright.
class SegmentationFigures {
 public:
  /// `font_file` empty: DejaVu Sans. Errors: kUnavailable, kNotFound, as of a snapshot's.
  [[nodiscard]] static Result<SegmentationFigures> create(
      const std::filesystem::path& font_file = {});
  SegmentationFigures(SegmentationFigures&&) noexcept;
  SegmentationFigures& operator=(SegmentationFigures&&) noexcept;
  ~SegmentationFigures();

  /// The frame with the box, number, class and score of each of its detections.
  [[nodiscard]] ColorImage detections(const RgbdFrame& frame, const ClassRegistry& classes) const;

  /// What a step left, around the detection and enlarged: kept pixels in the colours of their
  /// segments, those in no segment red, those that this step dropped dark red, all else dimmed;
  /// below it the step's name, points and time. Requires: the trace is of the frame; step < its
  /// steps.
  [[nodiscard]] ColorImage step(const RgbdFrame& frame,
                                const Detection& detection,
                                const SegmentationTrace& trace,
                                std::size_t step) const;

  /// The segment's pixels, and the edges of its box in the map; where there is none, why.
  [[nodiscard]] ColorImage segment(const RgbdFrame& frame,
                                   const Detection& detection,
                                   const Result<Segment>& segment) const;

  /// The panels over the frame: coloured by their nearest distance, which they also say, above the
  /// farthest one, in metres; empty ones are black.
  [[nodiscard]] ColorImage panels(const RgbdFrame& frame, const BinnedDepthMap& panels) const;

  /// The panels' boxes in the map from above, x to the right, in the same colours; the camera is
  /// the dot.
  [[nodiscard]] ColorImage panels_from_above(const BinnedDepthMap& panels) const;

 private:
  struct Impl;
  explicit SegmentationFigures(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace hypermap
