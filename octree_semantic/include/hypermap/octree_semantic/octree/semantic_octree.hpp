// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What is known of space: for each voxel whether it is occupied, of which class and object.
///
/// OctoMap's model (keys, log-odds, clamping, threshold) stored in bricks of 8 x 8 x 8 voxels that
/// are found by the key of their corner. FrameIntegrator writes it.
/// Source: A. Hornung et al., "OctoMap", Autonomous Robots 34 (2013).
#pragma once

#include "hypermap/core/base/cow_ref.hpp"
#include "hypermap/core/base/ids.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/box.hpp"
#include "hypermap/core/geometry/frames.hpp"
#include "hypermap/core/geometry/leaf.hpp"
#include "hypermap/octree_semantic/octree/revision.hpp"
#include "hypermap/octree_semantic/octree/sensor_model.hpp"
#include "hypermap/octree_semantic/octree/voxel_grid.hpp"
#include "hypermap/octree_semantic/octree/voxel_key.hpp"
#include "hypermap/octree_semantic/octree/voxel_label.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace hypermap {

struct OptionTable;

struct OctreeOptions {
  double resolution_m = 0.05;         ///< Edge of a voxel.
  SensorModelOptions sensor_model{};  ///< OctoMap's defaults.
  /// Class evidence of a voxel saturates at +- this.
  LogOdds max_class_log_odds{10.0};
  friend bool operator==(const OctreeOptions&, const OctreeOptions&) = default;
};
/// Errors: kInvalidArgument naming the field.
[[nodiscard]] Result<void> validate(const OctreeOptions& options);
[[nodiscard]] const OptionTable& option_table(const OctreeOptions& options);

/// All that the map keeps of one known voxel, exactly: for archives.
struct StoredLeaf {
  VoxelKey key;
  MilliLogOdds log_odds = 0;
  std::optional<VoxelLabel> label{};
  friend bool operator==(const StoredLeaf&, const StoredLeaf&) = default;
};
using StoredLeafVisitor = std::function<void(const StoredLeaf&)>;
using LabelVisitor = std::function<void(const VoxelLabel&)>;

/// What a ray met in the map.
struct RayCast {
  enum class Outcome : std::uint8_t {
    kHit,      ///< An occupied voxel.
    kUnknown,  ///< A voxel of which nothing is known, and the ray was to stop there.
    kNothing,  ///< Nothing up to the range or to the end of the map's volume.
  };
  Outcome outcome = Outcome::kNothing;
  VoxelKey key;             ///< The voxel hit or unknown; meaningless for kNothing.
  double distance_m = 0.0;  ///< To where the ray enters that voxel; 0 when it starts inside.
};

struct RayCastOptions {
  double max_range_m = 10.0;     ///< > 0, may be infinite.
  bool stop_at_unknown = false;  ///< Else unknown space is seen through.
};

struct Brick;
class BrickTable;

/// The 3D map. A value: a copy shares all memory until one of the two is written, and then what is
/// not written. One that was moved from may only be assigned to or destroyed.
///
/// Cost: a copy is one atomic increment, at any size of the map. A frame that is written while a
/// copy is alive copies the bricks that it touches, once, and one reference for each 1,024 bricks.
/// Threads: const functions may run concurrently; a copy made before may be read, copied and
/// destroyed while the original is written.
class SemanticOctree {
 public:
  SemanticOctree(const SemanticOctree& other) noexcept;
  SemanticOctree(SemanticOctree&& other) noexcept;
  SemanticOctree& operator=(const SemanticOctree& other) noexcept;
  SemanticOctree& operator=(SemanticOctree&& other) noexcept;
  ~SemanticOctree();

  /// Errors: those of `validate`; kOutOfMemory.
  [[nodiscard]] static Result<SemanticOctree> create(const OctreeOptions& options);
  /// Errors: those of `validate`, of `set_leaf`, and kInvalidArgument when a key occurs twice.
  [[nodiscard]] static Result<SemanticOctree> from_leaves(const OctreeOptions& options,
                                                          std::span<const StoredLeaf> leaves);

  [[nodiscard]] const OctreeOptions& options() const noexcept { return options_; }
  [[nodiscard]] const VoxelGrid& grid() const noexcept { return grid_; }
  [[nodiscard]] double resolution_m() const noexcept { return grid_.resolution_m(); }
  [[nodiscard]] const SensorModel& sensor_model() const noexcept { return model_; }

  /// What is known at a point; none where nothing is known or outside the volume.
  /// Class and object are given for occupied voxels only: empty space belongs to nothing.
  [[nodiscard]] std::optional<LeafSample> at(const PointInMap& point) const;
  [[nodiscard]] std::optional<LeafSample> at(const VoxelKey& key) const;
  [[nodiscard]] std::optional<StoredLeaf> stored_at(const VoxelKey& key) const;

