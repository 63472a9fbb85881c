// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/jobs/import_job.hpp"

#include "hypermap/io/archive/octomap_file.hpp"
#include "hypermap/io/archive/semantic_yaml.hpp"
#include "hypermap/io/codec/byte_source.hpp"
#include "hypermap/io/codec/file_kind.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <optional>
#include <utility>

namespace hypermap {
namespace {

constexpr std::string_view kMapFrame = "map";

Unexpected about(const ImportedFile& file, Error error) {
  if (error.file.empty()) error.file = file.path.string();
  return Unexpected(std::move(error));
}

Unexpected unsupported(const ImportedFile& file, const std::string& what) {
  return about(file, {.code = ErrorCode::kUnsupported, .what = what});
}

/// What only one archive can bring: the others' ids would mean other objects and classes.
bool has_3d(const MapArchive& archive) {
  return archive.octree || !archive.objects.empty() || archive.topological_map ||
         archive.true_surfaces;
}

std::string layer_name_of(const ImportedFile& file) {
  return file.name.empty() ? file.path.stem().string() : file.name;
}

Result<Provenance> provenance_of(const ImportedFile& file, std::uint64_t max_bytes) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::string bytes, read_file(file.path, max_bytes));
  InputHash hash;
  hash.add(bytes);
  return Provenance{.tool = std::string("hypermap ") + HYPERMAP_VERSION,
                    .input = file.path.filename().string(),
                    .input_hash = hash.text(),
                    .map_from_input = {}};
}

/// An archive of one layer.
Result<MapArchive> of_layer(const ImportedFile& file, LayerContent content) {
  MapArchive archive;
  HYPERMAP_TRY(archive.hypermap.add_layer(
      {LayerInfo{.name = layer_name_of(file), .frame_id = file.frame_id}, std::move(content)}));
  return archive;
}

Result<Loaded<MapArchive>> import_map(const ImportedFile& file, const ImportJob& job) {
  HYPERMAP_ASSIGN_OR_RETURN(auto layer, read_map(file.path, job.dialect, job.limits.reach));
  HYPERMAP_ASSIGN_OR_RETURN(MapArchive archive, of_layer(file, std::move(layer.value)));
  return Loaded<MapArchive>{.value = std::move(archive), .findings = std::move(layer.findings)};
}

Result<Loaded<MapArchive>> import_semantic(const ImportedFile& file) {
  HYPERMAP_ASSIGN_OR_RETURN(auto layer, read_semantic_layer(file.path));
  HYPERMAP_ASSIGN_OR_RETURN(MapArchive archive, of_layer(file, std::move(layer.value)));
  return Loaded<MapArchive>{.value = std::move(archive), .findings = std::move(layer.findings)};
}

