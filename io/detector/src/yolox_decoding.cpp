// SPDX-License-Identifier: BSD-3-Clause
#include "yolox_decoding.hpp"

#include "hypermap/io/codec/bounded_json.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <string>

namespace hypermap {
namespace {

constexpr std::array<int, 3> kStrides{8, 16, 32};

/// Where a row's cell lies: its stride and its upper left corner in cells.
struct OutputCell {
  int stride_px = 0;
  int column = 0;
  int row = 0;
};

std::vector<OutputCell> cells_of(int input_side_px) {
  std::vector<OutputCell> cells;
  cells.reserve(num_yolox_rows(input_side_px));
  for (const int stride : kStrides) {
    const int side = input_side_px / stride;
    for (int row = 0; row < side; ++row) {
      for (int column = 0; column < side; ++column) cells.push_back({stride, column, row});
    }
  }
  return cells;
}

PixelBox box_of(std::span<const float> row, const OutputCell& cell, double scale) {
  const double stride = cell.stride_px;
  const double u = (static_cast<double>(row[0]) + cell.column) * stride / scale;
  const double v = (static_cast<double>(row[1]) + cell.row) * stride / scale;
  const double half_width = 0.5 * std::exp(static_cast<double>(row[2])) * stride / scale;
  const double half_height = 0.5 * std::exp(static_cast<double>(row[3])) * stride / scale;
  return {u - half_width, v - half_height, u + half_width, v + half_height};
}

bool is_finite(const PixelBox& box) {
  return std::isfinite(box.u_min_px) && std::isfinite(box.v_min_px) &&
         std::isfinite(box.u_max_px) && std::isfinite(box.v_max_px);
}

}  // namespace

std::size_t num_yolox_rows(int input_side_px) {
  std::size_t rows = 0;
  for (const int stride : kStrides) {
    const auto side = static_cast<std::size_t>(input_side_px / stride);
    rows += side * side;
  }
  return rows;
}

Result<std::vector<YoloxCandidate>> decode_yolox(std::span<const float> rows,
                                                 const YoloxDecoding& decoding) {
  const std::size_t length = 5 + decoding.num_classes;
  const std::vector<OutputCell> cells = cells_of(decoding.input_side_px);
  assert(rows.size() == cells.size() * length);
  std::vector<YoloxCandidate> out;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const auto row = rows.subspan(i * length, length);
    const auto classes = row.subspan(5);
    const auto best = std::max_element(classes.begin(), classes.end());
    const double score = static_cast<double>(row[4]) * static_cast<double>(*best);
    if (score <= decoding.min_score) continue;
    const PixelBox box = box_of(row, cells[i], decoding.scale);
    if (!std::isfinite(score) || score > 1.0 + 1e-6 || !is_finite(box)) {
      return fail(
          ErrorCode::kMalformedFile,
          "must give finite boxes and scores up to 1, row " + std::to_string(i) + " does not",
          "network output");
    }
    out.push_back({.box_px = box,
                   .score = std::min(score, 1.0),
                   .best_class = static_cast<std::size_t>(best - classes.begin()),
                   .row = i});
  }
  std::stable_sort(
      out.begin(), out.end(), [](const auto& a, const auto& b) { return a.score > b.score; });
  return out;
}

std::vector<YoloxCandidate> suppress_overlaps(std::span<const YoloxCandidate> candidates,
                                              double max_overlap) {
  std::vector<YoloxCandidate> kept;
  for (const YoloxCandidate& candidate : candidates) {
    const bool is_hidden = std::any_of(kept.begin(), kept.end(), [&](const YoloxCandidate& better) {
      return better.best_class == candidate.best_class &&
             intersection_over_union(better.box_px, candidate.box_px) > max_overlap;
    });
    if (!is_hidden) kept.push_back(candidate);
  }
  return kept;
}

}  // namespace hypermap
