// SPDX-License-Identifier: BSD-3-Clause
#include "octree/object_surface.hpp"

#include <boost/geometry.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

namespace bg = boost::geometry;
using TreePoint = bg::model::point<float, 3, bg::cs::cartesian>;
/// A cell's middle, from that of the first cell, and its position in the state.
using Entry = std::pair<TreePoint, std::uint32_t>;
using EntryTree = bg::index::rtree<Entry, bg::index::linear<16>>;

/// A cell up to so wide is a point: the gaps between them are no wider than those of pixels.
constexpr double kPointEdgeM = 0.02;
constexpr double kNowhere = std::numeric_limits<double>::infinity();

Eigen::Vector3d middle_of(const PointCell& cell, double edge_m) {
  return edge_m * (Eigen::Vector3d(cell.x, cell.y, cell.z).array() + 0.5);
}

/// Middle of the first cell, near which floats are exact enough; zeros when there is none.
Eigen::Vector3d origin_of(const OccupancyVotesState& state) {
  if (state.votes.empty()) return Eigen::Vector3d::Zero();
  return middle_of(state.votes.front().cell, state.edge_m);
}

TreePoint tree_point(const Eigen::Vector3d& p) {
  return {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())};
}

/// The cells that are supported, or those that are not.
EntryTree packed(const OccupancyVotes& points, const Eigen::Vector3d& origin, bool are_supported) {
  const OccupancyVotesState& state = points.state();
  std::vector<Entry> entries;
  for (std::size_t i = 0; i < state.votes.size(); ++i) {
    if ((points.standings()[i] >= CellStanding::kSupported) != are_supported) continue;
    entries.emplace_back(tree_point(middle_of(state.votes[i].cell, state.edge_m) - origin),
                         static_cast<std::uint32_t>(i));
  }
  return {entries.begin(), entries.end()};
}

}  // namespace

struct ObjectSurface::Trees {
  explicit Trees(const OccupancyVotes& of)
      : points(of),
        origin(origin_of(of.state())),
        supported(packed(of, origin, true)),
        strays(packed(of, origin, false)) {}

  /// From a place to the nearest cell of a tree. The tree's floats find it, its integers say where
  /// it is: two objects with the same cell are equally near.
  [[nodiscard]] double nearest_m(const EntryTree& tree, const Eigen::Vector3d& place) const {
    Entry found;
    if (tree.query(bg::index::nearest(tree_point(place - origin), 1), &found) == 0) return kNowhere;
    const OccupancyVotesState& state = points.state();
    const double excess_m = std::max(0.0, 0.5 * (state.edge_m - kPointEdgeM));
    const Eigen::Vector3d middle = middle_of(state.votes[found.second].cell, state.edge_m);
    return std::max(0.0, (middle - place).norm() - excess_m);
  }

  OccupancyVotes points;
  Eigen::Vector3d origin;
  EntryTree supported;
  EntryTree strays;
};

ObjectSurface::ObjectSurface(const OccupancyVotes& points)
    : trees_(std::make_shared<const Trees>(points)) {}

bool ObjectSurface::empty() const noexcept {
  return trees_->points.empty();
}

double ObjectSurface::distance_m(const Eigen::Vector3d& place_in_map, double most_m) const {
  const double to_supported_m = trees_->nearest_m(trees_->supported, place_in_map);
  // A stray may be as near as can be.
  if (!(0.5 * to_supported_m < most_m)) return kNowhere;
  const double to_any_m = std::min(to_supported_m, trees_->nearest_m(trees_->strays, place_in_map));
  const double mean_m = 0.5 * (to_supported_m + to_any_m);
  if (!(mean_m < most_m)) return kNowhere;
  return mean_m;
}

}  // namespace hypermap
