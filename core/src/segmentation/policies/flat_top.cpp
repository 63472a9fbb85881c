// SPDX-License-Identifier: BSD-3-Clause
#include "flat_top.hpp"

#include "level_edge.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

namespace hypermap {
namespace {

/// Cosine of the angle between ray and normal from which on sensors lose a surface: 70 degrees.
constexpr float kFlatCos = 0.342F;
/// Sine of the roll up to which a column of the image stands upright.
constexpr float kMostRoll = 0.5F;
/// Gaps narrower than this are what sensors lose at any edge, and so are the last pixels of others.
constexpr int kLeastGapPx = 6;
constexpr int kEdgePx = 2;
/// Where a pixel covers more of the plane it does not tell where the top ends.
constexpr float kMostOfAPixelM = 0.12F;
/// Share of the box's height by which a detector's upper border is uncertain.
constexpr double kBorderShare = 0.1;
/// Hardly any of a top is farther from the middle of its visible edge than so many lengths of it:
/// what reaches farther is also the floor behind, or what is out of range.
constexpr float kMostReach = 1.25F;
constexpr double kMostOutOfReach = 0.1;  ///< Share of its points.

class FlatTop {
 public:
  FlatTop(const DepthWindow& window,
          const std::vector<std::uint8_t>& is_object,
          const Eigen::Vector3f& up_in_camera)
      : window_(window), is_object_(is_object), up_(up_in_camera) {}

  /// 1 on cells of the box that are joined with the edge, unmeasured, and see its plane flat; only
  /// where they lie as broad as high.
  [[nodiscard]] std::vector<std::uint8_t> gap_above(const LevelEdge& edge) const {
    std::vector<std::uint8_t> is_gap(window_.size(), 0);
    std::vector<CellAbove> open;
    const auto visit = [&](int x, int y) {
      const PixelRect& box = window_.box;
      if (x < box.u_begin || x >= box.u_end || y < box.v_begin || y >= box.v_end) return;
      const std::size_t cell = window_.cell(x, y);
      if (is_gap[cell] != 0 || !is_unmeasured(window_, cell) || !is_flat(x, y, edge.height_m))
        return;
      const float depth_m = plane_depth_m(up_, lower_ray(window_, x, y), edge.height_m);
      if (depth_m < edge.nearest_m[static_cast<std::size_t>(x)]) return;
      is_gap[cell] = 1;
      open.push_back({x, y});
    };
    for (const CellAbove& cell : edge.above) visit(cell.x, cell.y);
    while (!open.empty()) {
      const CellAbove cell = open.back();
      open.pop_back();
      visit(cell.x - 1, cell.y);
      visit(cell.x + 1, cell.y);
      visit(cell.x, cell.y - 1);
      visit(cell.x, cell.y + 1);
    }
    return opened(is_gap, cells_of(kLeastGapPx));
  }

  /// Points of the plane on the rays of the gap's cells.
  [[nodiscard]] std::vector<Eigen::Vector3f> points(const LevelEdge& edge,
                                                    const std::vector<std::uint8_t>& is_gap,
                                                    float spacing_m) const {
    std::vector<Eigen::Vector3f> all;
    const PixelRect& box = window_.box;
    const int border = box.v_begin + static_cast<int>(std::ceil(kBorderShare * box.height()));
    for (int x = box.u_begin; x < box.u_end; ++x) {
      for (int y = box.v_end - 1; y >= box.v_begin; --y) {
        if (is_gap[window_.cell(x, y)] == 0) continue;
        const int near = y;
        while (y > box.v_begin && is_gap[window_.cell(x, y - 1)] != 0) --y;
        if (!begins_behind(x, near, edge)) continue;
        const bool is_ended = y > box.v_begin || window_.is_masked();
        const int far = is_ended ? y + cells_of(kEdgePx) : border;
        for (int row = near; row >= far; --row) {
          add_points_of_cell(x, row, edge.height_m, spacing_m, all);
        }
      }
    }
    return all;
  }

 private:
  [[nodiscard]] int cells_of(int pixels) const {
    return std::max(1, (pixels + window_.block_px - 1) / window_.block_px);
  }

  /// The depths between which a cell sees the plane; none at and above the horizon.
  [[nodiscard]] std::optional<std::pair<float, float>> plane_depths_m(int x,
                                                                      int y,
                                                                      float height_m) const {
    const Eigen::Vector3f lower = lower_ray(window_, x, y);
    const Eigen::Vector3f upper =
        lower - Eigen::Vector3f(0.0F, window_.slope_y[1] - window_.slope_y[0], 0.0F);
    if (up_.dot(lower) >= 0.0F || up_.dot(upper) >= 0.0F) return std::nullopt;
    return std::pair(plane_depth_m(up_, lower, height_m), plane_depth_m(up_, upper, height_m));
  }

