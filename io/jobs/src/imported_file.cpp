// SPDX-License-Identifier: BSD-3-Clause
#include "imported_file.hpp"

#include "hypermap/io/archive/map_server.hpp"
#include "hypermap/io/archive/octomap_file.hpp"
#include "hypermap/io/archive/semantic_yaml.hpp"
#include "hypermap/io/codec/byte_source.hpp"
#include "hypermap/io/codec/file_kind.hpp"
#include "import_provenance.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <optional>
#include <utility>

namespace hypermap {
namespace {

constexpr std::string_view kMapFrame = "map";

Unexpected unsupported(const ImportedFile& file, const std::string& what) {
  return about_file(file, {.code = ErrorCode::kUnsupported, .what = what});
}

std::string layer_name_of(const ImportedFile& file) {
  return file.name.empty() ? file.path.stem().string() : file.name;
}

/// An archive of one layer.
Result<MapArchive> of_layer(const ImportedFile& file, LayerContent content) {
  MapArchive archive;
  HYPERMAP_TRY(archive.hypermap.add_layer(
      {LayerInfo{.name = layer_name_of(file), .frame_id = file.frame_id}, std::move(content)}));
  return archive;
}

Result<Loaded<MapArchive>> import_map(const ImportedFile& file,
                                      const ImportJob& job,
                                      const LoadBudget& budget) {
  HYPERMAP_ASSIGN_OR_RETURN(auto layer, read_map(file.path, job.dialect, job.limits.reach, budget));
  HYPERMAP_ASSIGN_OR_RETURN(MapArchive archive, of_layer(file, std::move(layer.value)));
  return Loaded<MapArchive>{.value = std::move(archive), .findings = std::move(layer.findings)};
}

Result<Loaded<MapArchive>> import_semantic(const ImportedFile& file, const LoadBudget& budget) {
  HYPERMAP_ASSIGN_OR_RETURN(auto layer, read_semantic_layer(file.path, {}, budget));
  HYPERMAP_ASSIGN_OR_RETURN(MapArchive archive, of_layer(file, std::move(layer.value)));
  return Loaded<MapArchive>{.value = std::move(archive), .findings = std::move(layer.findings)};
}

Result<Loaded<MapArchive>> import_octree(const ImportedFile& file,
                                         const ImportJob& job,
                                         const LoadBudget& budget) {
  HYPERMAP_ASSIGN_OR_RETURN(std::string bytes, read_file(file.path, job.limits.max_octree_bytes));
  HYPERMAP_ASSIGN_OR_RETURN(auto tree,
                            parse_octomap(bytes, {.file = file.path.string()}, {}, budget));
  if (tree.value.kind == OctomapKind::kSemantic) {
    return unsupported(file, "is an octree with labels, whose classes stand in its archive alone");
  }
  const std::string name = layer_name_of(file);
  HYPERMAP_TRY(validate_layer_name(name));
  MapArchive archive;
  archive.octomaps.push_back({.entry = {.format = std::string(kOctomapFormat),
                                        .name = name,
                                        .frame_id = file.frame_id,
                                        .file = name + file.path.extension().string()},
                              .bytes = std::move(bytes),
                              .tree = std::move(tree.value)});
  return Loaded<MapArchive>{.value = std::move(archive), .findings = std::move(tree.findings)};
}

/// The archive's frames with `map` as the file says.
std::string frame_in(const ImportedFile& file, const std::string& frame_id) {
  return frame_id == kMapFrame ? file.frame_id : frame_id;
}

std::string name_in(const ImportedFile& file, const std::string& name) {
  return file.name.empty() ? name : file.name + "_" + name;
}

/// The layers and grids by the names and frames that the file says. Requires: nothing in 3D, whose
/// frame and ids stay as they are.
Result<MapArchive> renamed(MapArchive archive, const ImportedFile& file) {
  Hypermap hypermap;
  for (const Layer& layer : archive.hypermap.layers()) {
    Layer moved = layer;
    moved.info.name = name_in(file, layer.info.name);
    moved.info.frame_id = frame_in(file, layer.info.frame_id);
    moved.info.file = std::nullopt;
    HYPERMAP_TRY(hypermap.add_layer(std::move(moved)));
  }
  for (FrameTransform transform : archive.hypermap.frames().transforms()) {
    transform.frame_id = frame_in(file, transform.frame_id);
    transform.child_frame_id = frame_in(file, transform.child_frame_id);
    HYPERMAP_TRY(hypermap.frames().add(std::move(transform)));
  }
  archive.hypermap = std::move(hypermap);
  for (ClassGrid& grid : archive.class_grids) {
    grid.frame_id = frame_in(file, grid.frame_id);
    grid.name.clear();
    grid.file.clear();
  }
  for (OctomapExtension& octomap : archive.octomaps) {
    octomap.entry.frame_id = frame_in(file, octomap.entry.frame_id);
    octomap.entry.name = name_in(file, octomap.entry.name);
    octomap.entry.file = name_in(file, octomap.entry.file);
  }
  return archive;
}

/// Neither a name nor a frame is given to what it has.
bool stays_as_it_was(const ImportedFile& file) {
  return file.name.empty() && file.frame_id == kMapFrame;
}

Result<Loaded<MapArchive>> import_archive(const ImportedFile& file, const ImportJob& job) {
  HYPERMAP_ASSIGN_OR_RETURN(auto loaded,
                            load_archive(file.path, job.limits, archive_layer_types(), job.stop));
  if (loaded.value.checkpoint.kind != ValueKind::kNull) {
    return unsupported(file, "is a checkpoint: map --resume ends its run first");
  }
  if (stays_as_it_was(file)) return loaded;
  if (has_3d(loaded.value)) {
    return unsupported(file, "has objects or voxels: it keeps its names and its frame");
  }
  HYPERMAP_ASSIGN_OR_RETURN(loaded.value, renamed(std::move(loaded.value), file));
  return loaded;
}

/// What a file that is no archive becomes.
Result<Loaded<MapArchive>> import_layer(FileKind kind,
                                        const ImportedFile& file,
                                        const ImportJob& job,
                                        const LoadBudget& budget) {
  switch (kind) {
    case FileKind::kMap:
      return import_map(file, job, budget);
    case FileKind::kSemantic:
      return import_semantic(file, budget);
    case FileKind::kOctree:
      return import_octree(file, job, budget);
    default:
      return unsupported(file,
                         "is a file of kind " + std::string(name_of(kind)) +
                             ", which is no part of a map: archive, config, map, semantic and "
                             "octree are");
  }
}

}  // namespace

Unexpected about_file(const ImportedFile& file, Error error) {
  if (error.file.empty()) error.file = file.path.string();
  return Unexpected(std::move(error));
}

bool has_3d(const MapArchive& archive) {
  return archive.octree || !archive.objects.empty() || archive.topological_map ||
         archive.true_surfaces;
}

Result<Loaded<MapArchive>> import_file(const ImportedFile& file,
                                       const ImportJob& job,
                                       const LoadBudget& budget) {
  HYPERMAP_ASSIGN_OR_RETURN(const FileKind kind, find_file_kind(file.path));
  const bool is_archive = kind == FileKind::kArchive || kind == FileKind::kConfig;
  HYPERMAP_ASSIGN_OR_RETURN(
      auto imported,
      is_archive ? import_archive(file, job) : import_layer(kind, file, job, budget));
  std::vector<Provenance>& runs = imported.value.provenance;
  const bool is_the_map =
      kind == FileKind::kArchive && job.files.size() == 1 && stays_as_it_was(file);
  if (is_the_map || runs.size() >= kMaxRuns) return imported;
  HYPERMAP_ASSIGN_OR_RETURN(Provenance from,
                            import_provenance(file, kind, imported.value, job.limits));
  runs.insert(runs.begin(), std::move(from));
  return imported;
}

}  // namespace hypermap
