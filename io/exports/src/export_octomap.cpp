// SPDX-License-Identifier: BSD-3-Clause
#include "export_parts.hpp"
#include "hypermap/core/base/class_palette.hpp"
#include "hypermap/io/archive/octomap_file.hpp"
#include "hypermap/io/archive/octomap_tree.hpp"
#include "hypermap/io/codec/atomic_file.hpp"

#include <algorithm>

namespace hypermap {
namespace {

Result<OctomapTree> tree_of(const MapArchive& archive) {
  if (archive.octree) return to_octomap_tree(*archive.octree);
  if (!archive.octomaps.empty()) return archive.octomaps.front().tree;
  return fail(ErrorCode::kNotFound, "the map has no octree");
}

/// Free space, and of the occupied voxels those of the wanted classes.
OctomapTree only(OctomapTree tree, const std::optional<std::set<ClassId>>& wanted) {
  if (!wanted) return tree;
  std::erase_if(tree.leaves, [&](const OctomapLeaf& leaf) {
    if (leaf.log_odds < 0.0F) return false;
    if (leaf.label == OctomapLeaf::kNoLabel) return true;
    const auto best = tree.labels[leaf.label].best_class();
    return !best || !wanted->contains(*best);
  });
  return tree;
}

/// Whether nothing of what was asked for is occupied; without classes free space counts too.
bool is_empty(const OctomapTree& tree, const std::optional<std::set<ClassId>>& wanted) {
  if (!wanted) return tree.leaves.empty();
  return std::none_of(tree.leaves.begin(), tree.leaves.end(), [](const OctomapLeaf& leaf) {
    return leaf.log_odds >= 0.0F;
  });
}

Result<void> require_suffix(const ExportRequest& request, std::string_view suffixes) {
  const std::string suffix = request.output.extension().string();
  if (!suffix.empty() && suffixes.find(suffix) != std::string_view::npos) return {};
  return fail(ErrorCode::kInvalidArgument,
              "must end in " + std::string(suffixes) + ", is '" + request.output.string() + "'",
              "--output");
}

}  // namespace

Result<WrittenFiles> export_octomap(const MapArchive& archive, const ExportRequest& request) {
  HYPERMAP_TRY(require_suffix(request, ".ot or .bt"));
  HYPERMAP_ASSIGN_OR_RETURN(const auto wanted, wanted_classes(archive, request));
  HYPERMAP_ASSIGN_OR_RETURN(OctomapTree labelled, tree_of(archive));
  labelled = only(std::move(labelled), wanted);
  if (is_empty(labelled, wanted)) return WrittenFiles{};
  const OctomapTree tree = without_labels(labelled);
  HYPERMAP_ASSIGN_OR_RETURN(
      const std::string bytes,
      request.output.extension() == ".bt" ? write_octomap_binary(tree) : write_octomap(tree));
  HYPERMAP_TRY(write_file_atomically(request.output, bytes));
  return WrittenFiles{request.output};
}

Result<WrittenFiles> export_color_octomap(const MapArchive& archive, const ExportRequest& request) {
  HYPERMAP_TRY(require_suffix(request, ".ot"));
  HYPERMAP_ASSIGN_OR_RETURN(const auto wanted, wanted_classes(archive, request));
  HYPERMAP_ASSIGN_OR_RETURN(OctomapTree labelled, tree_of(archive));
  labelled = only(std::move(labelled), wanted);
  if (is_empty(labelled, wanted)) return WrittenFiles{};
  const OctomapTree tree =
      with_class_colors(labelled, class_colors(archive.classes, request.palette));
  HYPERMAP_ASSIGN_OR_RETURN(const std::string bytes, write_octomap(tree));
  HYPERMAP_TRY(write_file_atomically(request.output, bytes));
  return WrittenFiles{request.output};
}

}  // namespace hypermap
