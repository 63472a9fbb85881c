// SPDX-License-Identifier: BSD-3-Clause
#include "archive_checks.hpp"
#include "archive_extensions.hpp"
#include "hypermap/core/base/caught.hpp"
#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/io/codec/atomic_file.hpp"
#include "hypermap/io/codec/byte_source.hpp"
#include "layers/layer_files.hpp"
#include "member_files.hpp"

#include <tbb/task_arena.h>

#include <algorithm>
#include <exception>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

/// The twin is named after its octree, the first extension; its file comes last and takes no other
/// file's name.
void append_twin(HypermapConfig& config, std::vector<MemberFile>& files, OctreeTwin twin) {
  const auto has_its_name = [&twin](const MemberFile& file) {
    return file.name == twin.entry.file;
  };
  if (std::any_of(files.begin(), files.end(), has_its_name)) return;
  files.push_back(std::move(twin.file));
  config.extensions.insert(config.extensions.begin() + 1, std::move(twin.entry));
}

/// The configuration, then the files of layers and extensions in its order, then the rest.
Result<std::vector<MemberFile>> members_of(const MapArchive& archive, const ZipLimits& limits) {
  HypermapConfig config{.frames = archive.hypermap.frames(),
                        .foreign_extensions = archive.foreign_extensions,
                        .extra = archive.hypermap.extra()};
  std::vector<MemberFile> files;
  for (const Layer& layer : archive.hypermap.layers()) {
    if (!is_strict_form(layer)) continue;
    config.layers.push_back({.class_name = std::string(class_of(layer)), .info = layer.info});
    HYPERMAP_ASSIGN_OR_RETURN(auto layer_files, write_layer(layer));
    append_files(files, std::move(layer_files));
  }
  HYPERMAP_ASSIGN_OR_RETURN(WrittenExtensions extensions, write_extensions(archive, limits));
  config.extensions = std::move(extensions.entries);
  std::move(extensions.files.begin(), extensions.files.end(), std::back_inserter(files));
  append_files(files, archive.opaque_files);
  if (extensions.octree_twin) append_twin(config, files, *std::move(extensions.octree_twin));
  files.insert(files.begin(),
               {.name = std::string(kConfigName), .bytes = write_hypermap_config(config)});
  return files;
}

/// The first part in which two maps differ, or an empty text.
std::string first_difference(const MapArchive& a, const MapArchive& b) {
  if (!(a.hypermap == b.hypermap)) return "layers";
  if (!(a.classes == b.classes)) return "classes";
  if (!(a.objects == b.objects)) return "objects";
  if (!(a.views == b.views)) return "views";
  if (!(a.topological_map == b.topological_map)) return "topological map";
  if (!(a.octree == b.octree)) return "octree";
  if (!(a.class_grids == b.class_grids)) return "class grids";
  if (!(a.provenance == b.provenance)) return "provenance";
  if (!(a.checkpoint == b.checkpoint)) return "checkpoint";
  if (!(a.true_surfaces == b.true_surfaces)) return "true surfaces";
  if (!(a.octomaps == b.octomaps)) return "octomaps";
  if (!(a.foreign_extensions == b.foreign_extensions)) return "foreign extensions";
  if (!(a.opaque_files == b.opaque_files)) return "opaque files";
  return {};
}

/// Verification loads what was written: it must know every type of layer.
Result<void> check_layer_types(const MapArchive& archive, const LayerRegistry& types) {
  for (const Layer& layer : archive.hypermap.layers()) {
    if (is_strict_form(layer) || types.find(class_of(layer)) != nullptr) continue;
    return fail(ErrorCode::kInvalidArgument,
                "not saved, layer " + printable(layer.info.name) + " is of type " +
                    printable(class_of(layer)) +
                    ", which is not among SaveOptions::layers: what was written cannot be verified",
                "layers");
  }
  return {};
}

/// What the loader would say of these bytes, and whether it would get the same map.
Result<void> verify_bytes(const MapArchive& archive,
                          std::string_view bytes,
                          const SourceName& source,
                          const SaveOptions& options) {
  auto again = parse_archive(bytes, source, options.limits, options.layers);
  if (!again) {
    Error error = std::move(again).error();
    error.what = "not saved, the archive could not be loaded again: " + error.what;
    return tl::make_unexpected(std::move(error));
  }
  const std::string difference = first_difference(archive, again->value);
  if (difference.empty()) return {};
  return fail(ErrorCode::kMalformedFile,
              "not saved, the map would not be the same after loading",
              difference);
}

bool is_verified(std::string_view bytes, const SaveOptions& options) {
  return options.verify && bytes.size() <= options.max_verified_bytes;
}

/// What is to be in the file. Errors: without its name.
Result<std::string> verified_bytes(const MapArchive& archive,
                                   const std::filesystem::path& path,
                                   const SaveOptions& options) {
  auto bytes = write_archive(archive, options.limits);
  if (!bytes || !is_verified(*bytes, options)) return bytes;
  HYPERMAP_TRY(check_layer_types(archive, options.layers));
  HYPERMAP_TRY(verify_bytes(archive, *bytes, {.file = path.string()}, options));
  return bytes;
}

int num_threads_of(const SaveOptions& options) {
  const int most = tbb::this_task_arena::max_concurrency();
  return options.num_threads > 0 ? std::min(options.num_threads, most) : most;
}

Result<void> verify_file(const std::filesystem::path& path, std::string_view bytes) try {
  auto stored = read_file(path, bytes.size());
  if (stored && *stored == bytes) return {};
  Error error{.code = ErrorCode::kIo,
              .what = "the disk returns other bytes than were written",
              .file = path.string()};
  if (!stored) error = std::move(stored).error();
  error.what.insert(0, "replaced, yet ");
  return tl::make_unexpected(std::move(error));
} catch (const std::bad_alloc&) {
  return fail(ErrorCode::kOutOfMemory, "replaced, yet there is no memory to look at it again");
}

}  // namespace

Result<std::string> write_archive(const MapArchive& archive, const ArchiveLimits& limits) try {
  HYPERMAP_TRY(check_classes(archive));
  HYPERMAP_TRY(check_objects_of_voxels(archive));
  HYPERMAP_ASSIGN_OR_RETURN(auto files, members_of(archive, limits.zip));
  return zip_of(std::move(files), limits.zip);
} catch (const std::exception& exception) {
  return caught(exception, ErrorCode::kInvalidArgument, "the archive");
}

Result<void> save_archive(const MapArchive& archive,
                          const std::filesystem::path& path,
                          const SaveOptions& options) try {
  const auto in_file = [&path](Error error) {
    return tl::make_unexpected(with_source(std::move(error), {.file = path.string()}));
  };
  tbb::task_arena arena(num_threads_of(options));
  const auto bytes = arena.execute([&] { return verified_bytes(archive, path, options); });
  if (!bytes) return in_file(bytes.error());
  HYPERMAP_TRY(write_file_atomically(path, *bytes));
  if (is_verified(*bytes, options)) return verify_file(path, *bytes);
  return {};
} catch (const std::bad_alloc&) {
  return fail(ErrorCode::kOutOfMemory, "not saved, no memory for the archive");
}

}  // namespace hypermap
