// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/viewer_offscreen/rendering/cutaway.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <map>

namespace hypermap {
namespace {

constexpr double kLevelShare = 0.25;
constexpr double kUsualCutM = 2.2;
constexpr double kLowestCeilingM = 1.6;

/// Number of voxels by the height of their centre, in units of the finest edge.
std::map<std::int64_t, std::size_t> count_levels(std::span<const OccupiedVoxel> voxels,
                                                 double edge_m) {
  std::map<std::int64_t, std::size_t> count;
  for (const OccupiedVoxel& voxel : voxels) {
    ++count[static_cast<std::int64_t>(
        std::floor(static_cast<double>(voxel.centre_in_map.z()) / edge_m))];
  }
  return count;
}

std::size_t fullest(const std::map<std::int64_t, std::size_t>& levels) {
  std::size_t most = 0;
  for (const auto& [level, count] : levels) most = std::max(most, count);
  return most;
}

bool spreads(std::size_t count, std::size_t reference) {
  return static_cast<double>(count) >= kLevelShare * static_cast<double>(reference);
}

/// A place in the plan as the eye sees it: which line of sight, and how far along it.
struct ViewRayPlace {
  std::int64_t lane = 0;
  double towards_eye_m = 0.0;
};

/// Finds the walls that stand between the eye and the room.
class NearWalls {
 public:
  NearWalls(std::span<const OccupiedVoxel> voxels, const CutawayOptions& options)
      : options_(options), lane_m_(1.5 * static_cast<double>(finest_edge_m(voxels))) {
    if (!options.towards_eye) return;
    for (const OccupiedVoxel& voxel : voxels) note(voxel);
    std::erase_if(lanes_, [&](const auto& lane) {
      return lane.second.wall_m - lane.second.farthest_m < options_.room_behind_m;
    });
  }

  [[nodiscard]] bool hides(const OccupiedVoxel& voxel) const {
    if (lanes_.empty() || voxel.class_id.has_value()) return false;
    if (height_m(voxel) <= options_.wall_stump_m) return false;
    const ViewRayPlace place = place_of(voxel);
    return place.towards_eye_m >= wall_near(place.lane) - options_.wall_depth_m;
  }

 private:
  static constexpr double kNowhere = std::numeric_limits<double>::infinity();

  /// What a line of sight meets, as distances towards the eye.
  struct Lane {
    double wall_m = -kNowhere;     ///< The nearest column as high as a wall.
    double farthest_m = kNowhere;  ///< The farthest voxel of all.
  };

  [[nodiscard]] double height_m(const OccupiedVoxel& voxel) const {
    return static_cast<double>(voxel.centre_in_map.z()) - options_.floor_m;
  }
  [[nodiscard]] ViewRayPlace place_of(const OccupiedVoxel& voxel) const {
    const Eigen::Vector2d plan = voxel.centre_in_map.head<2>().cast<double>();
    const Eigen::Vector2d& towards = *options_.towards_eye;
    const Eigen::Vector2d across(-towards.y(), towards.x());
    return {static_cast<std::int64_t>(std::floor(plan.dot(across) / lane_m_)), plan.dot(towards)};
  }

  void note(const OccupiedVoxel& voxel) {
    const ViewRayPlace place = place_of(voxel);
    Lane& lane = lanes_[place.lane];
    lane.farthest_m = std::min(lane.farthest_m, place.towards_eye_m);
    if (voxel.class_id || height_m(voxel) < options_.wall_from_m) return;
    lane.wall_m = std::max(lane.wall_m, place.towards_eye_m);
  }

  /// Where the wall stands on this line of sight; beside a gap, where it would stand.
  [[nodiscard]] double wall_near(std::int64_t lane) const {
    double wall_m = -kNowhere;
    for (std::int64_t near = lane - 1; near <= lane + 1; ++near) {
      const auto found = lanes_.find(near);
      if (found != lanes_.end()) wall_m = std::max(wall_m, found->second.wall_m);
    }
    if (std::isinf(wall_m)) return kNowhere;
    return wall_m;
  }

  CutawayOptions options_;
  double lane_m_;
  std::map<std::int64_t, Lane> lanes_;  ///< Those with a wall in the way.
};

}  // namespace

double floor_height_m(std::span<const OccupiedVoxel> voxels) {
  const double edge_m = static_cast<double>(finest_edge_m(voxels));
  const auto levels = count_levels(voxels, edge_m);
  const std::size_t most = fullest(levels);
  for (const auto& [level, count] : levels) {
    if (spreads(count, most)) return static_cast<double>(level) * edge_m;
  }
  return 0.0;
}

double ceiling_cut_m(std::span<const OccupiedVoxel> voxels, double floor_m) {
  const double edge_m = static_cast<double>(finest_edge_m(voxels));
  const auto levels = count_levels(voxels, edge_m);
  const std::size_t floor_count = fullest(levels);
  for (const auto& [level, count] : levels) {
    const double below_m = static_cast<double>(level) * edge_m - floor_m;
    if (below_m > kUsualCutM) return kUsualCutM;
    if (below_m > kLowestCeilingM && spreads(count, floor_count)) return below_m - edge_m;
  }
  return std::numeric_limits<double>::infinity();
}

std::vector<OccupiedVoxel> cut_away(std::span<const OccupiedVoxel> voxels,
                                    const CutawayOptions& options) {
  const double highest_m = options.floor_m + options.cut_above_m;
  std::vector<OccupiedVoxel> low;
  low.reserve(voxels.size());
  std::copy_if(voxels.begin(), voxels.end(), std::back_inserter(low), [&](const auto& voxel) {
    return static_cast<double>(voxel.centre_in_map.z()) <= highest_m;
  });
  const NearWalls walls(low, options);
  std::erase_if(low, [&](const OccupiedVoxel& voxel) { return walls.hides(voxel); });
  return low;
}

}  // namespace hypermap
