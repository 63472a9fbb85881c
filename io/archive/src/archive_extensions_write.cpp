// SPDX-License-Identifier: BSD-3-Clause
#include "archive_extensions.hpp"
#include "extension_entries.hpp"
#include "hypermap/io/archive/detectors_file.hpp"
#include "hypermap/io/archive/object_embeddings.hpp"
#include "hypermap/io/archive/object_json.hpp"
#include "hypermap/io/archive/octomap_file.hpp"
#include "hypermap/io/archive/topological_map_json.hpp"
#include "hypermap/io/archive/true_surfaces_json.hpp"
#include "hypermap/io/archive/vocabulary_file.hpp"
#include "hypermap/io/codec/bounded_yaml.hpp"
#include "hypermap/io/codec/value_keys.hpp"
#include "layers/layer_files.hpp"
#include "octree/octree_options_keys.hpp"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

namespace hypermap {
namespace {

void put(WrittenExtensions& written, ExtensionEntry entry, std::string bytes) {
  written.files.push_back({.name = entry.file, .bytes = std::move(bytes)});
  written.entries.push_back(std::move(entry));
}

/// The octree as `.ot` and as `.bt`.
struct OctreeBytes {
  std::string full;
  std::string twin;
};

Result<OctreeBytes> write_octree(const SemanticOctree& octree) {
  const OctomapTree tree = to_octomap_tree(octree);
  OctreeBytes bytes;
  HYPERMAP_ASSIGN_OR_RETURN(bytes.full, write_octomap(tree));
  HYPERMAP_ASSIGN_OR_RETURN(bytes.twin, write_octomap_binary(tree));
  return bytes;
}

/// The parts of a map that take long, made at the same time.
struct LargeParts {
  std::optional<Result<OctreeBytes>> octree = std::nullopt;
  std::optional<Result<std::string>> objects = std::nullopt;
};

LargeParts write_large_parts(const MapArchive& archive) {
  LargeParts parts;
  tbb::parallel_invoke(
      [&] {
        if (archive.octree) parts.octree = write_octree(*archive.octree);
      },
      [&] {
        if (!(archive.objects == ObjectMap())) parts.objects = write_objects(archive.objects);
      });
  return parts;
}

Result<void> put_octree(WrittenExtensions& written,
                        const MapArchive& archive,
                        std::optional<Result<OctreeBytes>> made) {
  if (!made) return {};
  HYPERMAP_ASSIGN_OR_RETURN(OctreeBytes bytes, *std::move(made));
  ExtensionEntry entry = entry_of(archive, kOctomapFormat);
  std::vector<ValueTree::Entry> keys = octree_option_keys(archive.octree->options());
  append_keys(keys, entry.extra);
  entry.extra = make_map(std::move(keys));
  ExtensionEntry twin_entry = new_entry(kOctreeTwinFormat);
  twin_entry.frame_id = entry.frame_id;
  written.octree_twin = {.entry = std::move(twin_entry), .bytes = std::move(bytes.twin)};
  put(written, std::move(entry), std::move(bytes.full));
  return {};
}

Result<void> put_objects(WrittenExtensions& written,
                         const MapArchive& archive,
                         std::optional<Result<std::string>> made) {
  if (!made) return {};
  HYPERMAP_ASSIGN_OR_RETURN(std::string bytes, *std::move(made));
  put(written, entry_of(archive, kObjectsFormat), std::move(bytes));
  return {};
}

Result<void> put_embeddings(WrittenExtensions& written, const MapArchive& archive) {
  const ObjectEmbeddings embeddings = embeddings_of(archive.objects);
  if (embeddings.empty()) return {};
  HYPERMAP_ASSIGN_OR_RETURN(std::string bytes, write_object_embeddings(embeddings));
  put(written, entry_of(archive, kEmbeddingsFormat), std::move(bytes));
  return {};
}

Result<void> put_views(WrittenExtensions& written, const MapArchive& archive) {
  if (archive.views.empty()) return {};
  for (const auto& [id, view] : archive.views) {
    if (archive.objects.contains(id)) continue;
    return fail(ErrorCode::kInvalidArgument,
                "shows object " + std::to_string(id.value) + ", which the map does not have",
                "views");
  }
  HYPERMAP_ASSIGN_OR_RETURN(std::string bytes, write_object_views(archive.views));
  put(written, entry_of(archive, kViewsFormat), std::move(bytes));
  return {};
}

Result<void> put_topological_map(WrittenExtensions& written, const MapArchive& archive) {
  if (!archive.topological_map) return {};
  HYPERMAP_ASSIGN_OR_RETURN(std::string bytes, write_topological_map(*archive.topological_map));
  put(written, entry_of(archive, kTopologicalMapFormat), std::move(bytes));
  return {};
}

void put_classes(WrittenExtensions& written, const MapArchive& archive) {
  if (archive.classes.size() == 0) return;
  std::vector<ValueTree> names;
  for (const std::string& name : archive.classes.names()) names.push_back(make_text(name));
  put(written,
      entry_of(archive, kClassesFormat),
      write_yaml(make_list(std::move(names)), YamlStyle::kBlock));
}

void put_detectors(WrittenExtensions& written, const MapArchive& archive) {
  if (archive.detectors.size() == 0) return;
  put(written, entry_of(archive, kDetectorsFormat), write_detectors(archive.detectors));
}

void put_vocabulary(WrittenExtensions& written, const MapArchive& archive) {
  if (archive.vocabulary.empty()) return;
  put(written, entry_of(archive, kVocabularyFormat), write_vocabulary(archive.vocabulary));
}

Result<void> put_class_grids(WrittenExtensions& written, const MapArchive& archive) {
  for (std::size_t i = 0; i < archive.class_grids.size(); ++i) {
    const ClassGrid& grid = archive.class_grids[i];
    const std::string plain = plain_grid_name(i);
    ExtensionEntry entry{.format = std::string(kClassGridFormat),
                         .name = grid.name.empty() ? plain : grid.name,
                         .frame_id = grid.frame_id,
                         .file = grid.file.empty() ? plain : grid.file};
    std::vector<ValueTree::Entry> keys{{"class", make_text(grid.class_name)}};
    append_keys(keys, grid.extra);
    entry.extra = make_map(std::move(keys));
    HYPERMAP_ASSIGN_OR_RETURN(auto files, write_occupancy(OccupancyLayer(grid.grid), entry.file));
    std::move(files.begin(), files.end(), std::back_inserter(written.files));
    written.entries.push_back(std::move(entry));
  }
  return {};
}

Result<void> put_provenance(WrittenExtensions& written, const MapArchive& archive) {
  if (archive.provenance.empty()) return {};
  HYPERMAP_ASSIGN_OR_RETURN(std::string bytes, write_provenance(archive.provenance));
  put(written, entry_of(archive, kProvenanceFormat), std::move(bytes));
  return {};
}

void put_checkpoint(WrittenExtensions& written, const MapArchive& archive) {
  if (archive.checkpoint.kind == ValueKind::kNull) return;
  put(written, entry_of(archive, kCheckpointFormat), write_yaml(archive.checkpoint));
}

Result<void> put_true_surfaces(WrittenExtensions& written, const MapArchive& archive) {
  if (!archive.true_surfaces) return {};
  HYPERMAP_ASSIGN_OR_RETURN(std::string bytes, write_true_surfaces(*archive.true_surfaces));
  put(written, entry_of(archive, kTrueSurfacesFormat), std::move(bytes));
  return {};
}

Result<void> put_layers(WrittenExtensions& written, const MapArchive& archive) {
  for (const Layer& layer : archive.hypermap.layers()) {
    if (is_strict_form(layer)) continue;
    HYPERMAP_ASSIGN_OR_RETURN(auto files, write_layer(layer));
    std::move(files.begin(), files.end(), std::back_inserter(written.files));
    written.entries.push_back(extension_of(layer));
  }
  return {};
}

}  // namespace

Result<WrittenExtensions> write_extensions(const MapArchive& archive) {
  WrittenExtensions written;
  LargeParts parts = write_large_parts(archive);
  HYPERMAP_TRY(put_octree(written, archive, std::move(parts.octree)));
  for (const auto& octomap : archive.octomaps) put(written, octomap.entry, octomap.bytes);
  HYPERMAP_TRY(put_objects(written, archive, std::move(parts.objects)));
  HYPERMAP_TRY(put_embeddings(written, archive));
  HYPERMAP_TRY(put_views(written, archive));
  HYPERMAP_TRY(put_topological_map(written, archive));
  put_classes(written, archive);
  put_detectors(written, archive);
  put_vocabulary(written, archive);
  HYPERMAP_TRY(put_class_grids(written, archive));
  HYPERMAP_TRY(put_provenance(written, archive));
  put_checkpoint(written, archive);
  HYPERMAP_TRY(put_true_surfaces(written, archive));
  HYPERMAP_TRY(put_layers(written, archive));
  return written;
}

}  // namespace hypermap
