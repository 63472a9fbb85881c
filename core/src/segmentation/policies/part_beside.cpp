// SPDX-License-Identifier: BSD-3-Clause
#include "part_beside.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace hypermap {
namespace {

/// In so many rows of the lower one of both surfaces something nearer stands between them,
constexpr double kLeastRows = 0.5;
/// and in so many of the rows that both have.
constexpr double kLeastOfCommonRows = 0.8;
/// Depth over width between the ends of a face that is turned from the camera.
constexpr float kMostSlant = 0.5F;

/// The columns of a surface in a row of the box.
struct Span {
  int begin = 0;
  int end = 0;
};

std::optional<Span> span_in_row(const DepthWindow& window,
                                const DepthComponents& labelled,
                                std::uint32_t id,
                                int y) {
  const PixelRect& bounds = labelled.components[id].bounds_in_box;
  const auto is_of = [&](int x) { return labelled.of_cell[window.cell(x, y)] == id; };
  Span span{bounds.u_begin, bounds.u_end};
  while (span.begin < span.end && !is_of(span.begin)) ++span.begin;
  while (span.begin < span.end && !is_of(span.end - 1)) --span.end;
  return span.begin < span.end ? std::optional(span) : std::nullopt;
}

/// Whether only what is clearly nearer is measured between two cells of a row.
bool is_parted_by_nearer(const DepthWindow& window, int y, int left, int right) {
  const std::size_t nearest =
      window.depth_m[window.cell(left, y)] < window.depth_m[window.cell(right, y)]
          ? window.cell(left, y)
          : window.cell(right, y);
  const float most_m = window.depth_m[nearest] - window.step_m[nearest];
  bool is_any_nearer = false;
  for (int x = left + 1; x < right; ++x) {
    const float depth_m = window.depth_m[window.cell(x, y)];
    if (depth_m >= most_m) return false;
    is_any_nearer = is_any_nearer || depth_m > 0.0F;
  }
  return is_any_nearer;
}

bool may_be_one_face(const DepthWindow& window, int y, int left, int right) {
  const float left_m = window.depth_m[window.cell(left, y)];
  const float right_m = window.depth_m[window.cell(right, y)];
  const auto slope = [&](int x) { return window.slope_x[static_cast<std::size_t>(x)]; };
  const float apart_m = (slope(right) - slope(left)) * std::min(left_m, right_m);
  return std::abs(right_m - left_m) <= kMostSlant * apart_m;
}

}  // namespace

bool is_part_beside(const DepthWindow& window,
                    const DepthComponents& labelled,
                    std::uint32_t best,
                    std::uint32_t id) {
  const PixelRect& a = labelled.components[best].bounds_in_box;
  const PixelRect& b = labelled.components[id].bounds_in_box;
  int num_common = 0;
  int num_parted = 0;
  for (int y = std::max(a.v_begin, b.v_begin); y < std::min(a.v_end, b.v_end); ++y) {
    const auto of_best = span_in_row(window, labelled, best, y);
    const auto of_part = span_in_row(window, labelled, id, y);
    if (!of_best || !of_part) continue;
    ++num_common;
    const bool is_left = of_part->end <= of_best->begin;
    if (!is_left && of_best->end > of_part->begin) continue;
    const int left = (is_left ? of_part->end : of_best->end) - 1;
    const int right = is_left ? of_best->begin : of_part->begin;
    num_parted +=
        is_parted_by_nearer(window, y, left, right) && may_be_one_face(window, y, left, right) ? 1
                                                                                               : 0;
  }
  return num_parted > 0 && num_parted >= kLeastOfCommonRows * num_common &&
         num_parted >= kLeastRows * std::min(a.height(), b.height());
}

}  // namespace hypermap
