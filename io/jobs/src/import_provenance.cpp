// SPDX-License-Identifier: BSD-3-Clause
#include "import_provenance.hpp"

#include "hypermap/io/archive/hypermap_config.hpp"
#include "hypermap/io/archive/map_server.hpp"
#include "hypermap/io/codec/bounded_yaml.hpp"
#include "hypermap/io/codec/byte_source.hpp"

#include <algorithm>
#include <filesystem>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

namespace fs = std::filesystem;

/// The files that were read for one, in the order of their hash.
class ReadFiles {
 public:
  void add(fs::path path) { paths_.push_back(std::move(path)); }

  /// The description of a grid, and the image that it names.
  Result<void> add_map(const fs::path& path) {
    HYPERMAP_ASSIGN_OR_RETURN(const std::string yaml, read_file(path, YamlLimits{}.max_bytes));
    HYPERMAP_ASSIGN_OR_RETURN(const auto metadata,
                              parse_map_metadata(yaml, {.file = path.string()}));
    add(path);
    add(path.parent_path() / metadata.value.image);
    return {};
  }

  /// A member by its name, or by the stem of its description. What is not there was not read.
  Result<void> add_member(const fs::path& member, bool is_grid) {
    std::error_code unreadable;
    const fs::path description = member.string() + ".yaml";
    if (is_grid && fs::is_regular_file(description, unreadable)) return add_map(description);
    for (const fs::path& path : {member, description}) {
      if (fs::is_regular_file(path, unreadable)) add(path);
    }
    return {};
  }

  [[nodiscard]] Result<std::string> hash(std::uint64_t max_bytes) const {
    constexpr std::uint64_t kPieceBytes = std::uint64_t{1} << 24U;
    InputHash hash;
    for (const fs::path& path : paths_) {
      HYPERMAP_ASSIGN_OR_RETURN(const auto source, open_file(path, max_bytes));
      std::uint64_t at = 0;
      do {
        const auto num_bytes = std::min(kPieceBytes, source->size() - at);
        HYPERMAP_ASSIGN_OR_RETURN(const std::string piece,
                                  source->read_at(at, static_cast<std::size_t>(num_bytes)));
        hash.add(piece);
        at += num_bytes;
      } while (at < source->size());
    }
    return hash.text();
  }

 private:
  std::vector<fs::path> paths_;
};

Result<void> add_configured(const fs::path& path, ReadFiles& files) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::string yaml, read_file(path, YamlLimits{}.max_bytes));
  HYPERMAP_ASSIGN_OR_RETURN(const auto config, parse_hypermap_config(yaml, {path.string()}));
  files.add(path);
  const fs::path folder = path.parent_path();
  for (const LayerEntry& layer : config.value.layers) {
    if (!layer.info.load_file) continue;
    HYPERMAP_TRY(files.add_member(folder / layer.info.file.value_or(layer.info.name),
                                  layer.class_name == kOccupancyLayerClass));
  }
  for (const ExtensionEntry& extension : config.value.extensions)
    HYPERMAP_TRY(files.add_member(folder / extension.file, extension.format == kClassGridFormat));
  return {};
}

Result<ReadFiles> files_of(const ImportedFile& file, FileKind kind) {
  ReadFiles files;
  if (kind == FileKind::kMap) {
    HYPERMAP_TRY(files.add_map(file.path));
  } else if (kind == FileKind::kConfig) {
    HYPERMAP_TRY(add_configured(file.path, files));
  } else {
    files.add(file.path);
  }
  return files;
}

/// By the names under which queries know them.
std::vector<ValueTree> layer_names(const MapArchive& archive) {
  std::vector<ValueTree> names;
  for (const Layer& layer : archive.hypermap.layers()) names.push_back(make_text(layer.info.name));
  for (const OctomapExtension& octomap : archive.octomaps)
    names.push_back(make_text(octomap.entry.name));
  if (archive.octree) names.push_back(make_text("octree"));
  if (!archive.objects.empty()) names.push_back(make_text("objects"));
  if (archive.topological_map) names.push_back(make_text("topological_map"));
  return names;
}

}  // namespace

Result<Provenance> import_provenance(const ImportedFile& file,
                                     FileKind kind,
                                     const MapArchive& imported,
                                     const ArchiveLimits& limits) {
  HYPERMAP_ASSIGN_OR_RETURN(const ReadFiles files, files_of(file, kind));
  HYPERMAP_ASSIGN_OR_RETURN(
      std::string hash,
      files.hash(std::max<std::uint64_t>(limits.max_octree_bytes, limits.zip.max_archive_bytes)));
  ValueTree import =
      make_map({{"layers", make_list(layer_names(imported))}, {"frame", make_text(file.frame_id)}});
  return Provenance{.tool = std::string("hypermap ") + HYPERMAP_VERSION,
                    .input = file.path.filename().string(),
                    .input_hash = std::move(hash),
                    .options = make_map({{"import", std::move(import)}}),
                    .map_from_input = {}};
}

}  // namespace hypermap
