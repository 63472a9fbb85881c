// SPDX-License-Identifier: BSD-3-Clause
#include "octree/object_surface.hpp"

#include <boost/geometry.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>

#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

namespace bg = boost::geometry;
using TreePoint = bg::model::point<float, 3, bg::cs::cartesian>;
/// A cell's middle, from that of the first cell, and whether it is supported.
using Entry = std::pair<TreePoint, bool>;
using EntryTree = bg::index::rtree<Entry, bg::index::linear<16>>;

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

EntryTree packed(const OccupancyVotes& points, const Eigen::Vector3d& origin) {
  const OccupancyVotesState& state = points.state();
  std::vector<Entry> entries;
  entries.reserve(state.votes.size());
  for (std::size_t i = 0; i < state.votes.size(); ++i) {
    entries.emplace_back(tree_point(middle_of(state.votes[i].cell, state.edge_m) - origin),
                         points.standings()[i] >= CellStanding::kSupported);
  }
  return {entries.begin(), entries.end()};
}

/// To the first, and so nearest, entry of a query; infinity when it finds none.
template <class Query>
double nearest_m(const EntryTree& tree, const TreePoint& from, const Query& query) {
  const auto found = tree.qbegin(query);
  return found == tree.qend() ? std::numeric_limits<double>::infinity()
                              : static_cast<double>(bg::distance(from, found->first));
}

}  // namespace

struct ObjectSurface::Tree {
  Eigen::Vector3d origin;
  EntryTree entries;
};

ObjectSurface::ObjectSurface(const OccupancyVotes& points) {
  const Eigen::Vector3d origin = origin_of(points.state());
  tree_ = std::make_shared<const Tree>(Tree{origin, packed(points, origin)});
}

bool ObjectSurface::empty() const noexcept {
  return tree_->entries.empty();
}

double ObjectSurface::distance_m(const Eigen::Vector3d& place_in_map, double most_m) const {
  constexpr double kNowhere = std::numeric_limits<double>::infinity();
  const TreePoint from = tree_point(place_in_map - tree_->origin);
  const auto nearest = bg::index::nearest(from, 1);
  const double to_any_m = nearest_m(tree_->entries, from, nearest);
  if (to_any_m >= most_m) return kNowhere;  // a supported one is no nearer
  const auto is_supported = bg::index::satisfies([](const Entry& entry) { return entry.second; });
  const double to_supported_m = nearest_m(tree_->entries, from, nearest && is_supported);
  const double mean_m = 0.5 * (to_any_m + to_supported_m);
  return mean_m < most_m ? mean_m : kNowhere;
}

}  // namespace hypermap
