// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/octree_semantic/octree/semantic_octree.hpp"
#include "octree/brick_table.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace hypermap {
namespace {

/// Steps along a ray from voxel to voxel by their faces.
/// Source: J. Amanatides and A. Woo, "A fast voxel traversal algorithm", Eurographics 1987.
class VoxelWalk {
 public:
  /// Requires: `direction` of length 1.
  VoxelWalk(const VoxelGrid& grid,
            const VoxelKey& start,
            const Eigen::Vector3d& origin,
            const Eigen::Vector3d& direction)
      : key_{start.x, start.y, start.z} {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto axis = static_cast<Eigen::Index>(i);
      step_[i] = direction[axis] > 0.0 ? 1 : direction[axis] < 0.0 ? -1 : 0;
      if (step_[i] == 0) continue;
      const double face_m =
          grid.centre_m(static_cast<std::uint16_t>(key_[i])) + 0.5 * step_[i] * grid.resolution_m();
      next_m_[i] = (face_m - origin[axis]) / direction[axis];
      per_voxel_m_[i] = grid.resolution_m() / std::abs(direction[axis]);
    }
  }

  [[nodiscard]] VoxelKey key() const {
    return {static_cast<std::uint16_t>(key_[0]),
            static_cast<std::uint16_t>(key_[1]),
            static_cast<std::uint16_t>(key_[2])};
  }
  /// Where the ray entered the present voxel; 0 in the first one.
  [[nodiscard]] double distance_m() const { return distance_m_; }

  /// False when the ray left the volume.
  bool advance() {
    std::size_t axis = next_m_[0] <= next_m_[1] ? 0 : 1;
    if (next_m_[2] < next_m_[axis]) axis = 2;
    distance_m_ = next_m_[axis];
    next_m_[axis] += per_voxel_m_[axis];
    key_[axis] += step_[axis];
    return key_[axis] >= 0 && key_[axis] < kKeysPerAxis;
  }

 private:
  static constexpr double kNever = std::numeric_limits<double>::infinity();
  std::array<int, 3> key_;
  std::array<int, 3> step_{};
  std::array<double, 3> next_m_{kNever, kNever, kNever};
  std::array<double, 3> per_voxel_m_{};
  double distance_m_ = 0.0;
};

}  // namespace

RayCast SemanticOctree::cast_ray(const PointInMap& origin,
                                 const Eigen::Vector3d& direction_in_map,
                                 const RayCastOptions& options) const {
  const auto start = grid_.key(origin);
  const double length = direction_in_map.norm();
  if (!start || !std::isfinite(length) || !(length > 0.0)) return {};
  VoxelWalk walk(grid_, *start, origin.xyz, direction_in_map / length);
  BrickKey brick_key = BrickKey::of(*start);
  const Brick* brick = bricks_->find(brick_key);
  do {
    const VoxelKey key = walk.key();
    if (const BrickKey entered = BrickKey::of(key); entered != brick_key) {
      brick_key = entered;
      brick = bricks_->find(entered);
    }
    const std::size_t cell = cell_in_brick(key);
    if (brick != nullptr && brick->occupied.test(cell)) {
      return {RayCast::Outcome::kHit, key, walk.distance_m()};
    }
    if (options.stop_at_unknown && (brick == nullptr || !brick->known.test(cell))) {
      return {RayCast::Outcome::kUnknown, key, walk.distance_m()};
    }
  } while (walk.advance() && walk.distance_m() <= options.max_range_m);
  return {};
}

}  // namespace hypermap
