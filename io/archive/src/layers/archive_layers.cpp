// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/archive_layers.hpp"

#include "hypermap/core/base/nearest_name.hpp"
#include "hypermap/io/archive/class_grid_layer.hpp"
#include "hypermap/io/archive/map_layers.hpp"
#include "hypermap/io/archive/objects_layer.hpp"
#include "hypermap/io/archive/octomap_file.hpp"
#include "hypermap/io/archive/octree_layer.hpp"
#include "hypermap/io/archive/topological_map_layer.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <utility>

namespace hypermap {
namespace {

/// Name and frame by which an extension of `format` is saved.
LayerInfo info_of(const MapArchive& archive, std::string_view format, std::string_view name) {
  LayerInfo info{.name = std::string(name)};
  const auto kept = archive.extension_entries.find(format);
  if (kept == archive.extension_entries.end()) return info;
  info.name = kept->second.name;
  info.frame_id = kept->second.frame_id;
  return info;
}

/// What the semantic layer says of the objects that stand in it too.
std::map<ObjectId, double> confidence_of_objects(const MapArchive& archive) {
  std::map<ObjectId, double> confidence;
  const auto* semantic = archive.hypermap.find_as<SemanticLayer>(kSemanticLayer);
  if (semantic == nullptr) return confidence;
  for (const Object& object : archive.objects.objects()) {
    const SemanticObject* shape = semantic->find(object.id.value);
    const auto known = shape == nullptr ? std::nullopt : confidence_of(*shape);
    if (known) confidence.emplace(object.id, *known);
  }
  return confidence;
}

Layer octree_layer(const MapArchive& archive, LayerInfo info, LeafSource leaves) {
  const SemanticOctree& octree = *archive.octree;
  return {
      .info = std::move(info),
      .content = OctreeLayer({.leaves = std::move(leaves),
                              .classes = archive.classes,
                              .file = [&octree] { return write_octomap(to_octomap_tree(octree)); },
                              .resolution_m = octree.resolution_m()})};
}

Layer octree_layer(const OctomapExtension& octomap) {
  return {.info = {.name = octomap.entry.name, .frame_id = octomap.entry.frame_id},
          .content = OctreeLayer({.leaves = leaf_source(octomap.tree),
                                  .classes = {},
                                  .file = [&octomap] { return Result<std::string>(octomap.bytes); },
                                  .resolution_m = octomap.tree.resolution_m})};
}

Layer evidence_layer(const MapArchive& archive) {
  LayerInfo info = info_of(archive, kOctomapFormat, "octree");
  info.name = kEvidenceLayer;
  return octree_layer(archive, std::move(info), leaf_source(*archive.octree));
}

Layer topological_map_layer(const MapArchive& archive) {
  return {.info = info_of(archive, kTopologicalMapFormat, kTopologicalMapLayer),
          .content = TopologicalMapLayer(*archive.topological_map)};
}

Layer objects_layer(const MapArchive& archive) {
  return {.info = info_of(archive, kObjectsFormat, kObjectsLayer),
          .content = ObjectsLayer(archive.objects,
                                  archive.classes,
                                  confirmed_ids_of(archive),
                                  confidence_of_objects(archive))};
}

}  // namespace

std::vector<Layer> archive_layers(const MapArchive& archive) {
  const auto own = archive.hypermap.layers();
  std::vector<Layer> layers(own.begin(), own.end());
  if (archive.octree) {
    layers.push_back(
        octree_layer(archive, info_of(archive, kOctomapFormat, "octree"), shown_leaves(archive)));
  }
  for (const OctomapExtension& octomap : archive.octomaps) layers.push_back(octree_layer(octomap));
  if (!archive.objects.empty()) layers.push_back(objects_layer(archive));
  for (const ClassGrid& grid : archive.class_grids) {
    layers.push_back({.info = {.name = grid.class_name, .frame_id = grid.frame_id},
                      .content = ClassGridLayer(grid.grid)});
  }
  return layers;
}

Result<Layer> archive_layer(const MapArchive& archive, std::string_view name) {
  std::vector<Layer> layers = archive_layers(archive);
  auto found = std::find_if(
      layers.begin(), layers.end(), [&](const Layer& layer) { return layer.info.name == name; });
  if (found == layers.end()) {
    found = std::find_if(layers.begin(), layers.end(), [&](const Layer& layer) {
      return is_spelling_of(layer.info.name, name);
    });
  }
  if (found == layers.end()) {
    const std::string asked = archive.vocabulary.class_of(name);
    found = std::find_if(layers.begin(), layers.end(), [&](const Layer& layer) {
      return layer.content.as<ClassGridLayer>() != nullptr &&
             archive.vocabulary.class_of(layer.info.name) == asked;
    });
  }
  if (found != layers.end()) return std::move(*found);
  if (is_spelling_of(kObjectsLayer, name)) return objects_layer(archive);
  if (is_spelling_of(kEvidenceLayer, name) && archive.octree) return evidence_layer(archive);
  if (is_spelling_of(kTopologicalMapLayer, name) && archive.topological_map) {
    return topological_map_layer(archive);
  }
  std::vector<std::string> names;
  names.reserve(layers.size() + 3);
  for (const Layer& layer : layers) names.push_back(layer.info.name);
  // Those that answer without standing in the list.
  if (archive.objects.empty()) names.emplace_back(kObjectsLayer);
  if (archive.octree) names.emplace_back(kEvidenceLayer);
  if (archive.topological_map) names.emplace_back(kTopologicalMapLayer);
  return fail(ErrorCode::kNotFound, nothing_named("layer", name, names), "layer");
}

}  // namespace hypermap
