// SPDX-License-Identifier: BSD-3-Clause
#include "level_edge.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

namespace hypermap {
namespace {

/// A level edge is within this of one height.
constexpr float kLevelToleranceM = 0.04F;
/// So many cells are an edge, or a part of an object; and this share of an edge is at one height.
constexpr std::size_t kLeastCells = 8;
constexpr double kLevelShare = 0.6;
/// Behind something lower than this its support is seen as flat, and is as unmeasured.
constexpr float kLeastHeightM = 0.3F;

class EdgeFinder {
 public:
  EdgeFinder(const DepthWindow& window,
             const std::vector<std::uint8_t>& is_object,
             const Eigen::Vector3f& up_in_camera)
      : window_(window), is_object_(is_object), up_(up_in_camera) {}

  [[nodiscard]] std::optional<LevelEdge> find() const {
    std::vector<CellAbove> cells;
    std::vector<float> heights_m;
    for (int x = window_.box.u_begin; x < window_.box.u_end; ++x) {
      for (int y = window_.box.v_begin; y + 1 < window_.box.v_end; ++y) {
        if (!is_unmeasured(window_, window_.cell(x, y)) || is_object_[window_.cell(x, y + 1)] == 0)
          continue;
        cells.push_back({x, y});
        heights_m.push_back(up_.dot(lower_ray(window_, x, y)) *
                            window_.depth_m[window_.cell(x, y + 1)]);
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

 private:
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
    edge.hiding_m = hiding_depths_m(edge.above);
    return edge;
  }

  /// What is nearer by more than what tells two surfaces apart hides the edge, of two nearest
  /// columns of it that of the left one. Requires: a cell; ascending by column.
  [[nodiscard]] std::vector<float> hiding_depths_m(const std::vector<CellAbove>& above) const {
    std::vector<float> depths_m;
    auto nearest = above.begin();
    for (int x = 0; x < window_.width(); ++x) {
      while (std::next(nearest) != above.end() && std::next(nearest)->x - x < x - nearest->x)
        ++nearest;
      const std::size_t edge = window_.cell(nearest->x, nearest->y + 1);
      depths_m.push_back(nearest->x == x ? std::numeric_limits<float>::infinity()
                                         : window_.depth_m[edge] - window_.step_m[edge]);
    }
    return depths_m;
  }

  /// Depth in each column at which the plane begins behind the edge, less what tells two surfaces
  /// apart; where the edge is not seen the least of all columns. Requires: a cell.
  [[nodiscard]] std::vector<float> nearest_depths_m(const std::vector<CellAbove>& above,
                                                    float height_m) const {
    const auto depth_m = [&](const CellAbove& cell) {
      return plane_depth_m(up_, lower_ray(window_, cell.x, cell.y), height_m) -
             window_.step_m[window_.cell(cell.x, cell.y + 1)];
    };
    const float least_m = depth_m(*std::ranges::min_element(above, {}, depth_m));
    std::vector<float> depths_m(static_cast<std::size_t>(window_.width()), least_m);
    for (const CellAbove& cell : above) depths_m[static_cast<std::size_t>(cell.x)] = depth_m(cell);
    return depths_m;
  }

  const DepthWindow& window_;
  const std::vector<std::uint8_t>& is_object_;
  Eigen::Vector3f up_;
};

}  // namespace

bool is_unmeasured(const DepthWindow& window, std::size_t cell) {
  return window.depth_m[cell] == 0.0F && window.may_be_object(cell);
}

Eigen::Vector3f lower_ray(const DepthWindow& window, int x, int y) {
  const float row_slope = window.slope_y[1] - window.slope_y[0];
  return {window.slope_x[static_cast<std::size_t>(x)],
          window.slope_y[static_cast<std::size_t>(y)] + 0.5F * row_slope,
          1.0F};
}

float plane_depth_m(const Eigen::Vector3f& up_in_camera,
                    const Eigen::Vector3f& ray,
                    float height_m) {
  return height_m / up_in_camera.dot(ray);
}

std::optional<LevelEdge> level_edge(const DepthWindow& window,
                                    const std::vector<std::uint8_t>& is_object,
                                    const Eigen::Vector3f& up_in_camera) {
  return EdgeFinder(window, is_object, up_in_camera).find();
}

}  // namespace hypermap
