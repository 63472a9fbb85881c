// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/octree_semantic/octree/transformed_octree.hpp"

#include "hypermap/core/geometry/lattice_motion.hpp"
#include "octree/brick_access.hpp"

#include <algorithm>
#include <cmath>
#include <new>
#include <vector>

namespace hypermap {
namespace {

constexpr double kMaxRotationError = 1e-6;
/// Of a voxel: what rounding may move a centre, or a corner of a brick.
constexpr double kRounding = 1e-6;

/// Bricks that a brick of the old map reaches into, from `min` to `max` per axis, in bricks.
struct ReachedBricks {
  Eigen::Vector3i min;
  Eigen::Vector3i max;

  [[nodiscard]] bool is_in_volume() const {
    return min.minCoeff() >= 0 && max.maxCoeff() < kKeysPerAxis / kBrickEdge;
  }
};

/// Corners and centres in voxels from the volume's lower corner.
ReachedBricks reached_bricks(const VoxelKey& corner, const Eigen::Isometry3d& new_from_old) {
  Eigen::Vector3d low = Eigen::Vector3d::Constant(1e300);
  Eigen::Vector3d high = -low;
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d offset(
        (i & 1) * kBrickEdge, (i >> 1 & 1) * kBrickEdge, (i >> 2) * kBrickEdge);
    const Eigen::Vector3d moved =
        new_from_old * (Eigen::Vector3d(corner.x, corner.y, corner.z) + offset);
    low = low.cwiseMin(moved);
    high = high.cwiseMax(moved);
  }
  const auto brick_of = [](double voxels) {
    return static_cast<int>(std::floor(std::clamp(voxels, -1e6, 1e6) / kBrickEdge));
  };
  ReachedBricks reached;
  for (int i = 0; i < 3; ++i) {
    reached.min[i] = brick_of(low[i] + kRounding);
    reached.max[i] = brick_of(high[i] - kRounding);
  }
  return reached;
}

/// Ascending, each once. Errors: kLimit outside the volume.
Result<std::vector<BrickKey>> bricks_reached_by(const BrickTable& old,
                                                const Eigen::Isometry3d& new_from_old) {
  std::vector<BrickKey> keys;
  for (std::uint32_t i = 0; i < old.size(); ++i) {
    if (!old.brick(i).known.any()) continue;
    const ReachedBricks reached = reached_bricks(old.key(i).corner(), new_from_old);
    if (!reached.is_in_volume()) {
      return fail(
          ErrorCode::kLimit, "part of the map would lie outside the volume", "map_from_old");
    }
    for (int x = reached.min.x(); x <= reached.max.x(); ++x) {
      for (int y = reached.min.y(); y <= reached.max.y(); ++y) {
        for (int z = reached.min.z(); z <= reached.max.z(); ++z) {
          keys.push_back(BrickKey::of({static_cast<std::uint16_t>(x * kBrickEdge),
                                       static_cast<std::uint16_t>(y * kBrickEdge),
                                       static_cast<std::uint16_t>(z * kBrickEdge)}));
        }
      }
    }
  }
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  return keys;
}

/// The transform between voxels counted from the lower corner of the volume.
Eigen::Isometry3d in_voxels(const Eigen::Isometry3d& map_from_old, double resolution_m) {
  const Eigen::Vector3d origin = Eigen::Vector3d::Constant(kOriginKey);
  Eigen::Isometry3d moved = map_from_old;
  moved.translation() =
      map_from_old.translation() / resolution_m + origin - moved.linear() * origin;
  return moved;
}

/// Each known voxel once. Errors: kLimit outside the volume.
Result<SemanticOctree> moved_voxels(const SemanticOctree& octree, const LatticeMotion& motion) {
  std::vector<StoredLeaf> leaves;
  bool is_in_volume = true;
  octree.for_each_stored_leaf([&](const StoredLeaf& leaf) {
    const Eigen::Vector3d at =
        motion(Eigen::Vector3d(leaf.key.x + 0.5, leaf.key.y + 0.5, leaf.key.z + 0.5));
    is_in_volume &= (at.array() > 0.0 && at.array() < kKeysPerAxis).all();
    if (!is_in_volume) return;
    leaves.push_back(leaf);
    leaves.back().key = {static_cast<std::uint16_t>(at.x()),
                         static_cast<std::uint16_t>(at.y()),
                         static_cast<std::uint16_t>(at.z())};
  });
  if (!is_in_volume) {
    return fail(ErrorCode::kLimit, "part of the map would lie outside the volume", "map_from_old");
  }
  return SemanticOctree::from_leaves(octree.options(), leaves);
}

Result<SemanticOctree> resampled(const SemanticOctree& octree,
                                 const Eigen::Isometry3d& new_from_old) {
  HYPERMAP_ASSIGN_OR_RETURN(const auto keys,
                            bricks_reached_by(BrickAccess::bricks(octree), new_from_old));
  const Eigen::Isometry3d old_from_new = new_from_old.inverse();
  std::vector<StoredLeaf> leaves;
  for (const BrickKey brick : keys) {
    for (std::size_t cell = 0; cell < kBrickVolume; ++cell) {
      const VoxelKey key = brick.voxel(cell);
      const Eigen::Vector3d centre(key.x + 0.5, key.y + 0.5, key.z + 0.5);
      const Eigen::Vector3d was = old_from_new * centre;
      if (was.minCoeff() < 0.0 || was.maxCoeff() >= kKeysPerAxis) continue;
      auto leaf = octree.stored_at({static_cast<std::uint16_t>(was.x()),
                                    static_cast<std::uint16_t>(was.y()),
                                    static_cast<std::uint16_t>(was.z())});
      if (!leaf) continue;
      leaf->key = key;
      leaves.push_back(*leaf);
    }
  }
  return SemanticOctree::from_leaves(octree.options(), leaves);
}

}  // namespace

Result<SemanticOctree> transformed(const SemanticOctree& octree,
                                   const MapFromOldMap& map_from_old) {
  if (!is_rigid(map_from_old.isometry(), kMaxRotationError)) {
    return fail(ErrorCode::kInvalidArgument, "must be a finite rigid motion", "map_from_old");
  }
  try {
    const auto new_from_old = in_voxels(map_from_old.isometry(), octree.resolution_m());
    const auto upright = LatticeMotion::of(new_from_old);
    return upright ? moved_voxels(octree, *upright) : resampled(octree, new_from_old);
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::kOutOfMemory, "no memory for another map");
  }
}

}  // namespace hypermap
