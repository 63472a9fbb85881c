// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/grids/map_regions.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace hypermap {
namespace {

/// Half a gap: two leaves of a cube are at most its diagonal apart, 43.3 m, and cubes that differ
/// by more than 2 along an axis cannot be near enough.
constexpr double kCubeEdgeM = kMaxRegionGapM / 2;
constexpr std::int32_t kCubeReach = 2;

Box box_of(const LeafSample& leaf) {
  const Eigen::Vector3d half = Eigen::Vector3d::Constant(leaf.edge_m / 2);
  return {leaf.centre_in_map - half, leaf.centre_in_map + half};
}

void include(Box& box, const Box& other) {
  box.min_in_map = box.min_in_map.cwiseMin(other.min_in_map);
  box.max_in_map = box.max_in_map.cwiseMax(other.max_in_map);
}

void include(MapRegion& region, const MapRegion& other) {
  if (region.num_leaves() == 0) region.bounds_in_map = other.bounds_in_map;
  include(region.bounds_in_map, other.bounds_in_map);
  region.leaves.occupied += other.leaves.occupied;
  region.leaves.free += other.leaves.free;
}

MapRegion region_of(const LeafSample& leaf) {
  return {.bounds_in_map = box_of(leaf),
          .leaves = {.occupied = leaf.occupied ? 1U : 0U, .free = leaf.occupied ? 0U : 1U}};
}

using Cube = std::array<std::int32_t, 3>;
/// What lies in each cube that has leaves.
using Parts = std::map<Cube, MapRegion>;

Cube cube_at(const Eigen::Vector3d& point) {
  const Eigen::Array3d cube = (point.array() / kCubeEdgeM).floor();
  return {static_cast<std::int32_t>(cube.x()),
          static_cast<std::int32_t>(cube.y()),
          static_cast<std::int32_t>(cube.z())};
}

Parts parts_of(const LeafSource& leaves) {
  Parts parts;
  auto part = parts.end();  // leaves come place by place
  leaves([&](const LeafSample& leaf) {
    const Cube cube = cube_at(leaf.centre_in_map);
    if (part == parts.end() || part->first != cube) part = parts.try_emplace(cube).first;
    include(part->second, region_of(leaf));
  });
  return parts;
}

/// The parts near enough to one, itself included.
std::vector<Cube> near_parts(const Parts& parts, const Cube& middle) {
  const Box& bounds = parts.at(middle).bounds_in_map;
  std::vector<Cube> near;
  near.reserve(125);
  const auto [x, y, z] = middle;
  for (std::int32_t i = x - kCubeReach; i <= x + kCubeReach; ++i) {
    for (std::int32_t j = y - kCubeReach; j <= y + kCubeReach; ++j) {
      for (std::int32_t k = z - kCubeReach; k <= z + kCubeReach; ++k) {
        const auto part = parts.find(Cube{i, j, k});
        if (part == parts.end()) continue;
        const double gap_m = gap_between_m(bounds, part->second.bounds_in_map);
        if (gap_m < kMaxRegionGapM) near.push_back(part->first);
      }
    }
  }
  return near;
}

struct Group {
  MapRegion region;
  std::vector<Cube> cubes;
};

/// Groups of parts that hang together, the one of most leaves first.
std::vector<Group> groups_of(const Parts& parts) {
  std::vector<Group> groups;
  std::set<Cube> grouped;
  for (const auto& [seed, ignored] : parts) {
    if (!grouped.insert(seed).second) continue;
    Group group{.region = {}, .cubes = {seed}};
    for (std::size_t i = 0; i < group.cubes.size(); ++i) {  // grows while it is walked
      const Cube cube = group.cubes[i];
      include(group.region, parts.at(cube));
      for (const Cube& near : near_parts(parts, cube)) {
        if (grouped.insert(near).second) group.cubes.push_back(near);
      }
    }
    groups.push_back(std::move(group));
  }
  std::stable_sort(groups.begin(), groups.end(), [](const Group& a, const Group& b) {
    return a.region.num_leaves() > b.region.num_leaves();
  });
  return groups;
}

}  // namespace

double gap_between_m(const Box& a, const Box& b) {
  const Eigen::Vector3d gaps =
      (a.min_in_map - b.max_in_map).cwiseMax(b.min_in_map - a.max_in_map).cwiseMax(0.0);
  return gaps.norm();
}

MapRegions MapRegions::find(const LeafSource& leaves) {
  MapRegions found;
  for (const Group& group : groups_of(parts_of(leaves))) {
    for (const Cube& cube : group.cubes) found.region_of_.emplace(cube, found.regions_.size());
    found.regions_.push_back(group.region);
  }
  return found;
}

std::optional<std::size_t> MapRegions::region_at(const Eigen::Vector3d& centre_in_map) const {
  const auto found = region_of_.find(cube_at(centre_in_map));
  return found == region_of_.end() ? std::nullopt : std::optional(found->second);
}

LeafSource leaves_of_largest(LeafSource leaves, MapRegions regions) {
  if (regions.regions().size() < 2) return leaves;
  return [leaves = std::move(leaves), regions = std::move(regions)](const LeafVisitor& visit) {
    leaves([&](const LeafSample& leaf) {
      if (regions.region_at(leaf.centre_in_map) == std::size_t{0}) visit(leaf);
    });
  };
}

}  // namespace hypermap
