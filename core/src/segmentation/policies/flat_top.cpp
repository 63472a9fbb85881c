// SPDX-License-Identifier: BSD-3-Clause
#include "flat_top.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>
#include <utility>

namespace hypermap {
namespace {

/// Cosine of the angle between ray and normal from which on sensors lose a surface: 70 degrees.
constexpr float kFlatCos = 0.342F;
/// Sine of the roll up to which a column of the image stands upright.
constexpr float kMostRoll = 0.5F;
/// A level edge is within this of one height.
constexpr float kLevelToleranceM = 0.04F;
/// So many cells are an edge, or a part of an object; and this share of an edge is at one height.
constexpr std::size_t kLeastCells = 8;
constexpr double kLevelShare = 0.6;
/// Behind something lower than this its support is seen as flat, and is as unmeasured.
constexpr float kLeastHeightM = 0.3F;
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

/// A cell whose ray passes above the object's upper edge.
struct CellAbove {
  int x;
  int y;
};

/// The level upper edge of an object, from one side to the other.
struct LevelEdge {
  float height_m = 0.0F;  ///< Above the camera; negative.
  std::vector<CellAbove> above;
  std::vector<float> nearest_m;  ///< For each column: a top begins behind its edge.
  std::vector<float> hidden_m;  ///< For each column: depth of the edge where it is seen nearest by.
  Eigen::Vector3f middle_in_camera = Eigen::Vector3f::Zero();
  float length_m = 0.0F;
};

class FlatTop {
 public:
  FlatTop(const DepthWindow& window,
          const std::vector<std::uint8_t>& is_object,
          const Eigen::Vector3f& up_in_camera)
      : window_(window), is_object_(is_object), up_(up_in_camera) {}

  /// The edge below the unmeasured, when most of it is of one height and it is the object's top.
  [[nodiscard]] std::optional<LevelEdge> edge() const {
    std::vector<CellAbove> cells;
    std::vector<float> heights_m;
    for (int x = window_.box.u_begin; x < window_.box.u_end; ++x) {
      for (int y = window_.box.v_begin; y + 1 < window_.box.v_end; ++y) {
        if (!is_unmeasured(window_.cell(x, y)) || is_object_[window_.cell(x, y + 1)] == 0) continue;
        cells.push_back({x, y});
        heights_m.push_back(up_.dot(lower_ray(x, y)) * window_.depth_m[window_.cell(x, y + 1)]);
        break;
      }
    }
    if (cells.size() < kLeastCells) return std::nullopt;
    std::vector<float> sorted = heights_m;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    LevelEdge edge;
    edge.height_m = *middle;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (std::abs(heights_m[i] - edge.height_m) <= kLevelToleranceM)
        edge.above.push_back(cells[i]);
    }
    const double level = static_cast<double>(edge.above.size());
    const bool is_level = level >= kLevelShare * static_cast<double>(cells.size());
    if (!is_level || edge.height_m >= 0.0F || !is_top_of_tall(edge.height_m)) return std::nullopt;
    return with_extent(std::move(edge));
  }

