// SPDX-License-Identifier: BSD-3-Clause
#include "grids/grid_search.hpp"
#include "hypermap/projection/grids/free_space.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <utility>

namespace hypermap {
namespace {

/// A way over the edges and corners of cells is longer than the straight line by this at most:
/// root (4 - 2 root 2).
constexpr double kMostDetour = 1.0823922002923940;

/// The corners that are left of a way when it is pulled straight.
std::vector<Cell> pulled(const FreeSpace& space, const std::vector<Cell>& way) {
  std::vector<Cell> corners{way.front()};
  for (std::size_t i = 2; i < way.size(); ++i) {
    if (!is_straight_free(space, corners.back(), way[i])) corners.push_back(way[i - 1]);
  }
  if (way.size() > 1) corners.push_back(way.back());
  return corners;
}

/// So much of a straight piece has unknown cells within the robot's radius: looked at every cell.
double beside_unknown_m(const FreeSpace& space,
                        const Eigen::Vector2d& from,
                        const Eigen::Vector2d& to) {
  const double length_m = (to - from).norm();
  const int num_looks = 1 + static_cast<int>(length_m / space.geometry().resolution_m);
  int num_beside = 0;
  for (int i = 0; i < num_looks; ++i) {
    const Eigen::Vector2d point = from + (i + 0.5) / num_looks * (to - from);
    const auto cell = cell_at(space.geometry(), point);
    if (cell && space.is_within_radius(*cell, Standing::kUnknown)) ++num_beside;
  }
  return length_m * num_beside / num_looks;
}

FreeSpaceRoute route_of(const FreeSpace& space,
                        const Eigen::Vector2d& start,
                        const std::vector<Cell>& way) {
  FreeSpaceRoute route{.points = {start}};
  const std::vector<Cell> corners = pulled(space, way);
  for (std::size_t i = 1; i < corners.size(); ++i) {
    const Eigen::Vector2d next = centre(space.geometry(), corners[i]);
    route.length_m += (next - route.points.back()).norm();
    route.points.push_back(next);
  }
  return route;
}

/// Collects the goals that a search comes to.
class GoalCollector {
 public:
  GoalCollector(std::span<const std::vector<std::size_t>> goals,
                std::size_t num_cells,
                std::size_t count)
      : is_goal_(num_cells, false), is_reached_(goals.size(), false), count_(count) {
    std::size_t num_places = 0;
    for (const auto& places : goals) num_places += places.size();
    goal_at_.reserve(num_places);
    for (std::size_t goal = 0; goal < goals.size(); ++goal) {
      if (!goals[goal].empty()) ++num_left_;
      for (const std::size_t place : goals[goal]) {
        goal_at_.emplace_back(place, goal);
        is_goal_[place] = true;
      }
    }
    std::ranges::sort(goal_at_);
  }

  /// Whether to go on: no goal that is still to come can be among the nearest.
  bool visit(std::size_t place, double cells) {
    if (limit_ && cells > *limit_) return false;
    if (is_goal_[place]) reach(place, cells);
    return num_left_ > 0;
  }

  /// Goals and where each was reached, in the order in which they were.
  [[nodiscard]] const std::vector<std::pair<std::size_t, std::size_t>>& reached() const {
    return reached_;
  }

 private:
  void reach(std::size_t place, double cells) {
    const auto first = std::ranges::lower_bound(goal_at_, std::pair(place, std::size_t{0}));
    for (auto at = first; at != goal_at_.end() && at->first == place; ++at) {
      if (is_reached_[at->second]) continue;
      is_reached_[at->second] = true;
      --num_left_;
      reached_.emplace_back(at->second, place);
    }
    if (!limit_ && reached_.size() >= count_) limit_ = cells * kMostDetour;
  }

  std::vector<bool> is_goal_;                                 ///< By place.
  std::vector<std::pair<std::size_t, std::size_t>> goal_at_;  ///< Place and goal, ascending.
  std::vector<bool> is_reached_;                              ///< By goal.
  std::vector<std::pair<std::size_t, std::size_t>> reached_;
  std::size_t num_left_ = 0;
  std::size_t count_;
  /// Beyond it a pulled way is longer than those that were found, in cells.
  std::optional<double> limit_;
};

}  // namespace

std::vector<RouteToGoal> routes_to_nearest(const FreeSpace& space,
                                           const Eigen::Vector2d& start,
                                           std::span<const std::vector<std::size_t>> goals,
                                           std::size_t count) {
  assert(space.standing(start) == Standing::kFits);
  GoalCollector collector(goals, space.geometry().num_cells(), count);
  const GridSearch search(
      space, *cell_at(space.geometry(), start), [&](std::size_t place, double cells) {
        return collector.visit(place, cells);
      });
  std::vector<RouteToGoal> routes;
  routes.reserve(collector.reached().size());
  for (const auto& [goal, place] : collector.reached()) {
    routes.push_back({.goal = goal, .route = route_of(space, start, search.way_to(place))});
  }
  std::ranges::sort(routes, [](const RouteToGoal& a, const RouteToGoal& b) {
    return std::pair(a.route.length_m, a.goal) < std::pair(b.route.length_m, b.goal);
  });
  if (routes.size() > count)
    routes.erase(routes.begin() + static_cast<std::ptrdiff_t>(count), routes.end());
  for (RouteToGoal& one : routes) {
    const auto& points = one.route.points;
    for (std::size_t i = 1; i < points.size(); ++i) {
      one.route.beside_unknown_m += beside_unknown_m(space, points[i - 1], points[i]);
    }
  }
  return routes;
}

}  // namespace hypermap
