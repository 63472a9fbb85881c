// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/octomap_tree.hpp"

#include "octomap_node.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

namespace hypermap {
namespace {

constexpr int kBrickDepth = 13;  // a leaf of 8 x 8 x 8 voxels
constexpr Rgb8 kUnlabelled{.r = 160, .g = 160, .b = 160};

/// Log-odds, colour and label of a leaf: what siblings must share to become one.
bool same_content(const OctomapTree& tree, std::size_t a, std::size_t b) {
  const OctomapLeaf& first = tree.leaves[a];
  const OctomapLeaf& second = tree.leaves[b];
  if (first.log_odds != second.log_odds) return false;
  if (!tree.colors.empty() && !(tree.colors[a] == tree.colors[b])) return false;
  const bool labelled = first.label != OctomapLeaf::kNoLabel;
  if (labelled != (second.label != OctomapLeaf::kNoLabel)) return false;
  return !labelled || tree.labels[first.label] == tree.labels[second.label];
}

/// Whether the last eight leaves are all the children of one cube, alike. Requires: Morton order,
/// disjoint; so eight of one size from a cube's lowest corner to its highest are its children.
bool last_eight_are_one(const OctomapTree& tree) {
  if (tree.leaves.size() < 8) return false;
  const std::size_t first = tree.leaves.size() - 8;
  const OctomapLeaf& corner = tree.leaves[first];
  const OctomapLeaf& last = tree.leaves.back();
  const std::uint32_t edge = last.edge_voxels();
  if ((last.key.x & last.key.y & last.key.z & edge) == 0) return false;  // no eighth
  if (corner.key.x + edge != last.key.x || corner.key.y + edge != last.key.y ||
      corner.key.z + edge != last.key.z)
    return false;
  for (std::size_t i = first; i < tree.leaves.size(); ++i)
    if (tree.leaves[i].depth != last.depth || !same_content(tree, first, i)) return false;
  return true;
}

void merge_last_eight(OctomapTree& tree) {
  tree.leaves.resize(tree.leaves.size() - 7);
  if (!tree.colors.empty()) tree.colors.resize(tree.leaves.size());
  --tree.leaves.back().depth;
}

/// The same cube of space.
OctomapLeaf unlabelled(const LeafSample& sample, const VoxelGrid& grid) {
  const auto edge = static_cast<std::uint32_t>(std::lround(sample.edge_m / grid.resolution_m()));
  const Eigen::Vector3d to_corner =
      Eigen::Vector3d::Constant(0.5 * (sample.edge_m - grid.resolution_m()));
  OctomapLeaf leaf{.log_odds = static_cast<float>(sample.occupancy.value())};
  leaf.key = grid.key(PointInMap{sample.centre_in_map - to_corner}).value_or(VoxelKey{});
  leaf.depth = static_cast<std::uint8_t>(OctomapLeaf::kVoxelDepth - std::countr_zero(edge));
  return leaf;
}

std::string name_of(std::size_t index) {
  return "leaf " + std::to_string(index);
}

/// Where the leaf ends in Morton order. `end_before`: where the one before it does.
Result<std::uint64_t> checked_end(const OctomapTree& tree,
                                  std::size_t index,
                                  std::uint64_t end_before) {
  const OctomapLeaf& leaf = tree.leaves[index];
  const auto wrong = [&](std::string what) {
    return fail(ErrorCode::kInvalidArgument, std::move(what), name_of(index));
  };
  if (leaf.depth > OctomapLeaf::kVoxelDepth) return wrong("deeper than 16");
  if (((leaf.key.x | leaf.key.y | leaf.key.z) & (leaf.edge_voxels() - 1U)) != 0)
    return wrong("not aligned to its own edge");
  if (!(std::abs(leaf.log_odds) <= kMaxLogOdds))
    return wrong("log-odds are " + std::to_string(leaf.log_odds) + ", expected within +-32.767");
  if (leaf.label != OctomapLeaf::kNoLabel && leaf.label >= tree.labels.size())
    return wrong("points to a label that is not there");
  const std::uint64_t begin = leaf.key.morton();
  if (begin < end_before)
    return wrong("overlaps the one before or stands before it in Morton order");
  return begin + leaf.num_voxels();
}

/// Counts what a conversion changed.
struct Changes {
  std::uint64_t clamped = 0;
  std::uint64_t rounded = 0;
};

MilliLogOdds converted(float log_odds, const SensorModel& model, Changes& changes) {
  const MilliLogOdds milli = to_milli(LogOdds(static_cast<double>(log_odds)));
  const MilliLogOdds clamped = std::clamp(milli, model.clamp_min, model.clamp_max);
  if (clamped != milli) {
    ++changes.clamped;
  } else if (static_cast<float>(from_milli(milli).value()) != log_odds) {
    ++changes.rounded;
  }
  return clamped;
}

std::uint64_t num_voxels(const OctomapTree& tree) {
  std::uint64_t total = 0;  // at most 2^48: the leaves are disjoint
  for (const OctomapLeaf& leaf : tree.leaves) total += leaf.num_voxels();
  return total;
}

std::uint64_t max_voxels(const OctomapTree& tree, const OctreeConversionOptions& options) {
  const std::uint64_t by_leaves = options.max_voxels_per_leaf * tree.leaves.size();
  return std::min(options.max_voxels, std::max(options.unchecked_voxels, by_leaves));
}

Finding counted(std::uint64_t count, const std::string& what) {
  return {.error = {.code = ErrorCode::kMalformedFile,
                    .what = std::to_string(count) + " leaves: " + what,
                    .field = "octree"}};
}

}  // namespace

Result<void> validate(const OctomapTree& tree) {
  if (!tree.colors.empty() && tree.colors.size() != tree.leaves.size())
    return fail(ErrorCode::kInvalidArgument, "expected one colour per leaf", "colors");
  if ((tree.kind == OctomapKind::kColor) != !tree.colors.empty() && !tree.leaves.empty())
    return fail(ErrorCode::kInvalidArgument, "colours belong to trees with colour", "colors");
  if (tree.kind != OctomapKind::kSemantic && !tree.labels.empty())
    return fail(ErrorCode::kInvalidArgument, "labels belong to semantic trees", "labels");
  if (!(tree.resolution_m >= 1e-6 && tree.resolution_m <= 1e3))
    return fail(ErrorCode::kInvalidArgument,
                "is " + std::to_string(tree.resolution_m) + ", expected 1e-6 to 1000",
                "resolution_m");
  std::uint64_t end = 0;
  for (std::size_t i = 0; i < tree.leaves.size(); ++i) {
    HYPERMAP_ASSIGN_OR_RETURN(end, checked_end(tree, i, end));
  }
  return {};
}

LeafSource leaf_source(const OctomapTree& tree) {
  return [&tree](const LeafVisitor& visit) {
    const VoxelGrid grid(tree.resolution_m);
    for (const OctomapLeaf& leaf : tree.leaves) {
      const double half_edge_m = 0.5 * leaf.edge_voxels() * tree.resolution_m;
      const Eigen::Vector3d corner =
          grid.centre(leaf.key).xyz - Eigen::Vector3d::Constant(0.5 * tree.resolution_m);
      LeafSample sample;
      sample.centre_in_map = corner + Eigen::Vector3d::Constant(half_edge_m);
      sample.edge_m = 2.0 * half_edge_m;
      sample.occupancy = LogOdds(static_cast<double>(leaf.log_odds));
      sample.occupied = leaf.log_odds >= 0.0F;
      if (sample.occupied && leaf.label != OctomapLeaf::kNoLabel) {
        sample.best_class = tree.labels[leaf.label].best_class();
        sample.object = tree.labels[leaf.label].object;
      }
      visit(sample);
    }
  };
}

OctomapTree to_octomap_tree(const SemanticOctree& octree) {
  constexpr std::size_t kMostAtOnce = std::size_t{1} << 24U;  // a quarter of a gigabyte
  OctomapTree tree{.kind = OctomapKind::kSemantic, .resolution_m = octree.resolution_m()};
  const LeafCount num = octree.num_leaves();
  tree.leaves.reserve(std::min(num.occupied + num.free, kMostAtOnce));
  octree.for_each_stored_leaf([&tree](const StoredLeaf& stored) {
    OctomapLeaf leaf{.key = stored.key,
                     .log_odds = static_cast<float>(from_milli(stored.log_odds).value())};
    if (stored.label && *stored.label != VoxelLabel{}) {
      leaf.label = static_cast<std::uint32_t>(tree.labels.size());
      tree.labels.push_back(*stored.label);
    }
    tree.leaves.push_back(leaf);
    while (tree.leaves.back().depth > kBrickDepth && last_eight_are_one(tree))
      merge_last_eight(tree);
  });
  return tree;
}

OctomapTree occupied_or_free(const OctomapTree& tree) {
  OctomapTree plain{.resolution_m = tree.resolution_m};
  for (const OctomapLeaf& leaf : tree.leaves) {
    plain.leaves.push_back(
        {.key = leaf.key, .depth = leaf.depth, .log_odds = leaf.log_odds >= 0.0F ? 1.0F : -1.0F});
    while (last_eight_are_one(plain)) merge_last_eight(plain);
  }
  return plain;
}

OctomapTree occupancy_tree(const LeafSource& leaves, double resolution_m) {
  OctomapTree tree{.resolution_m = resolution_m};
  const VoxelGrid grid(resolution_m);
  leaves([&](const LeafSample& leaf) {
    tree.leaves.push_back(unlabelled(leaf, grid));
    while (last_eight_are_one(tree)) merge_last_eight(tree);
  });
  return tree;
}

OctomapTree class_color_tree(const LeafSource& leaves,
                             double resolution_m,
                             std::span<const Rgb8> colors) {
  OctomapTree tree{.kind = OctomapKind::kColor, .resolution_m = resolution_m};
  const VoxelGrid grid(resolution_m);
  leaves([&](const LeafSample& leaf) {
    const bool is_named = leaf.best_class && leaf.best_class->value < colors.size();
    const Rgb8 solid = is_named ? colors[leaf.best_class->value] : kUnlabelled;
    tree.leaves.push_back(unlabelled(leaf, grid));
    tree.colors.push_back(tree.leaves.back().log_odds >= 0.0F ? solid : kNoColor);
    while (last_eight_are_one(tree)) merge_last_eight(tree);
  });
  return tree;
}

Result<Loaded<SemanticOctree>> to_semantic_octree(const OctomapTree& tree,
                                                  const OctreeOptions& options,
                                                  const OctreeConversionOptions& conversion,
                                                  const LoadBudget& budget) {
  HYPERMAP_TRY(validate(tree));
  const std::uint64_t voxels = num_voxels(tree);
  const std::uint64_t limit = max_voxels(tree, conversion);
  if (voxels > limit)
    return fail(ErrorCode::kLimit,
                std::to_string(tree.leaves.size()) + " leaves cover " + std::to_string(voxels) +
                    " voxels, the limit is " + std::to_string(limit),
                "octree");
  OctreeOptions own = options;
  own.resolution_m = tree.resolution_m;
  HYPERMAP_ASSIGN_OR_RETURN(SemanticOctree octree, SemanticOctree::create(own));
  Changes changes;
  std::vector<StoredLeaf> voxels_to_set;
  const auto set_voxels = [&]() -> Result<void> {
    HYPERMAP_TRY(budget.check_stop());
    HYPERMAP_TRY(octree.set_leaves(voxels_to_set));
    voxels_to_set.clear();
    return {};
  };
  for (const OctomapLeaf& leaf : tree.leaves) {
    StoredLeaf stored;
    stored.log_odds = converted(leaf.log_odds, octree.sensor_model(), changes);
    if (leaf.label != OctomapLeaf::kNoLabel) stored.label = tree.labels[leaf.label];
    for (std::uint64_t i = 0; i < leaf.num_voxels(); ++i) {
      constexpr std::size_t kVoxelsAtOnce = 4096;
      if (voxels_to_set.size() == kVoxelsAtOnce) HYPERMAP_TRY(set_voxels());
      stored.key = i == 0 ? leaf.key : VoxelKey::from_morton(leaf.key.morton() + i);
      voxels_to_set.push_back(stored);
    }
  }
  HYPERMAP_TRY(set_voxels());
  Loaded<SemanticOctree> loaded{.value = std::move(octree), .findings = {}};
  if (changes.clamped > 0)
    loaded.findings.push_back(
        counted(changes.clamped, "log-odds were clamped to the bounds of the sensor model"));
  if (changes.rounded > 0)
    loaded.findings.push_back(counted(changes.rounded, "log-odds were rounded to steps of 0.001"));
  return loaded;
}

}  // namespace hypermap
