// SPDX-License-Identifier: BSD-3-Clause
#include "box_candidates.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace hypermap {
namespace {

bool is_finite(const PixelBox& box) {
  return std::isfinite(box.u_min_px) && std::isfinite(box.v_min_px) &&
         std::isfinite(box.u_max_px) && std::isfinite(box.v_max_px);
}

}  // namespace

Result<std::vector<BoxCandidate>> candidates_of(const NetworkRows& rows, double min_score) {
  std::vector<BoxCandidate> out;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const RowScores scores = rows.scores(row);
    if (scores.score <= min_score) continue;
    const PixelBox box = rows.box_px(row);
    if (!std::isfinite(scores.score) || scores.score > 1.0 + 1e-6 || !is_finite(box)) {
      return fail(
          ErrorCode::kMalformedFile,
          "must give finite boxes and scores up to 1, row " + std::to_string(row) + " does not",
          "network output");
    }
    out.push_back({.box_px = box,
                   .score = std::min(scores.score, 1.0),
                   .best_class = scores.best_class,
                   .row = row});
  }
  std::stable_sort(
      out.begin(), out.end(), [](const auto& a, const auto& b) { return a.score > b.score; });
  if (out.size() > kMaxCandidates) out.resize(kMaxCandidates);
  return out;
}

std::vector<BoxCandidate> suppress_overlaps(std::span<const BoxCandidate> candidates,
                                            double max_overlap) {
  std::vector<BoxCandidate> kept;
  for (const BoxCandidate& candidate : candidates) {
    const bool is_hidden = std::any_of(kept.begin(), kept.end(), [&](const BoxCandidate& better) {
      return better.best_class == candidate.best_class &&
             intersection_over_union(better.box_px, candidate.box_px) > max_overlap;
    });
    if (!is_hidden) kept.push_back(candidate);
  }
  return kept;
}

}  // namespace hypermap
