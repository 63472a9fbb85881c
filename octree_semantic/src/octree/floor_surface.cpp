// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/octree_semantic/octree/floor_surface.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

constexpr double kLeastAreaM2 = 2.0;
constexpr double kLeastShareOfLargest = 0.1;
/// Free space that noise, glass and steps leave below a floor, as a height over all of it.
constexpr double kMostFreeBelowM = 0.2;
/// Depth is wrong by a voxel: a surface lies in as many levels to each side of its own.
constexpr std::size_t kNoiseLevels = 1;
constexpr double kStepsPerM = 1000.0;  ///< Of the answer.

/// The lines down around a sensor: so many to each side, so far apart and so long.
constexpr int kLinesToSide = 12;
constexpr double kLineGapM = 0.16;
constexpr double kLineLengthM = 3.0;
/// So many of them a floor ends, and between which heights, in voxels.
constexpr std::size_t kLeastLines = 12;
constexpr double kFloorVoxels = 1.5;

/// How much of one level of voxels the map knows.
struct Level {
  std::size_t num_tops = 0;  ///< Occupied below a free one.
  std::size_t num_free = 0;
};

bool is_top(const SemanticOctree& octree, const VoxelKey& key) {
  if (key.z == std::numeric_limits<std::uint16_t>::max()) return false;
  const auto above =
      octree.at(VoxelKey{.x = key.x, .y = key.y, .z = static_cast<std::uint16_t>(key.z + 1)});
  return above && !above->occupied;
}

/// By the keys of z.
std::vector<Level> levels_of(const SemanticOctree& octree, const LeafSource& leaves) {
  std::vector<Level> levels(kKeysPerAxis);
  leaves([&](const LeafSample& leaf) {
    const auto key = octree.grid().key(PointInMap{leaf.centre_in_map});
    if (!key) return;
    Level& level = levels[key->z];
    if (!leaf.occupied) {
      ++level.num_free;
    } else if (is_top(octree, *key)) {
      ++level.num_tops;
    }
  });
  return levels;
}

/// Of the level and those that noise reaches.
std::size_t tops_around(const std::vector<Level>& levels, std::size_t z) {
  std::size_t sum = 0;
  for (std::size_t i = z - kNoiseLevels; i <= z + kNoiseLevels; ++i) sum += levels[i].num_tops;
  return sum;
}

/// The lowest level around which at least `least` voxels are tops: of those that noise joins to it
/// the fullest, with what is around it and then by itself. `tops`: tops_around each level.
std::optional<std::size_t> lowest_level(const std::vector<Level>& levels,
                                        const std::vector<std::size_t>& tops,
                                        double least) {
  const auto found = std::ranges::find_if(
      tops, [&](std::size_t count) { return static_cast<double>(count) >= least; });
  if (found == tops.end()) return std::nullopt;
  const auto first = static_cast<std::size_t>(found - tops.begin());
  std::size_t best = first;
  for (std::size_t z = first; z <= first + 2 * kNoiseLevels && z < tops.size(); ++z) {
    const auto fullness = [&](std::size_t i) { return std::pair(tops[i], levels[i].num_tops); };
    if (fullness(z) > fullness(best)) best = z;
  }
  return best;
}

/// Mean height of the tops around a level.
double height_m(const std::vector<Level>& levels, std::size_t z, const VoxelGrid& grid) {
  double sum_m = 0.0;
  for (std::size_t i = z - kNoiseLevels; i <= z + kNoiseLevels; ++i) {
    sum_m += static_cast<double>(levels[i].num_tops) * grid.centre_m(static_cast<std::uint16_t>(i));
  }
  return sum_m / static_cast<double>(tops_around(levels, z));
}

/// Where lines down around a sensor first meet something that is of no object, ascending: tops of
/// voxels.
std::vector<double> heights_below_m(const SemanticOctree& octree, const PointInMap& sensor) {
  std::vector<double> heights_m;
  for (int x = -kLinesToSide; x <= kLinesToSide; ++x) {
    for (int y = -kLinesToSide; y <= kLinesToSide; ++y) {
      const Eigen::Vector3d from = sensor.xyz + kLineGapM * Eigen::Vector3d(x, y, 0.0);
      const RayCast ray = octree.cast_ray(
          PointInMap{from}, -Eigen::Vector3d::UnitZ(), {.max_range_m = kLineLengthM});
      const bool is_hit = ray.outcome == RayCast::Outcome::kHit && ray.distance_m > 0.0;
      if (is_hit && octree.at(ray.key)->object == kNoObject)
        heights_m.push_back(from.z() - ray.distance_m);
    }
  }
  std::ranges::sort(heights_m);
  return heights_m;
}

}  // namespace

std::optional<double> floor_below_m(const SemanticOctree& octree, const PointInMap& sensor) {
  const std::vector<double> tops_m = heights_below_m(octree, sensor);
  const double voxel_m = octree.resolution_m();
  for (std::size_t i = 0; i + kLeastLines <= tops_m.size(); ++i) {
    if (tops_m[i + kLeastLines - 1] - tops_m[i] < kFloorVoxels * voxel_m)
      return tops_m[i + kLeastLines / 2] - voxel_m / 2.0;
  }
  return std::nullopt;
}

std::optional<double> floor_surface_m(const SemanticOctree& octree, const LeafSource& leaves) {
  const double voxel_m = octree.resolution_m();
  const std::vector<Level> levels = levels_of(octree, leaves);
  std::vector<std::size_t> tops(levels.size(), 0);
  for (std::size_t z = kNoiseLevels; z + kNoiseLevels < levels.size(); ++z) {
    tops[z] = tops_around(levels, z);
  }
  const double least =
      std::max(kLeastAreaM2 / (voxel_m * voxel_m),
               kLeastShareOfLargest * static_cast<double>(*std::ranges::max_element(tops)));
  const auto floor = lowest_level(levels, tops, least);
  if (!floor) return std::nullopt;
  std::size_t num_free_below = 0;
  for (std::size_t z = 0; z + kNoiseLevels < *floor; ++z) num_free_below += levels[z].num_free;
  const double free_below_m =
      voxel_m * static_cast<double>(num_free_below) / static_cast<double>(tops[*floor]);
  if (free_below_m > kMostFreeBelowM) return std::nullopt;
  return std::round(kStepsPerM * height_m(levels, *floor, octree.grid())) / kStepsPerM;
}

}  // namespace hypermap