Result<Loaded<MapArchive>> import_octree(const ImportedFile& file, const ImportJob& job) {
  HYPERMAP_ASSIGN_OR_RETURN(std::string bytes, read_file(file.path, job.limits.max_octree_bytes));
  HYPERMAP_ASSIGN_OR_RETURN(auto tree, parse_octomap(bytes, {.file = file.path.string()}));
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

Result<Loaded<MapArchive>> import_archive(const ImportedFile& file, const ImportJob& job) {
  HYPERMAP_ASSIGN_OR_RETURN(auto loaded,
                            load_archive(file.path, job.limits, archive_layer_types(), job.stop));
  if (loaded.value.checkpoint.kind != ValueKind::kNull) {
    return unsupported(file, "is a checkpoint: map --resume ends its run first");
  }
  const bool is_as_it_was = file.name.empty() && file.frame_id == kMapFrame;
  if (is_as_it_was) return loaded;
  if (has_3d(loaded.value)) {
    return unsupported(file, "has objects or voxels: it keeps its names and its frame");
  }
  HYPERMAP_ASSIGN_OR_RETURN(loaded.value, renamed(std::move(loaded.value), file));
  return loaded;
}

/// What a file that is no archive becomes.
Result<Loaded<MapArchive>> import_layer(FileKind kind,
                                        const ImportedFile& file,
                                        const ImportJob& job) {
  switch (kind) {
    case FileKind::kMap:
      return import_map(file, job);
    case FileKind::kSemantic:
      return import_semantic(file);
    case FileKind::kOctree:
      return import_octree(file, job);
    default:
      return unsupported(file,
                         "is a file of kind " + std::string(name_of(kind)) +
                             ", which is no part of a map: archive, config, map, semantic and "
                             "octree are");
  }
}

Result<Loaded<MapArchive>> import_file(const ImportedFile& file, const ImportJob& job) {
  HYPERMAP_ASSIGN_OR_RETURN(const FileKind kind, find_file_kind(file.path));
  if (kind == FileKind::kArchive || kind == FileKind::kConfig) return import_archive(file, job);
  HYPERMAP_ASSIGN_OR_RETURN(auto imported, import_layer(kind, file, job));
  HYPERMAP_ASSIGN_OR_RETURN(Provenance from, provenance_of(file, job.limits.max_octree_bytes));
  imported.value.provenance.push_back(std::move(from));
  return imported;
}

/// A file with what came of it.
struct Part {
  const ImportedFile* file = nullptr;
  MapArchive archive;
};

Finding left_out(const Part& part, const std::string& what) {
  return {Severity::kWarning,
          {.code = ErrorCode::kUnsupported, .what = what, .file = part.file->path.string()}};
}

Result<void> add_frames(Hypermap& hypermap, const Part& part) {
  for (const FrameTransform& transform : part.archive.hypermap.frames().transforms()) {
    const auto& there = hypermap.frames().transforms();
    if (std::ranges::find(there, transform) != there.end()) continue;
    if (const auto added = hypermap.frames().add(transform); !added) {
      return about(*part.file, added.error());
    }
  }
  return {};
}

Result<void> check_new_layer(const MapArchive& whole, const Part& part, const std::string& name) {
  const auto is_octomap = [&](const OctomapExtension& one) { return one.entry.name == name; };
  if (whole.hypermap.find(name) == nullptr && std::ranges::none_of(whole.octomaps, is_octomap)) {
    return {};
  }
  return about(*part.file,
               {.code = ErrorCode::kInvalidArgument,
                .what = "has a layer " + printable(name) +
                        ", as another file has: NAME=FILE gives it a name of its own"});
}

Result<void> add_layers(MapArchive& whole, const Part& part) {
  for (const Layer& layer : part.archive.hypermap.layers()) {
    HYPERMAP_TRY(check_new_layer(whole, part, layer.info.name));
    Layer added = layer;
    added.info.file = std::nullopt;  // as the name, which nobody else has
    if (auto done = whole.hypermap.add_layer(std::move(added)); !done) {
      return about(*part.file, done.error());
    }
  }
  for (const OctomapExtension& octomap : part.archive.octomaps) {
    HYPERMAP_TRY(check_new_layer(whole, part, octomap.entry.name));
    whole.octomaps.push_back(octomap);
  }
  return add_frames(whole.hypermap, part);
}

/// What a part without 3D brings. The findings tell what of it is left out.
Result<std::vector<Finding>> add_part(MapArchive& whole, const Part& part) {
  HYPERMAP_TRY(add_layers(whole, part));
  for (const std::string& name : part.archive.classes.names()) {
    if (const auto added = whole.classes.add(name); !added) {
      return about(*part.file, added.error());
    }
  }
  whole.class_grids.insert(
      whole.class_grids.end(), part.archive.class_grids.begin(), part.archive.class_grids.end());
  // Runs that put frames into the map stay the newest ones: it goes on from them.
  whole.provenance.insert(
      whole.provenance.begin(), part.archive.provenance.begin(), part.archive.provenance.end());
  std::vector<Finding> findings;
  if (whole.vocabulary.empty()) {
    whole.vocabulary = part.archive.vocabulary;
  } else if (!part.archive.vocabulary.empty() && part.archive.vocabulary != whole.vocabulary) {
    findings.push_back(left_out(part, "its names of classes are left out: another file has some"));
  }
  if (!part.archive.opaque_files.empty() || !part.archive.foreign_extensions.empty()) {
    findings.push_back(left_out(part, "members that nobody knows are left out"));
  }
  return findings;
}

/// The part with objects or voxels, or an empty one.
Result<std::optional<std::size_t>> whole_part(const std::vector<Part>& parts) {
  std::optional<std::size_t> whole;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (!has_3d(parts[i].archive)) continue;
    if (whole) {
      return unsupported(*parts[i].file,
                         "has objects or voxels, as " + parts[*whole].file->path.string() +
                             " has: only one map can bring them");
    }
    whole = i;
  }
  return whole;
}

}  // namespace

Result<Loaded<MapArchive>> run_import(const ImportJob& job) {
  if (job.files.empty()) return fail(ErrorCode::kInvalidArgument, "no files", "files");
  std::vector<Part> parts;
  std::vector<Finding> findings;
  for (const ImportedFile& file : job.files) {
    auto imported = import_file(file, job);
    if (!imported) return about(file, imported.error());
    std::ranges::move(imported->findings, std::back_inserter(findings));
    parts.push_back({.file = &file, .archive = std::move(imported->value)});
  }
  HYPERMAP_ASSIGN_OR_RETURN(const auto first, whole_part(parts));
  MapArchive whole = first ? std::move(parts[*first].archive) : MapArchive{};
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (i == first) continue;
    HYPERMAP_ASSIGN_OR_RETURN(auto left, add_part(whole, parts[i]));
    std::ranges::move(left, std::back_inserter(findings));
  }
  for (const FrameTransform& transform : job.transforms) {
    HYPERMAP_TRY(whole.hypermap.frames().add(transform));
  }
  return Loaded<MapArchive>{.value = std::move(whole), .findings = std::move(findings)};
}

}  // namespace hypermap
