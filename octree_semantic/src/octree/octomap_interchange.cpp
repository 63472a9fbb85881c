// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/octree_semantic/octree/octomap_interchange.hpp"

#include "hypermap/core/base/class_palette.hpp"

#include <algorithm>
#include <cmath>
#include <new>
#include <string>

namespace hypermap {
namespace {

constexpr Rgb8 kUnlabelled{160, 160, 160};

template <class Tree>
std::unique_ptr<Tree> empty_like(const SemanticOctree& tree) {
  auto made = std::make_unique<Tree>(tree.resolution_m());
  const SensorModelOptions& model = tree.options().sensor_model;
  made->setProbHit(model.hit.value());
  made->setProbMiss(model.miss.value());
  made->setClampingThresMin(model.clamp_min.value());
  made->setClampingThresMax(model.clamp_max.value());
  made->setOccupancyThres(model.occupied_from.value());
  return made;
}

/// Sets every known voxel, lets `decorate(node, leaf)` add the payload, and prunes.
template <class Tree, class Decorate>
std::unique_ptr<Tree> convert(const SemanticOctree& tree, Decorate&& decorate) {
  auto made = empty_like<Tree>(tree);
  tree.for_each_stored_leaf([&](const StoredLeaf& leaf) {
    const octomap::OcTreeKey key(leaf.key.x, leaf.key.y, leaf.key.z);
    const auto log_odds = static_cast<float>(from_milli(leaf.log_odds).value());
    constexpr bool kInnerNodesLater = true;
    decorate(*made->setNodeValue(key, log_odds, kInnerNodesLater), leaf);
  });
  made->updateInnerOccupancy();
  made->prune();
  return made;
}

double rounded(double probability) {
  return std::round(probability * 1e6) / 1e6;
}

template <class Tree>
Result<OctreeOptions> options_of(const Tree& tree) {
  const auto usable = [](double p) { return p >= 0.0 && p <= 1.0; };
  for (const double p : {tree.getProbHit(),
                         tree.getProbMiss(),
                         tree.getClampingThresMin(),
                         tree.getClampingThresMax(),
                         tree.getOccupancyThres()}) {
    if (!usable(p)) {
      return fail(ErrorCode::kInvalidArgument,
                  "must be a probability, is " + std::to_string(p),
                  "sensor_model");
    }
  }
  return OctreeOptions{
      .resolution_m = tree.getResolution(),
      .sensor_model = {.hit = Probability(rounded(tree.getProbHit())),
                       .miss = Probability(rounded(tree.getProbMiss())),
                       .clamp_min = Probability(rounded(tree.getClampingThresMin())),
                       .clamp_max = Probability(rounded(tree.getClampingThresMax())),
                       .occupied_from = Probability(rounded(tree.getOccupancyThres()))},
      .max_class_log_odds = LogOdds(10.0)};
}

/// Calls `visit(key)` for each voxel that a leaf of OctoMap stands for; stops at an error.
template <class Leaf, class Visitor>
Result<void> for_each_voxel(const Leaf& leaf, Visitor&& visit) {
  const unsigned edge = 1U << (16U - leaf.getDepth());
  const octomap::OcTreeKey first = leaf.getIndexKey();
  for (unsigned x = 0; x < edge; ++x) {
    for (unsigned y = 0; y < edge; ++y) {
      for (unsigned z = 0; z < edge; ++z) {
        HYPERMAP_TRY(visit(VoxelKey{static_cast<std::uint16_t>(first[0] + x),
                                    static_cast<std::uint16_t>(first[1] + y),
                                    static_cast<std::uint16_t>(first[2] + z)}));
      }
    }
  }
  return {};
}

template <class Tree>
Result<void> check_size(const Tree& tree, const OctomapImportOptions& options) {
  std::size_t num_voxels = 0;
  for (auto leaf = tree.begin_leafs(), end = tree.end_leafs(); leaf != end; ++leaf) {
    num_voxels += std::size_t{1} << (3U * (16U - leaf.getDepth()));
    if (num_voxels <= options.max_voxels) continue;
    return fail(ErrorCode::kLimit,
                "the tree stands for more than " + std::to_string(options.max_voxels) + " voxels",
                "max_voxels");
  }
  return {};
}

/// Copies every leaf; `label_of(node)` gives its label, if any.
template <class Tree, class LabelOf>
Result<SemanticOctree> import(const Tree& tree,
                              const OctomapImportOptions& options,
                              LabelOf&& label_of) {
  HYPERMAP_ASSIGN_OR_RETURN(const OctreeOptions octree_options, options_of(tree));
  HYPERMAP_ASSIGN_OR_RETURN(SemanticOctree made, SemanticOctree::create(octree_options));
  HYPERMAP_TRY(check_size(tree, options));
  const SensorModel& model = made.sensor_model();
  for (auto leaf = tree.begin_leafs(), end = tree.end_leafs(); leaf != end; ++leaf) {
    const double log_odds = static_cast<double>(leaf->getLogOdds());
    if (std::isnan(log_odds)) {
      return fail(ErrorCode::kInvalidArgument, "must be a number, is NaN", "log_odds");
    }
    const double clamped = std::clamp(
        log_odds, from_milli(model.clamp_min).value(), from_milli(model.clamp_max).value());
    StoredLeaf stored{.key = {}, .log_odds = to_milli(LogOdds(clamped)), .label = label_of(*leaf)};
    HYPERMAP_TRY(for_each_voxel(leaf, [&](const VoxelKey& key) {
      stored.key = key;
      return made.set_leaf(stored);
    }));
  }
  return made;
}

template <class Tree>
Result<SemanticOctree> import_occupancy(const Tree& tree, const OctomapImportOptions& options) {
  return import(tree, options, [](const auto&) { return std::optional<VoxelLabel>{}; });
}

}  // namespace

std::unique_ptr<octomap::OcTree> to_octomap(const SemanticOctree& tree) {
  return convert<octomap::OcTree>(tree, [](octomap::OcTreeNode&, const StoredLeaf&) {});
}

std::unique_ptr<octomap::ColorOcTree> to_color_octomap(const SemanticOctree& tree) {
  const MilliLogOdds occupied_from = tree.sensor_model().occupied_from;
  return convert<octomap::ColorOcTree>(
      tree, [occupied_from](octomap::ColorOcTreeNode& node, const StoredLeaf& leaf) {
        if (leaf.log_odds < occupied_from) return;
        const auto best = leaf.label ? leaf.label->best_class() : std::nullopt;
        const Rgb8 color = best ? class_color(*best) : kUnlabelled;
        node.setColor(color.r, color.g, color.b);
      });
}

std::unique_ptr<SemanticOcTree> to_semantic_octomap(const SemanticOctree& tree) {
  return convert<SemanticOcTree>(tree, [](SemanticOcTreeNode& node, const StoredLeaf& leaf) {
    if (leaf.label) node.set_label(*leaf.label);
  });
}

Result<SemanticOctree> from_octomap(const octomap::OcTree& tree,
                                    const OctomapImportOptions& options) {
  return import_occupancy(tree, options);
}

Result<SemanticOctree> from_octomap(const octomap::ColorOcTree& tree,
                                    const OctomapImportOptions& options) {
  return import_occupancy(tree, options);
}

Result<SemanticOctree> from_octomap(const SemanticOcTree& tree,
                                    const OctomapImportOptions& options) {
  return import(tree, options, [](const SemanticOcTreeNode& node) {
    const bool blank = node.label() == VoxelLabel{};
    return blank ? std::nullopt : std::optional(node.label());
  });
}

}  // namespace hypermap
