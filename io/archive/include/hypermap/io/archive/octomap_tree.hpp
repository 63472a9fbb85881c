// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What an OctoMap file holds: leaves of any size, as values.
///
/// Source: A. Hornung et al., "OctoMap", Autonomous Robots 34 (2013), section 4.
#pragma once

#include "hypermap/core/base/image.hpp"
#include "hypermap/core/base/load_budget.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/leaf.hpp"
#include "hypermap/octree_semantic/octree/semantic_octree.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace hypermap {

enum class OctomapKind : std::uint8_t {
  kOccupancy,  ///< `OcTree`, and every `.bt`.
  kColor,      ///< `ColorOcTree`.
  kSemantic,   ///< `SemanticOcTree`: our type, see write_octomap.
};

/// A known cube of space: one voxel at depth 16, 2^(16 - depth) voxels along each edge above it.
struct OctomapLeaf {
  static constexpr std::uint8_t kVoxelDepth = 16;
  static constexpr std::uint32_t kNoLabel = 0xFFFFFFFF;

  VoxelKey key = {};  ///< Of the voxel at the lower corner.
  std::uint8_t depth = kVoxelDepth;
  float log_odds = 0.0F;
  std::uint32_t label = kNoLabel;  ///< Index into OctomapTree::labels.

  [[nodiscard]] std::uint32_t edge_voxels() const noexcept { return 1U << (kVoxelDepth - depth); }
  [[nodiscard]] std::uint64_t num_voxels() const noexcept {
    return std::uint64_t{1} << (3U * static_cast<unsigned>(kVoxelDepth - depth));
  }
  friend bool operator==(const OctomapLeaf&, const OctomapLeaf&) = default;
};

/// A tree without its inner nodes, whose values follow from the leaves. Inner nodes that have no
/// known child are not known either.
struct OctomapTree {
  OctomapKind kind = OctomapKind::kOccupancy;
  double resolution_m = 0.05;
  std::vector<OctomapLeaf> leaves = {};  ///< In Morton order, disjoint.
  std::vector<Rgb8> colors = {};         ///< kColor: one per leaf; white means none. Else empty.
  std::vector<VoxelLabel> labels = {};   ///< kSemantic: those that leaves point to. Else empty.
  friend bool operator==(const OctomapTree&, const OctomapTree&) = default;
};

/// The lower corner, in voxels from the lower corner of the map's volume, is aligned to the edge of
/// the leaf, log-odds are finite and within +-32.767, leaves ascend and are disjoint, colours and
/// labels are as many as said. Errors: kInvalidArgument naming the leaf.
[[nodiscard]] Result<void> validate(const OctomapTree& tree);

/// Leaves as they are, large ones not split. A leaf is occupied at log-odds of 0 and more,
/// OctoMap's own threshold. Requires: `tree` outlives the source.
[[nodiscard]] LeafSource leaf_source(const OctomapTree& tree);

/// The map as a tree of our type, leaves of equal content merged eight by eight as OctoMap prunes,
/// up to the size of a brick, so that what is written stays within OctreeConversionOptions. A blank
/// label counts as none.
[[nodiscard]] OctomapTree to_octomap_tree(const SemanticOctree& octree);

/// The same space as occupied (log-odds 1) or free (-1) alone, without labels; eight siblings alike
/// become their parent.
[[nodiscard]] OctomapTree occupied_or_free(const OctomapTree& tree);
/// The leaves of a source, in its order, as a tree of voxels of `resolution_m` without labels,
/// pruned. Requires: Morton order, edges of 2^n voxels.
[[nodiscard]] OctomapTree occupancy_tree(const LeafSource& leaves, double resolution_m);
/// The same in colour: that of each occupied leaf's class by its id, grey where something
/// unlabelled or of a class beyond `colors` stands, white, OctoMap's "no colour", in empty space.
[[nodiscard]] OctomapTree class_color_tree(const LeafSource& leaves,
                                           double resolution_m,
                                           std::span<const Rgb8> colors);

/// Large leaves are split, so a file of a few bytes could ask for any amount of memory. Recorded
/// maps have 3 to 12 voxels a leaf.
struct OctreeConversionOptions {
  std::uint64_t max_voxels = std::uint64_t{1} << 31U;  ///< In all.
  std::uint64_t max_voxels_per_leaf = 512;             ///< On average; checked beyond the next.
  std::uint64_t unchecked_voxels = std::uint64_t{1} << 22U;  ///< 9 MB of bricks, a second.
};

/// A map of our own: large leaves are split into voxels, log-odds rounded to steps of 0.001 and
/// clamped to the sensor model's bounds; findings count both where they changed something. Colours
/// are dropped. The resolution is that of the tree, whatever `options` says.
/// Errors: kLimit when the leaves cover more voxels than that allows; those of SemanticOctree;
/// kInterrupted when `budget` is told to stop, of which nothing is drawn.
[[nodiscard]] Result<Loaded<SemanticOctree>> to_semantic_octree(
    const OctomapTree& tree,
    const OctreeOptions& options = {},
    const OctreeConversionOptions& conversion = {},
    const LoadBudget& budget = {});

}  // namespace hypermap
