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
#include "octree/floor_keys.hpp"
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

/// Of the objects; of a map without an octree with its floor.
ExtensionEntry objects_entry(const MapArchive& archive) {
  ExtensionEntry entry = entry_of(archive, kObjectsFormat);
  std::vector<ValueTree::Entry> keys = floor_keys(archive.floor);
  if (archive.octree || keys.empty()) return entry;
  append_keys(keys, entry.extra);
  entry.extra = make_map(std::move(keys));
  return entry;
}

/// The octree as `.ot` and as `.bt`, with their entries.
struct OctreeFiles {
  ExtensionEntry entry;
  MemberFile full;
  OctreeTwin twin;
};

Result<MemberFile> packed(const ExtensionEntry& entry,
                          Result<std::string> bytes,
                          const ZipLimits& limits) {
  if (!bytes) return tl::make_unexpected(std::move(bytes).error());
  return packed_file({.name = entry.file, .bytes = *std::move(bytes)}, limits);
}

/// What both files are of, either of which takes long to make and to pack: at the same time.
Result<OctreeFiles> write_octree(const MapArchive& archive, const ZipLimits& limits) {
  ExtensionEntry entry = entry_of(archive, kOctomapFormat);
  ExtensionEntry twin_entry = new_entry(kOctreeTwinFormat);
  twin_entry.frame_id = entry.frame_id;
  std::vector<ValueTree::Entry> keys = octree_option_keys(archive.octree->options());
  std::ranges::move(floor_keys(archive.floor), std::back_inserter(keys));
  append_keys(keys, entry.extra);
  entry.extra = make_map(std::move(keys));
  const OctomapTree tree = to_octomap_tree(*archive.octree);
  std::optional<Result<MemberFile>> full;
  std::optional<Result<MemberFile>> twin;
  tbb::parallel_invoke([&] { full = packed(entry, write_octomap(tree), limits); },
                       [&] { twin = packed(twin_entry, write_octomap_binary(tree), limits); });
  OctreeFiles files{.entry = std::move(entry), .full = {}, .twin = {std::move(twin_entry), {}}};
  HYPERMAP_ASSIGN_OR_RETURN(files.full, *std::move(full));
  HYPERMAP_ASSIGN_OR_RETURN(files.twin.file, *std::move(twin));
  return files;
}

/// The parts of a map that take long, made at the same time.
struct LargeParts {
  std::optional<Result<OctreeFiles>> octree = std::nullopt;
  std::optional<Result<MemberFile>> objects = std::nullopt;
};

LargeParts write_large_parts(const MapArchive& archive, const ZipLimits& limits) {
  LargeParts parts;
  tbb::parallel_invoke(
      [&] {
        if (archive.octree) parts.octree = write_octree(archive, limits);
      },
      [&] {
        if (archive.objects == ObjectMap()) return;
        parts.objects = packed(objects_entry(archive), write_objects(archive.objects), limits);
      });
  return parts;
}

Result<void> put_octree(WrittenExtensions& written, std::optional<Result<OctreeFiles>> made) {
  if (!made) return {};
  HYPERMAP_ASSIGN_OR_RETURN(OctreeFiles files, *std::move(made));
  written.octree_twin = std::move(files.twin);
  written.files.push_back(std::move(files.full));
  written.entries.push_back(std::move(files.entry));
  return {};
}

Result<void> put_objects(WrittenExtensions& written,
                         const MapArchive& archive,
                         std::optional<Result<MemberFile>> made) {
  if (!made) return {};
  HYPERMAP_ASSIGN_OR_RETURN(MemberFile file, *std::move(made));
  written.files.push_back(std::move(file));
  written.entries.push_back(objects_entry(archive));
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
    append_files(written.files, std::move(files));
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
    append_files(written.files, std::move(files));
    written.entries.push_back(extension_of(layer));
  }
  return {};
}

}  // namespace

Result<WrittenExtensions> write_extensions(const MapArchive& archive, const ZipLimits& limits) {
  WrittenExtensions written;
  LargeParts parts = write_large_parts(archive, limits);
  HYPERMAP_TRY(put_octree(written, std::move(parts.octree)));
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
