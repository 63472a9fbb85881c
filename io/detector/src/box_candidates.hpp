// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// From the rows of a network to the boxes of one image.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/segmentation/detection.hpp"
#include "network_rows.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace hypermap {

/// One row whose score is high enough.
struct BoxCandidate {
  PixelBox box_px;  ///< In the input.
  double score = 0.0;
  std::size_t best_class = 0;  ///< In the network's order.
  std::size_t row = 0;
};

/// More rows of one image than any network has that was trained; the best are taken.
inline constexpr std::size_t kMaxCandidates = 10'000;

/// Rows above `min_score`, best first; equal scores in row order.
/// Errors: kMalformedFile when a score is no number, a row above the score has one beyond 1 or a
/// box that is not finite.
[[nodiscard]] Result<std::vector<BoxCandidate>> candidates_of(const NetworkRows& rows,
                                                              double min_score);

/// Greedy suppression within each class: a candidate goes when a better one of its class overlaps
/// it by an IoU above `max_overlap`. Keeps the order. Requires: best first.
[[nodiscard]] std::vector<BoxCandidate> suppress_overlaps(std::span<const BoxCandidate> candidates,
                                                          double max_overlap);

}  // namespace hypermap
