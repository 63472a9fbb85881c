// SPDX-License-Identifier: BSD-3-Clause
#include "plane_growth.hpp"

#include "plane_test.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace hypermap {
namespace {

/// Of a plane's tolerance, how far its points may be from it where it goes on.
constexpr float kLooseScale = 2.0F;
/// Rise over run of a surface that still runs along the plane: 7 degrees. The edge of what is 2 cm
/// thick rises more within the reach, depth that is wrong by 3 cm over half a metre less.
constexpr float kMaxRise = 0.12F;
/// Cells between those that the rise is measured by.
constexpr int kReach = 4;
/// Of the tolerance, how far neighbours may be apart across the plane.
constexpr float kStepScale = 0.4F;
/// So many neighbours join at the edge of a patch for each one that does not; where depth is noisy,
/// most of the edge of a floor does not either.
constexpr double kMinJoins = 0.3;
/// An object rises from a plane when this share of it is farther away than `kClearScale` times the
/// tolerance.
constexpr double kMinRisenShare = 0.3;
constexpr float kClearScale = 6.0F;

/// The plane is looked at where this share of the object may be the plane's.
constexpr double kMinAlikeShare = 0.002;

/// Column and row of a cell.
using Cell = std::pair<int, int>;

std::vector<Cell> cells_with(const DepthWindow& window,
                             const std::vector<std::uint8_t>& values,
                             std::uint8_t value) {
  std::vector<Cell> cells;
  for (int y = 0; y < window.height(); ++y) {
    for (int x = 0; x < window.width(); ++x) {
      if (values[window.cell(x, y)] == value) cells.emplace_back(x, y);
    }
  }
  return cells;
}

/// One plane's cells of a window.
class PlaneGrowth {
 public:
  PlaneGrowth(const DepthWindow& window, const Plane& plane, const ForegroundOptions& options)
      : window_(window), options_(options), test_(test_of(plane, options)) {}

  /// Whether the object rises from the plane, and has cells that may be the plane's.
  [[nodiscard]] bool is_under(const std::vector<Cell>& object) const {
    std::size_t num_alike = 0;
    std::size_t num_risen = 0;
    for (const auto& [x, y] : object) {
      const float off = tolerances_off(x, y);
      num_alike += off <= kLooseScale && runs_along(x, y) ? 1U : 0U;
      num_risen += off > kClearScale ? 1U : 0U;
    }
    const auto num_all = static_cast<double>(object.size());
    return static_cast<double>(num_alike) >= kMinAlikeShare * num_all &&
           static_cast<double>(num_risen) >= kMinRisenShare * num_all;
  }

  /// Gives the cells of no plane that this one, `number`, goes on through that number.
  void grow(std::vector<std::uint8_t>& plane_of_cell, std::uint8_t number) const {
    std::vector<std::uint8_t> is_known = plane_of_cell;
    for (const Cell& start : cells_with(window_, plane_of_cell, number)) {
      const std::vector<Cell> patch = patch_beside(start, is_known);
      if (!joins_along_its_edge(patch, plane_of_cell, is_known, number)) continue;
      for (const auto& [x, y] : patch) plane_of_cell[window_.cell(x, y)] = number;
    }
  }

 private:
  [[nodiscard]] bool contains(int x, int y) const {
    return x >= 0 && y >= 0 && x < window_.width() && y < window_.height();
  }
  /// Of a measured cell: its distance from the plane, and what the plane tolerates there.
  struct Offset {
    float distance_m = 0.0F;
    float tolerance_m = 0.0F;
  };
  [[nodiscard]] Offset offset(int x, int y) const {
    const Eigen::Vector3f point = window_.point_in_camera(x, y);
    const float along_m = test_.along_m(point.x(), point.y(), point.z());
    return {along_m + test_.plane.offset_m,
            test_.tolerance_m(along_m, point.z(), noise_at(point.z(), options_))};
  }
  [[nodiscard]] float tolerances_off(int x, int y) const {
    const Offset here = offset(x, y);
    return std::abs(here.distance_m) / here.tolerance_m;
  }
  /// The cells that the plane goes on through from that one, the nearest first. They are known
  /// then.
  std::vector<Cell> patch_beside(const Cell& start, std::vector<std::uint8_t>& is_known) const {
    std::vector<Cell> patch;
    const auto reach = [&](const Cell& from, const Cell& to) {
      std::uint8_t& known = is_known[window_.cell(to.first, to.second)];
      if (known != 0 || !is_near(to) || !joins(from, to) || !runs_along(to.first, to.second))
        return;
      known = 1;
      patch.push_back(to);
    };
    for_each_neighbour(start, reach);
    for (std::size_t i = 0; i < patch.size(); ++i) for_each_neighbour(Cell(patch[i]), reach);
    return patch;
  }