  [[nodiscard]] bool is_flat(int x, int y, float height_m) const {
    const Eigen::Vector3f ray = lower_ray(window_, x, y);
    if (-up_.dot(ray) > kFlatCos * ray.norm()) return false;
    const auto depths_m = plane_depths_m(x, y, height_m);
    const float most_m = kMostOfAPixelM * static_cast<float>(window_.block_px);
    return depths_m && depths_m->second - depths_m->first <= most_m;
  }

  /// What remains of the marked cells when squares of `side` cells are all that may cover them.
  [[nodiscard]] std::vector<std::uint8_t> opened(const std::vector<std::uint8_t>& is_marked,
                                                 int side) const {
    std::vector<std::uint8_t> is_covered(is_marked.size(), 0);
    const auto is_whole = [&](int left, int top) {
      for (int y = top; y < top + side; ++y) {
        for (int x = left; x < left + side; ++x) {
          if (is_marked[window_.cell(x, y)] == 0) return false;
        }
      }
      return true;
    };
    for (int y = window_.box.v_begin; y + side <= window_.box.v_end; ++y) {
      for (int x = window_.box.u_begin; x + side <= window_.box.u_end; ++x) {
        if (!is_whole(x, y)) continue;
        for (int row = y; row < y + side; ++row) {
          std::fill_n(is_covered.begin() + static_cast<std::ptrdiff_t>(window_.cell(x, row)),
                      side,
                      std::uint8_t{1});
        }
      }
    }
    return is_covered;
  }

  /// Whether what is measured below the gap is the object, stands on it behind its edge, or hides
  /// its edge; and the plane is no nearer there, for a top that was would hide that. Beside the
  /// object stands another, which has a top of its own.
  [[nodiscard]] bool begins_behind(int x, int y, const LevelEdge& edge) const {
    const int end = std::min(y + 2 + kEdgePx, window_.height());
    int below = y + 1;
    while (below < end && window_.depth_m[window_.cell(x, below)] == 0.0F) ++below;
    if (below == end) return false;
    const std::size_t cell = window_.cell(x, below);
    const float depth_m = window_.depth_m[cell];
    if (is_object_[cell] == 0 && depth_m > edge.hiding_m[static_cast<std::size_t>(x)]) return false;
    return depth_m <=
           plane_depth_m(up_, lower_ray(window_, x, y), edge.height_m) + window_.step_m[cell];
  }

  /// Requires: a row above.
  void add_points_of_cell(
      int x, int y, float height_m, float spacing_m, std::vector<Eigen::Vector3f>& all) const {
    const auto [near_m, far_m] = *plane_depths_m(x, y, height_m);
    const int num = std::max(1, static_cast<int>(std::ceil((far_m - near_m) / spacing_m)));
    const Eigen::Vector3f near_point = lower_ray(window_, x, y) * near_m;
    const Eigen::Vector3f far_point = lower_ray(window_, x, y - 1) * far_m;
    for (int i = 0; i < num; ++i) {
      const float share = (static_cast<float>(i) + 0.5F) / static_cast<float>(num);
      all.push_back(near_point + share * (far_point - near_point));
    }
  }

  const DepthWindow& window_;
  const std::vector<std::uint8_t>& is_object_;
  Eigen::Vector3f up_;
};

}  // namespace

std::vector<Eigen::Vector3f> unmeasured_top(const DepthWindow& window,
                                            const std::vector<std::uint8_t>& is_object,
                                            const Eigen::Matrix3f& gravity_aligned_from_camera,
                                            float spacing_m) {
  const Eigen::Vector3f up = gravity_aligned_from_camera.row(2).transpose();
  if (window.height() < 2 || std::abs(up.x()) > kMostRoll) return {};
  const FlatTop top(window, is_object, up);
  const std::optional<LevelEdge> edge = level_edge(window, is_object, up);
  if (!edge) return {};
  std::vector<Eigen::Vector3f> points = top.points(*edge, top.gap_above(*edge), spacing_m);
  const auto is_out_of_reach = [&](const Eigen::Vector3f& point) {
    return (point - edge->middle_in_camera).norm() > kMostReach * edge->length_m;
  };
  const auto num_out = std::count_if(points.begin(), points.end(), is_out_of_reach);
  if (static_cast<double>(num_out) > kMostOutOfReach * static_cast<double>(points.size()))
    return {};
  std::erase_if(points, is_out_of_reach);
  return points;
}

}  // namespace hypermap
