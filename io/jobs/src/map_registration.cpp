// SPDX-License-Identifier: BSD-3-Clause
#include "map_registration.hpp"

#include "hypermap/grid_registration/grid_registration.hpp"
#include "hypermap/io/archive/archive_floor.hpp"
#include "hypermap/projection/grids/occupancy_projection.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <string>
#include <vector>

namespace hypermap {
namespace {

constexpr std::size_t kMaxComparedVoxels = 50'000;
constexpr double kMaxHeightShiftM = 0.3;
constexpr double kMinMeetingShare = 2.0 / 3.0;

Result<LogOddsGrid> grid_of(const SemanticOctree& octree,
                            double floor_m,
                            const LayerOptions& options) {
  HYPERMAP_ASSIGN_OR_RETURN(
      const OccupancyGrid occupancy,
      project_occupancy(
          leaf_source(octree),
          over({.height_m = floor_m},
               {.min_m = options.min_height_m, .max_m = options.max_height_m}),
          {.min_free_share = options.min_free_share, .max_unseen_m = options.max_unseen_m}));
  return LogOddsGrid::of_occupancy(occupancy);
}

/// Centres of occupied voxels, spread evenly.
std::vector<Eigen::Vector3d> occupied_points(const SemanticOctree& octree) {
  std::vector<Eigen::Vector3d> all;
  all.reserve(octree.num_leaves().occupied);
  octree.for_each_leaf([&](const LeafSample& leaf) {
    if (leaf.occupied) all.push_back(leaf.centre_in_map);
  });
  const std::size_t count = std::min(all.size(), kMaxComparedVoxels);
  std::vector<Eigen::Vector3d> points;
  points.reserve(count);
  for (std::size_t i = 0; i < count; ++i) points.push_back(all[i * all.size() / count]);
  return points;
}

enum class Around { kUnknown, kFree, kOccupied };

/// What the voxel of a point and those beside it are.
Around around(const SemanticOctree& octree, const Eigen::Vector3d& point) {
  Around found = Around::kUnknown;
  for (int i = 0; i < 27; ++i) {
    const Eigen::Vector3i step(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
    const auto leaf = octree.at(PointInMap{point + octree.resolution_m() * step.cast<double>()});
    if (!leaf) continue;
    if (leaf->occupied) return Around::kOccupied;
    found = Around::kFree;
  }
  return found;
}

/// Share of the points where the map knows something that meet occupied voxels; 0 without any.
double occupied_share(const std::vector<Eigen::Vector3d>& points,
                      const Eigen::Isometry3d& fixed_from_moving,
                      const SemanticOctree& fixed) {
  std::size_t num_known = 0;
  std::size_t num_occupied = 0;
  for (const Eigen::Vector3d& point : points) {
    const Around there = around(fixed, fixed_from_moving * point);
    num_known += there == Around::kUnknown ? 0U : 1U;
    num_occupied += there == Around::kOccupied ? 1U : 0U;
  }
  return num_known == 0 ? 0.0 : static_cast<double>(num_occupied) / static_cast<double>(num_known);
}

/// Share of the points in voxels that are occupied themselves: sharper than with those beside.
double exact_share(const std::vector<Eigen::Vector3d>& points,
                   const Eigen::Isometry3d& fixed_from_moving,
                   const SemanticOctree& fixed) {
  const auto met = std::ranges::count_if(points, [&](const Eigen::Vector3d& point) {
    const auto leaf = fixed.at(PointInMap{fixed_from_moving * point});
    return leaf && leaf->occupied;
  });
  return static_cast<double>(met) / static_cast<double>(std::max<std::size_t>(points.size(), 1));
}

/// The placement raised or lowered to where most occupied voxels meet; of equals the nearest to
/// `placement.z_m`, which is a multiple of a voxel.
WorldPlacement at_best_height(WorldPlacement placement,
                              const std::vector<Eigen::Vector3d>& points,
                              const SemanticOctree& fixed) {
  const double step_m = fixed.resolution_m();
  const int most = static_cast<int>(kMaxHeightShiftM / step_m);
  const double given_m = placement.z_m;
  WorldPlacement best = placement;
  double best_share = exact_share(points, isometry_of(placement), fixed);
  for (int i = 1; i <= 2 * most; ++i) {
    const int steps = i % 2 == 1 ? (i + 1) / 2 : -i / 2;  // 1, -1, 2, -2 ...
    placement.z_m = given_m + steps * step_m;
    const double share = exact_share(points, isometry_of(placement), fixed);
    if (share <= best_share) continue;
    best_share = share;
    best = placement;
  }
  return best;
}

/// Of a map that shows no floor and was not moved in height it is where the other one's is.
double likely_floor_m(const MapArchive& map, const MapArchive& other) {
  if (const auto known_m = known_floor_m(map)) return *known_m;
  if (map.floor != MapFloor{}) return map.floor.height_m;
  return known_floor_m(other).value_or(0.0);
}

std::string percent(double share) {
  return std::to_string(std::lround(100.0 * share)) + " %";
}

}  // namespace

Result<MapPlacement> register_maps(const MapArchive& moving_map,
                                   const MapArchive& fixed_map,
                                   const LayerOptions& options) {
  const SemanticOctree& moving = *moving_map.octree;
  const SemanticOctree& fixed = *fixed_map.octree;
  const double moving_floor_m = likely_floor_m(moving_map, fixed_map);
  const double fixed_floor_m = likely_floor_m(fixed_map, moving_map);
  const double step_m = fixed.resolution_m();
  HYPERMAP_ASSIGN_OR_RETURN(const LogOddsGrid moving_grid,
                            grid_of(moving, moving_floor_m, options));
  HYPERMAP_ASSIGN_OR_RETURN(const LogOddsGrid fixed_grid, grid_of(fixed, fixed_floor_m, options));
  HYPERMAP_ASSIGN_OR_RETURN(const GridRegistration found, register_grids(moving_grid, fixed_grid));
  const Eigen::Matrix3d& motion = found.fixed_from_moving;
  const auto points = occupied_points(moving);
  const WorldPlacement placement =
      at_best_height({.x_m = motion(0, 2),
                      .y_m = motion(1, 2),
                      .z_m = step_m * std::round((fixed_floor_m - moving_floor_m) / step_m),
                      .yaw_rad = std::atan2(motion(1, 0), motion(0, 0))},
                     points,
                     fixed);
  const MapPlacement out{.placement = placement,
                         .overlap = found.overlap,
                         .agreement = found.agreement,
                         .occupied_share = occupied_share(points, isometry_of(placement), fixed)};
  if (out.occupied_share >= kMinMeetingShare) return out;
  return fail(ErrorCode::kNotFound,
              "seen from above the maps fit, but of the occupied voxels where both know something "
              "only " +
                  percent(out.occupied_share) + " meet, must be two thirds",
              "voxels");
}

}  // namespace hypermap