  /// Whether the patch runs into the plane along much of its edge towards it: the foot of a screen
  /// that the growth reached at one place rises from its table all around.
  [[nodiscard]] bool joins_along_its_edge(const std::vector<Cell>& patch,
                                          const std::vector<std::uint8_t>& plane_of_cell,
                                          const std::vector<std::uint8_t>& is_known,
                                          std::uint8_t number) const {
    std::size_t num_joins = 0;
    std::size_t num_steps = 0;
    const auto look = [&](const Cell& from, const Cell& to) {
      const std::size_t cell = window_.cell(to.first, to.second);
      if (plane_of_cell[cell] == number) {
        ++(joins(from, to) ? num_joins : num_steps);
      } else if (is_known[cell] == 0 && is_near(to)) {
        ++num_steps;
      }
    };
    for (const Cell& cell : patch) for_each_neighbour(cell, look);
    return static_cast<double>(num_joins) >= kMinJoins * static_cast<double>(num_steps);
  }

  template <class Visit>
  void for_each_neighbour(const Cell& from, Visit visit) const {
    for (const auto& [dx, dy] : {std::pair(1, 0), {-1, 0}, {0, 1}, {0, -1}}) {
      const Cell to{from.first + dx, from.second + dy};
      if (contains(to.first, to.second)) visit(from, to);
    }
  }

  /// Measured, and within the loose tolerance.
  [[nodiscard]] bool is_near(const Cell& cell) const {
    return window_.depth_m[window_.cell(cell.first, cell.second)] != 0.0F &&
           tolerances_off(cell.first, cell.second) <= kLooseScale;
  }

  /// No step between two neighbours.
  [[nodiscard]] bool joins(const Cell& from, const Cell& to) const {
    const Offset there = offset(to.first, to.second);
    return std::abs(there.distance_m - offset(from.first, from.second).distance_m) <=
           kStepScale * there.tolerance_m;
  }

  /// The least rise towards the two sides: at the end of a surface one side is another surface's.
  [[nodiscard]] bool runs_along(int x, int y) const {
    return std::min(rise(x, y, kReach, 0), rise(x, y, -kReach, 0)) <= kMaxRise &&
           std::min(rise(x, y, 0, kReach), rise(x, y, 0, -kReach)) <= kMaxRise;
  }
  [[nodiscard]] float rise(int x, int y, int dx, int dy) const {
    constexpr float kNone = std::numeric_limits<float>::infinity();
    if (!contains(x + dx, y + dy)) return kNone;
    if (window_.depth_m[window_.cell(x + dx, y + dy)] == 0.0F) return kNone;
    const Eigen::Vector3f way =
        window_.point_in_camera(x + dx, y + dy) - window_.point_in_camera(x, y);
    const float up_m = std::abs(way.dot(test_.plane.normal));
    const float length_m2 = way.squaredNorm() - up_m * up_m;
    return length_m2 > 0.0F ? up_m / std::sqrt(length_m2) : kNone;
  }

  const DepthWindow& window_;
  const ForegroundOptions& options_;
  PlaneTest test_;
};

}  // namespace

std::vector<std::uint8_t> grown_planes(const DepthWindow& window,
                                       const std::vector<Plane>& planes,
                                       std::vector<std::uint8_t> plane_of_cell,
                                       const std::vector<std::uint8_t>& is_object,
                                       const ForegroundOptions& options) {
  const std::vector<Cell> object = cells_with(window, is_object, 1);
  if (object.empty()) return plane_of_cell;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    const PlaneGrowth growth(window, planes[i], options);
    if (growth.is_under(object)) growth.grow(plane_of_cell, static_cast<std::uint8_t>(i + 1));
  }
  return plane_of_cell;
}

}  // namespace hypermap
