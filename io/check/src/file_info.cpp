// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/check/file_info.hpp"

#include "hypermap/io/archive/grid_stack_layer.hpp"
#include "hypermap/io/archive/map_server.hpp"
#include "hypermap/io/archive/octomap_file.hpp"
#include "hypermap/io/codec/file_kind.hpp"
#include "hypermap/io/jobs/tile_set.hpp"
#include "hypermap/io/tiles/tile_map.hpp"

#include <filesystem>
#include <string>
#include <system_error>
#include <utility>

namespace hypermap {
namespace {

using DescribedFile = Result<Loaded<FileInfo>>;

DescribedFile describe_archive(const std::filesystem::path& path,
                               const ArchiveLimits& limits,
                               const StopCheck& stop) {
  HYPERMAP_ASSIGN_OR_RETURN(auto loaded, load_archive(path, limits, archive_layer_types(), stop));
  return Loaded<FileInfo>{describe(loaded.value), std::move(loaded.findings)};
}

DescribedFile describe_octree(const std::filesystem::path& path) {
  HYPERMAP_ASSIGN_OR_RETURN(auto loaded, read_octomap(path));
  ExtensionEntry entry{.format = std::string(kOctomapFormat), .version = 1, .name = "octree"};
  MapArchive archive;
  archive.octomaps.push_back(
      {.entry = std::move(entry), .bytes = {}, .tree = std::move(loaded.value)});
  return Loaded<FileInfo>{describe(archive), std::move(loaded.findings)};
}

DescribedFile describe_map(const std::filesystem::path& path, FileReach reach) {
  HYPERMAP_ASSIGN_OR_RETURN(auto loaded, read_map(path, MapDialect::kMapServer, reach));
  MapArchive archive;
  HYPERMAP_TRY(archive.hypermap.add_layer({LayerInfo{.name = "map"}, std::move(loaded.value)}));
  return Loaded<FileInfo>{describe(archive), std::move(loaded.findings)};
}

DescribedFile describe_dataset(const std::filesystem::path& path,
                               const std::optional<std::filesystem::path>& description) {
  ClassRegistry classes;
  HYPERMAP_ASSIGN_OR_RETURN(const auto dataset,
                            open_dataset(path, {.description = description}, classes));
  return Loaded<FileInfo>{dataset->summary(), dataset->summary().findings};
}

/// A folder of tiles as an archive with the stack that they are.
DescribedFile describe_tiles(const std::filesystem::path& path) {
  std::error_code failed;
  if (!std::filesystem::is_directory(path, failed)) {
    return Unexpected(
        Error{.code = ErrorCode::kUnsupported,
              .what = "is one tile: check judges it, info tells of the folder that it is in",
              .file = path.string()});
  }
  HYPERMAP_ASSIGN_OR_RETURN(GridStack stack, read_tile_map(path));
  LayerInfo info{.name = "tiles", .frame_id = stack.options().frame_id};
  MapArchive archive;
  HYPERMAP_TRY(archive.hypermap.add_layer({std::move(info), GridStackLayer(std::move(stack))}));
  return Loaded<FileInfo>{describe(archive), {}};
}

}  // namespace

Result<Loaded<FileInfo>> describe_file(const std::filesystem::path& path,
                                       const ArchiveLimits& limits,
                                       const StopCheck& stop,
                                       const std::optional<std::filesystem::path>& description) {
  if (is_tile_set(path)) {
    return Unexpected(
        Error{.code = ErrorCode::kUnsupported,
              .what = "is a map in tiles: query takes it as it is, info tells of one tile (.hmap)",
              .file = path.string()});
  }
  HYPERMAP_ASSIGN_OR_RETURN(const FileKind kind, find_file_kind(path));
  switch (kind) {
    case FileKind::kDataset:
      return describe_dataset(path, description);
    case FileKind::kOctree:
      return describe_octree(path);
    case FileKind::kTile:
      return describe_tiles(path);
    case FileKind::kMap:
      return describe_map(path, limits.reach);
    default:
      return describe_archive(path, limits, stop);
  }
}

}  // namespace hypermap
