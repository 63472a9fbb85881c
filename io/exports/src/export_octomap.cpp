// SPDX-License-Identifier: BSD-3-Clause
#include "export_parts.hpp"
#include "hypermap/core/base/class_palette.hpp"
#include "hypermap/io/archive/map_layers.hpp"
#include "hypermap/io/archive/octomap_file.hpp"
#include "hypermap/io/archive/octomap_tree.hpp"
#include "hypermap/io/codec/atomic_file.hpp"
#include "output_ending.hpp"

#include <algorithm>
#include <utility>

namespace hypermap {
namespace {

/// Free space, and of the occupied voxels those of the wanted classes.
LeafSource only(LeafSource leaves, const std::optional<std::set<ClassId>>& wanted) {
  if (!wanted) return leaves;
  return [leaves = std::move(leaves), &wanted](const LeafVisitor& visit) {
    leaves([&](const LeafSample& leaf) {
      const bool is_free = leaf.occupancy.value() < 0.0;
      if (is_free || (leaf.best_class && wanted->contains(*leaf.best_class))) visit(leaf);
    });
  };
}

/// Whether nothing of what was asked for is occupied; without classes free space counts too.
bool is_empty(const OctomapTree& tree, const std::optional<std::set<ClassId>>& wanted) {
  if (!wanted) return tree.leaves.empty();
  return std::none_of(tree.leaves.begin(), tree.leaves.end(), [](const OctomapLeaf& leaf) {
    return leaf.log_odds >= 0.0F;
  });
}

}  // namespace

Result<WrittenFiles> export_octomap(const MapArchive& archive, const ExportRequest& request) {
  HYPERMAP_ASSIGN_OR_RETURN(const auto wanted, wanted_classes(archive, request));
  HYPERMAP_ASSIGN_OR_RETURN(const double resolution_m, octree_resolution_m(archive));
  const OctomapTree tree = occupancy_tree(only(shown_leaves(archive), wanted), resolution_m);
  if (is_empty(tree, wanted)) return WrittenFiles{};
  HYPERMAP_ASSIGN_OR_RETURN(
      const std::string bytes,
      has_ending(request, ".bt") ? write_octomap_binary(tree) : write_octomap(tree));
  HYPERMAP_TRY(write_file_atomically(request.output, bytes));
  return WrittenFiles{request.output};
}

Result<WrittenFiles> export_color_octomap(const MapArchive& archive, const ExportRequest& request) {
  HYPERMAP_ASSIGN_OR_RETURN(const auto wanted, wanted_classes(archive, request));
  HYPERMAP_ASSIGN_OR_RETURN(const double resolution_m, octree_resolution_m(archive));
  const OctomapTree tree = class_color_tree(only(shown_leaves(archive), wanted),
                                            resolution_m,
                                            class_colors(archive.classes, request.palette));
  if (is_empty(tree, wanted)) return WrittenFiles{};
  HYPERMAP_ASSIGN_OR_RETURN(const std::string bytes, write_octomap(tree));
  HYPERMAP_TRY(write_file_atomically(request.output, bytes));
  return WrittenFiles{request.output};
}

}  // namespace hypermap
