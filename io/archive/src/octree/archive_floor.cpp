// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/archive_floor.hpp"

#include "hypermap/octree_semantic/octree/floor_surface.hpp"
#include "hypermap/projection/grids/map_regions.hpp"

#include <array>
#include <cmath>
#include <cstdio>

namespace hypermap {
namespace {

/// A floor so near to where it is assumed lies there: its voxels are to both sides.
constexpr double kNearVoxels = 1.5;
/// Floors that noise and rounding place so near to each other are one.
constexpr double kSameFloorVoxels = 2.0;

}  // namespace

std::optional<double> known_floor_m(const MapArchive& archive) {
  if (archive.floor.source == FloorSource::kStated) return archive.floor.height_m;
  if (!archive.octree) return std::nullopt;
  const LeafSource leaves = leaf_source(*archive.octree);
  return floor_surface_m(*archive.octree, leaves_of_largest(leaves, MapRegions::find(leaves)));
}

MapFloor shown_floor(const MapArchive& archive, const LeafSource& leaves) {
  const MapFloor& floor = archive.floor;
  if (floor.source == FloorSource::kStated) return floor;
  const auto found_m = floor_surface_m(*archive.octree, leaves);
  if (!found_m) return floor;
  const bool is_where_assumed =
      floor.source == FloorSource::kAssumed &&
      std::abs(*found_m - floor.height_m) <= kNearVoxels * archive.octree->resolution_m();
  return is_where_assumed ? floor : MapFloor{.height_m = *found_m, .source = FloorSource::kFound};
}

MapFloor merged_floor(const MapArchive& map, const MapArchive& added) {
  if (map.floor.source == FloorSource::kStated) return map.floor;
  const bool added_states = added.floor.source == FloorSource::kStated;
  if (added_states && !floors_apart_m(map, added)) return added.floor;
  return known_floor_m(map) || !known_floor_m(added) ? map.floor : added.floor;
}

std::optional<double> floors_apart_m(const MapArchive& map, const MapArchive& added) {
  const auto floor_m = known_floor_m(map);
  const auto other_m = known_floor_m(added);
  if (!floor_m || !other_m) return std::nullopt;
  const double apart_m = *other_m - *floor_m;
  const bool are_one = std::abs(apart_m) <= kSameFloorVoxels * map.octree->resolution_m() + 1e-9;
  return are_one ? std::nullopt : std::optional(apart_m);
}

std::string text_of(const MapFloor& floor) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "at z = %.3f m, as ", floor.height_m);
  return text.data() + std::string(name_of(floor.source));
}

}  // namespace hypermap