  /// 1 on cells of the box that are joined with the edge, unmeasured, and see its plane flat; only
  /// where they lie as broad as high.
  [[nodiscard]] std::vector<std::uint8_t> gap_above(const LevelEdge& edge) const {
    std::vector<std::uint8_t> is_gap(window_.size(), 0);
    std::vector<CellAbove> open;
    const auto visit = [&](int x, int y) {
      const PixelRect& box = window_.box;
      if (x < box.u_begin || x >= box.u_end || y < box.v_begin || y >= box.v_end) return;
      const std::size_t cell = window_.cell(x, y);
      if (is_gap[cell] != 0 || !is_unmeasured(cell) || !is_flat(x, y, edge.height_m)) return;
      const float depth_m = plane_depth_m(lower_ray(x, y), edge.height_m);
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

  /// Of the box and, where there is one, of the mask.
  [[nodiscard]] bool is_unmeasured(std::size_t cell) const {
    return window_.depth_m[cell] == 0.0F && window_.may_be_object(cell);
  }

  /// The ray through the lower border of a cell; that of the cell above it is its upper border.
  [[nodiscard]] Eigen::Vector3f lower_ray(int x, int y) const {
    const float row_slope = window_.slope_y[1] - window_.slope_y[0];
    return {window_.slope_x[static_cast<std::size_t>(x)],
            window_.slope_y[static_cast<std::size_t>(y)] + 0.5F * row_slope,
            1.0F};
  }

  /// Depth at which a ray meets the plane of that height. Requires: it falls towards it.
  [[nodiscard]] float plane_depth_m(const Eigen::Vector3f& ray, float height_m) const {
    return height_m / up_.dot(ray);
  }

  /// The depths between which a cell sees the plane; none at and above the horizon.
  [[nodiscard]] std::optional<std::pair<float, float>> plane_depths_m(int x,
                                                                      int y,
                                                                      float height_m) const {
    const Eigen::Vector3f lower = lower_ray(x, y);
    const Eigen::Vector3f upper =
        lower - Eigen::Vector3f(0.0F, window_.slope_y[1] - window_.slope_y[0], 0.0F);
    if (up_.dot(lower) >= 0.0F || up_.dot(upper) >= 0.0F) return std::nullopt;
    return std::pair(plane_depth_m(lower, height_m), plane_depth_m(upper, height_m));
  }

  [[nodiscard]] bool is_flat(int x, int y, float height_m) const {
    const Eigen::Vector3f ray = lower_ray(x, y);
    if (-up_.dot(ray) > kFlatCos * ray.norm()) return false;
    const auto depths_m = plane_depths_m(x, y, height_m);
    const float most_m = kMostOfAPixelM * static_cast<float>(window_.block_px);
    return depths_m && depths_m->second - depths_m->first <= most_m;
  }

  /// Whether that height is the top of something tall: hardly a cell of the object is above it, for
  /// a seat has a back, and some are far below.
  [[nodiscard]] bool is_top_of_tall(float height_m) const {
    std::size_t num_above = 0;
    std::size_t num_below = 0;
    for (int y = window_.box.v_begin; y < window_.box.v_end; ++y) {
      for (int x = window_.box.u_begin; x < window_.box.u_end; ++x) {
        if (is_object_[window_.cell(x, y)] == 0) continue;
        const float above_m = up_.dot(window_.point_in_camera(x, y)) - height_m;
        num_above += above_m > kLevelToleranceM ? 1U : 0U;
        num_below += above_m < -kLeastHeightM ? 1U : 0U;
      }
    }
    return num_above <= kLeastCells && num_below >= kLeastCells;
  }

  [[nodiscard]] LevelEdge with_extent(LevelEdge edge) const {
    Eigen::Vector3f lowest = window_.point_in_camera(edge.above[0].x, edge.above[0].y + 1);
    Eigen::Vector3f highest = lowest;
    for (const CellAbove& cell : edge.above) {
      const Eigen::Vector3f point = window_.point_in_camera(cell.x, cell.y + 1);
      lowest = lowest.cwiseMin(point);
      highest = highest.cwiseMax(point);
      edge.middle_in_camera += point / static_cast<float>(edge.above.size());
    }
    edge.length_m = (highest - lowest).norm();
    edge.nearest_m = nearest_depths_m(edge.above, edge.height_m);
    edge.hidden_m = hidden_depths_m(edge.above);
    return edge;
  }

  /// Depth of the edge in each column, or in the nearest one where it is seen, the left of two.
  /// Requires: a cell; ascending by column.
  [[nodiscard]] std::vector<float> hidden_depths_m(const std::vector<CellAbove>& above) const {
    std::vector<float> depths_m;
    auto nearest = above.begin();
    for (int x = 0; x < window_.width(); ++x) {
      while (std::next(nearest) != above.end() && std::next(nearest)->x - x < x - nearest->x)
        ++nearest;
      depths_m.push_back(window_.depth_m[window_.cell(nearest->x, nearest->y + 1)]);
    }
    return depths_m;
  }

  /// Depth in each column at which the plane begins behind the edge, less what tells two surfaces
  /// apart; where the edge is not seen the least of all columns. Requires: a cell.
  [[nodiscard]] std::vector<float> nearest_depths_m(const std::vector<CellAbove>& above,
                                                    float height_m) const {
    const auto depth_m = [&](const CellAbove& cell) {
      return plane_depth_m(lower_ray(cell.x, cell.y), height_m) -
             window_.step_m[window_.cell(cell.x, cell.y + 1)];
    };
    const float least_m = depth_m(*std::ranges::min_element(above, {}, depth_m));
    std::vector<float> depths_m(static_cast<std::size_t>(window_.width()), least_m);
    for (const CellAbove& cell : above) depths_m[static_cast<std::size_t>(cell.x)] = depth_m(cell);
    return depths_m;
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

  /// Whether what is measured below the gap is the object, or hides its edge; and the plane is no
  /// nearer there, for a top that was would hide that. Beside the object stands another, which has
  /// a top of its own.
  [[nodiscard]] bool begins_behind(int x, int y, const LevelEdge& edge) const {
    const int end = std::min(y + 2 + kEdgePx, window_.height());
    int below = y + 1;
    while (below < end && window_.depth_m[window_.cell(x, below)] == 0.0F) ++below;
    if (below == end) return false;
    const std::size_t cell = window_.cell(x, below);
    const float depth_m = window_.depth_m[cell];
    if (is_object_[cell] == 0 && depth_m > edge.hidden_m[static_cast<std::size_t>(x)]) return false;
    return depth_m <= plane_depth_m(lower_ray(x, y), edge.height_m) + window_.step_m[cell];
  }

  /// Requires: a row above.
  void add_points_of_cell(
      int x, int y, float height_m, float spacing_m, std::vector<Eigen::Vector3f>& all) const {
    const auto [near_m, far_m] = *plane_depths_m(x, y, height_m);
    const int num = std::max(1, static_cast<int>(std::ceil((far_m - near_m) / spacing_m)));
    const Eigen::Vector3f near_point = lower_ray(x, y) * near_m;
    const Eigen::Vector3f far_point = lower_ray(x, y - 1) * far_m;
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
  const std::optional<LevelEdge> edge = top.edge();
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
