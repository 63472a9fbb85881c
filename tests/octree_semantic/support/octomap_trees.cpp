// SPDX-License-Identifier: BSD-3-Clause
#include "octree_semantic/support/octomap_trees.hpp"

namespace hypermap::test {
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

}  // namespace

std::unique_ptr<octomap::OcTree> to_octomap(const SemanticOctree& tree) {
  return convert<octomap::OcTree>(tree, [](octomap::OcTreeNode&, const StoredLeaf&) {});
}

std::unique_ptr<octomap::ColorOcTree> to_color_octomap(const SemanticOctree& tree,
                                                       std::span<const Rgb8> colors) {
  const MilliLogOdds occupied_from = tree.sensor_model().occupied_from;
  return convert<octomap::ColorOcTree>(
      tree, [occupied_from, colors](octomap::ColorOcTreeNode& node, const StoredLeaf& leaf) {
        if (leaf.log_odds < occupied_from) return;
        const auto best = leaf.label ? leaf.label->best_class() : std::nullopt;
        const Rgb8 color = best ? colors[best->value] : kUnlabelled;
        node.setColor(color.r, color.g, color.b);
      });
}

std::unique_ptr<SemanticOcTree> to_semantic_octomap(const SemanticOctree& tree) {
  return convert<SemanticOcTree>(tree, [](SemanticOcTreeNode& node, const StoredLeaf& leaf) {
    if (leaf.label) node.set_label(*leaf.label);
  });
}

}  // namespace hypermap::test
