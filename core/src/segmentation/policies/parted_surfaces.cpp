// SPDX-License-Identifier: BSD-3-Clause
#include "parted_surfaces.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

namespace hypermap {
namespace {

/// So many lines of the picture (rows or columns) that both surfaces have, this share of all that
/// they have in common, and of those of the one that has fewer.
constexpr int kLeastLines = 3;
constexpr double kLeastOfCommon = 0.8;
constexpr double kLeastOfFewer = 0.5;
/// Of the cells between two ends of a face so many are measured, and nearer: sensors lose some at
/// the edges of what stands there.
constexpr double kLeastNearer = 0.5;
/// Ends of a face are no farther apart than this, or than the wider one is wide.
constexpr float kMostApartM = 0.5F;
/// Depth over width between the ends of a face that is turned from the camera.
constexpr float kMostSlant = 0.5F;

/// A row or a column of a window's cells.
struct Line {
  std::size_t first = 0;
  std::size_t stride = 1;
  [[nodiscard]] std::size_t cell(int i) const {
    return first + stride * static_cast<std::size_t>(i);
  }
};

/// Positions on a line.
struct Span {
  int begin = 0;
  int end = 0;
};

std::optional<Span> span_on(const Line& line,
                            Span within,
                            const DepthComponents& labelled,
                            std::uint32_t id) {
  while (within.begin < within.end && labelled.of_cell[line.cell(within.begin)] != id)
    ++within.begin;
  while (within.begin < within.end && labelled.of_cell[line.cell(within.end - 1)] != id)
    --within.end;
  return within.begin < within.end ? std::optional(within) : std::nullopt;
}

/// The last position of the first of two surfaces on a line, and the first one of the second.
struct Gap {
  int before = 0;
  int after = 0;
};

std::optional<Gap> gap_between(const Span& a, const Span& b) {
  if (a.end <= b.begin) return Gap{a.end - 1, b.begin};
  if (b.end <= a.begin) return Gap{b.end - 1, a.begin};
  return std::nullopt;
}

std::size_t nearer_of(const DepthWindow& window, std::size_t a, std::size_t b) {
  return window.depth_m[a] < window.depth_m[b] ? a : b;
}

/// The share of the cells between both ends that are measured; none where one is not clearly nearer
/// than the ends.
std::optional<double> nearer_share(const DepthWindow& window, const Line& line, const Gap& gap) {
  const std::size_t nearest = nearer_of(window, line.cell(gap.before), line.cell(gap.after));
  const float most_m = window.depth_m[nearest] - window.step_m[nearest];
  int num_nearer = 0;
  for (int i = gap.before + 1; i < gap.after; ++i) {
    const float depth_m = window.depth_m[line.cell(i)];
    if (depth_m >= most_m) return std::nullopt;
    num_nearer += depth_m > 0.0F ? 1 : 0;
  }
  return num_nearer / std::max(1.0, static_cast<double>(gap.after - gap.before - 1));
}

bool may_be_one_face(const DepthWindow& window, const Line& row, const Gap& gap, int most_cells) {
  const std::size_t nearest = nearer_of(window, row.cell(gap.before), row.cell(gap.after));
  const float cell_m = (window.slope_x[1] - window.slope_x[0]) * window.depth_m[nearest];
  const float apart_m = static_cast<float>(gap.after - gap.before) * cell_m;
  const float behind_m =
      std::abs(window.depth_m[row.cell(gap.before)] - window.depth_m[row.cell(gap.after)]);
  return gap.after - gap.before <= most_cells && apart_m <= kMostApartM &&
         behind_m <= kMostSlant * apart_m + window.step_m[nearest];
}

/// Counts the lines on which two surfaces are parted as they should be.
class PartedLines {
 public:
  template <class IsParted>
  void count(const std::optional<Span>& a, const std::optional<Span>& b, IsParted is_parted) {
    if (!a || !b) return;
    ++num_common_;
    const std::optional<Gap> gap = gap_between(*a, *b);
    if (gap && is_parted(*gap)) ++num_parted_;
  }
  [[nodiscard]] bool are_enough(int num_fewer) const {
    return num_parted_ >= kLeastLines && num_parted_ >= kLeastOfCommon * num_common_ &&
           num_parted_ >= kLeastOfFewer * num_fewer;
  }

 private:
  int num_common_ = 0;
  int num_parted_ = 0;
};

}  // namespace

bool are_ends_of_one_face(const DepthWindow& window,
                          const DepthComponents& labelled,
                          std::uint32_t best,
                          std::uint32_t id) {
  const PixelRect& a = labelled.components[best].bounds_in_box;
  const PixelRect& b = labelled.components[id].bounds_in_box;
  const int wider = std::max(a.width(), b.width());
  PartedLines rows;
  for (int y = std::max(a.v_begin, b.v_begin); y < std::min(a.v_end, b.v_end); ++y) {
    const Line row{.first = window.cell(0, y)};
    rows.count(span_on(row, {a.u_begin, a.u_end}, labelled, best),
               span_on(row, {b.u_begin, b.u_end}, labelled, id),
               [&](const Gap& gap) {
                 return may_be_one_face(window, row, gap, wider) &&
                        nearer_share(window, row, gap).value_or(0.0) >= kLeastNearer;
               });
  }
  return rows.are_enough(std::min(a.height(), b.height()));
}

bool are_one_upright_face(const DepthWindow& window,
                          const DepthComponents& labelled,
                          std::uint32_t best,
                          std::uint32_t id,
                          const Eigen::Matrix3f& gravity_aligned_from_camera) {
  const PixelRect& a = labelled.components[best].bounds_in_box;
  const PixelRect& b = labelled.components[id].bounds_in_box;
  PartedLines columns;
  for (int x = std::max(a.u_begin, b.u_begin); x < std::min(a.u_end, b.u_end); ++x) {
    const Line column{.first = window.cell(x, 0), .stride = window.slope_x.size()};
    const auto plan_m = [&](int y) {
      return (gravity_aligned_from_camera * window.point_in_camera(x, y)).head<2>().norm();
    };
    const auto of_part = span_on(column, {b.v_begin, b.v_end}, labelled, id);
    columns.count(
        span_on(column, {a.v_begin, a.v_end}, labelled, best), of_part, [&](const Gap& gap) {
          const std::size_t nearest =
              nearer_of(window, column.cell(gap.before), column.cell(gap.after));
          const int of_best = gap.before < of_part->begin ? gap.before : gap.after;
          const auto is_as_far = [&](int y) {
            return std::abs(plan_m(y) - plan_m(of_best)) <= window.step_m[nearest];
          };
          return is_as_far(of_part->begin) && is_as_far(of_part->end - 1) &&
                 nearer_share(window, column, gap).value_or(0.0) > 0.0;
        });
  }
  return columns.are_enough(std::min(a.width(), b.width()));
}

}  // namespace hypermap