  /// Visits every known voxel, in Morton order. Cost: sorts the bricks' keys, then linear.
  void for_each_leaf(const LeafVisitor& visit) const;
  void for_each_stored_leaf(const StoredLeafVisitor& visit) const;
  /// Visits the labels of all voxels that have one, blank ones too, in an order of its own.
  /// Cost: one step for each brick, then what is labelled.
  void for_each_label(const LabelVisitor& visit) const;
  /// Known voxels whose centre lies in the closed box, in Morton order.
  void for_each_leaf_in(const Box& box_in_map, const LeafVisitor& visit) const;
  /// Occupied voxels whose best class is `id`, in Morton order.
  void for_each_leaf_of(ClassId id, const LeafVisitor& visit) const;
  /// Occupied voxels of an object, in Morton order; `bounds_in_map` spares a look at all others.
  void for_each_leaf_of(ObjectId id, const Box& bounds_in_map, const LeafVisitor& visit) const;
  void for_each_leaf_of(ObjectId id, const LeafVisitor& visit) const;

  /// The first occupied voxel along a ray.
  ///
  /// Boundary: starts in an occupied voxel: a hit at distance 0. A ray through a corner passes from
  /// voxel to voxel by faces, x before y before z. Starts outside the volume, or no finite
  /// direction: kNothing.
  [[nodiscard]] RayCast cast_ray(const PointInMap& origin,
                                 const Eigen::Vector3d& direction_in_map,
                                 const RayCastOptions& options = {}) const;

  [[nodiscard]] LeafCount num_leaves() const;
  [[nodiscard]] bool empty() const { return num_leaves() == LeafCount{}; }
  /// Cubes of 8 x 8 x 8 voxels of which some voxel was written once.
  [[nodiscard]] std::size_t num_bricks() const noexcept;
  /// Heap and table; what is shared with a copy counted in full, the one brick that all free space
  /// of this tree shares counted once.
  [[nodiscard]] std::size_t memory_bytes() const;

  /// Replaces one voxel. Errors: kInvalidArgument when the log-odds lie beyond the clamps of the
  /// sensor model or the label breaks its rules; kOutOfMemory.
  [[nodiscard]] Result<void> set_leaf(const StoredLeaf& leaf);
  /// The same for many, in one revision; when one is refused none is written, when memory ends
  /// those before it are. Boundary: no leaf, no revision. Cost: voxels of one cube of 8 x 8 x 8
  /// that follow each other share the search for it.
  [[nodiscard]] Result<void> set_leaves(std::span<const StoredLeaf> leaves);
  /// Voxels of object `from` within the box become voxels of `to` (kNoObject: of none). Returns how
  /// many. Give the object's box, grown by a voxel. Throws std::bad_alloc, here and below; voxels
  /// that have changed by then stay so, and another call goes on with the others.
  std::size_t relabel_object(ObjectId from, ObjectId to, const Box& bounds_in_map);
  std::size_t relabel_object(ObjectId from, ObjectId to);
  /// Voxels of all objects for which `is_gone` says so become voxels of none. Returns how many.
  /// Cost: one pass, whatever the number of objects.
  std::size_t forget_objects(const std::function<bool(ObjectId)>& is_gone);
  /// Divides the voxels of object `from` between it and `to`: those within the box for which
  /// `moves` says so become voxels of `to`, with their votes. Returns how many.
  std::size_t divide_object(ObjectId from,
                            ObjectId to,
                            const Box& bounds_in_map,
                            const std::function<bool(const VoxelKey&)>& moves);
  /// Divides them by two sets of points: a voxel goes to `to` when its centre is nearer to a point
  /// of `of_to` than to any of `of_from`; of equals it stays. Returns how many went.
  /// Boundary: all stay when `of_to` is empty, else all go when `of_from` is.
  /// Cost: voxels of the object times points.
  std::size_t divide_object(ObjectId from,
                            ObjectId to,
                            std::span<const Eigen::Vector3f> of_from,
                            std::span<const Eigen::Vector3f> of_to);

  [[nodiscard]] Revision revision() const noexcept;
  /// Where something was written after the moment `since`: for those who publish what is new. Cubes
  /// of 8 x 8 x 8 voxels, in Morton order.
  ///
  /// Boundary: `since` = 0 gives all that was ever written; a region that was only seen once more
  /// may be among them; free space that could not become any freer is not.
  /// Cost: one step for each 1,024 bricks of the map, then what was written.
  [[nodiscard]] std::vector<Box> changed_regions(Revision since) const;

  /// Same options and same known voxels with the same content, however the bricks came to be; a
  /// blank label is none.
  friend bool operator==(const SemanticOctree& a, const SemanticOctree& b);

 private:
  friend struct BrickAccess;
  SemanticOctree(const OctreeOptions& options, const SensorModel& model);
  [[nodiscard]] LeafSample sample(const VoxelKey& key, const Brick& brick, std::size_t cell) const;
  /// Labelled voxels within the box become voxels of what `object_of` says of them. Returns how
  /// many changed.
  std::size_t relabel(const Box& bounds_in_map,
                      const std::function<ObjectId(const VoxelKey&, ObjectId)>& object_of);

  OctreeOptions options_;
  VoxelGrid grid_;
  SensorModel model_;
  CowRef<BrickTable> bricks_;
};

/// The tree as others see it; `tree` must outlive the result.
[[nodiscard]] LeafSource leaf_source(const SemanticOctree& tree);

}  // namespace hypermap
