// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// From the rows of a YOLOX network to boxes with class probabilities.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/segmentation/detection.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace hypermap {

/// One row of the output whose score is high enough.
struct YoloxCandidate {
  PixelBox box_px;  ///< In the image that was fitted into the input.
  double score = 0.0;
  std::size_t best_class = 0;  ///< Index in the network's order.
  std::size_t row = 0;
};

struct YoloxDecoding {
  int input_side_px = 416;
  std::size_t num_classes = 80;
  double scale = 1.0;  ///< Input pixels per image pixel.
  double min_score = 0.25;
};

/// Rows of the output for an input side: (side/8)^2 + (side/16)^2 + (side/32)^2.
[[nodiscard]] std::size_t num_yolox_rows(int input_side_px);

/// Rows above `min_score`, best first; equal scores in row order.
///
/// Centre = (raw + cell) * stride, size = e^raw * stride, score = objectness * best class.
/// Errors: kMalformedFile when a row above the score is not finite.
/// Requires: rows.size() == num_yolox_rows * (5 + num_classes).
[[nodiscard]] Result<std::vector<YoloxCandidate>> decode_yolox(std::span<const float> rows,
                                                               const YoloxDecoding& decoding);

/// Greedy suppression within each class: a candidate goes when a better one of its class overlaps
/// it by an IoU above `max_overlap`. Keeps the order. Requires: best first.
[[nodiscard]] std::vector<YoloxCandidate> suppress_overlaps(
    std::span<const YoloxCandidate> candidates, double max_overlap);

}  // namespace hypermap
