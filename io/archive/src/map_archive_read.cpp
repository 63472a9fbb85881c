// SPDX-License-Identifier: BSD-3-Clause
#include "archive_checks.hpp"
#include "archive_extensions.hpp"
#include "archive_members.hpp"
#include "declared_sizes.hpp"
#include "hypermap/core/base/caught.hpp"
#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/io/codec/byte_source.hpp"
#include "hypermap/io/codec/file_kind.hpp"
#include "layers/layer_files.hpp"
#include "octree/floor_keys.hpp"
#include "octree/octomap_header.hpp"

#include <algorithm>
#include <exception>
#include <iterator>
#include <limits>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>

namespace hypermap {
namespace {

constexpr std::uint64_t kSignatureBytes = 4;
/// Whoever reads what is in a file knows how large that may be.
constexpr std::uint64_t kAnySize = std::numeric_limits<std::uint64_t>::max();

/// A bare configuration may name files anywhere; in the archive that the map is saved to, such a
/// file bears the layer's name.
Layer within_archive(Layer layer) {
  if (layer.info.file && !check_member_name(*layer.info.file)) layer.info.file.reset();
  return layer;
}

/// Puts a map together from the files that its configuration names.
class ArchiveReader {
 public:
  ArchiveReader(ArchiveMembers& members,
                const ArchiveLimits& limits,
                const LayerRegistry& layers,
                const std::optional<ArchiveParts>& parts)
      : members_(members), limits_(limits), layers_(layers), parts_(parts) {}

  Result<Loaded<PartialMap>> read(const std::string& config_name) {
    HYPERMAP_ASSIGN_OR_RETURN(HypermapConfig config, read_config(config_name));
    HYPERMAP_TRY(check_declared_sizes(members_, config, limits_.sums, layers_));
    HYPERMAP_TRY(read_layers(config));
    HYPERMAP_TRY(read_extensions(config));
    HYPERMAP_TRY(check_classes(archive_));
    if (!parts_ || parts_->objects) {
      if (auto finding = forget_absent_objects(archive_)) findings_.push_back(std::move(*finding));
    }
    if (archive_.octree) octree_resolution_m_ = archive_.octree->resolution_m();
    if (!parts_) HYPERMAP_TRY(keep_the_rest(config));
    return Loaded<PartialMap>{.value = {.map = std::move(archive_),
                                        .octree_resolution_m = octree_resolution_m_,
                                        .left_out = std::move(left_out_)},
                              .findings = std::move(findings_)};
  }

 private:
  Result<HypermapConfig> read_config(const std::string& name) {
    if (!members_.contains(name))
      return fail(ErrorCode::kMalformedFile,
                  "not a map archive: it has no member " + std::string(kConfigName));
    HYPERMAP_ASSIGN_OR_RETURN(const std::string bytes,
                              members_.take(name, "the configuration", limits_.max_text_bytes));
    HYPERMAP_ASSIGN_OR_RETURN(auto config,
                              parse_hypermap_config(bytes, members_.source_of(name), layers_));
    keep(std::move(config.findings));
    return std::move(config.value);
  }

  Result<void> read_layers(const HypermapConfig& config) {
    archive_.hypermap.frames() = config.frames;
    archive_.hypermap.set_extra(config.extra);
    for (std::size_t i = 0; i < config.layers.size(); ++i) {
      const LayerEntry& entry = config.layers[i];
      HYPERMAP_ASSIGN_OR_RETURN(auto content, read_layer(members_, entry, i, limits_, layers_));
      keep(std::move(content.findings));
      HYPERMAP_TRY(archive_.hypermap.add_layer(
          within_archive({.info = entry.info, .content = std::move(content.value)})));
    }
    return {};
  }

  Result<void> read_extensions(const HypermapConfig& config) {
    archive_.foreign_extensions = config.foreign_extensions;
    // Embeddings and views speak of objects, which may stand behind them.
    for (const bool of_objects : {false, true}) {
      for (std::size_t i = 0; i < config.extensions.size(); ++i) {
        const std::string& format = config.extensions[i].format;
        const bool is_of_objects = format == kEmbeddingsFormat || format == kViewsFormat;
        if (is_of_objects == of_objects) HYPERMAP_TRY(read_one(config.extensions[i], i));
      }
    }
    return {};
  }

  Result<void> read_one(const ExtensionEntry& entry, std::size_t position) {
    const std::string owner = "extensions[" + std::to_string(position) + "].file";
    if (layers_.find(entry.format) != nullptr) return read_registered_layer(entry, owner);
    if (is_left_out(entry.format)) return leave_out(entry, owner);
    HYPERMAP_ASSIGN_OR_RETURN(auto findings,
                              read_extension(archive_, members_, entry, owner, limits_));
    keep(std::move(findings));
    return {};
  }

  [[nodiscard]] bool is_left_out(std::string_view format) const {
    if (!parts_) return false;
    if (format == kOctomapFormat || format == kOctreeTwinFormat) return !parts_->octrees;
    if (format == kClassGridFormat) return !parts_->class_grids;
    const bool is_of_objects = format == kObjectsFormat || format == kEmbeddingsFormat ||
                               format == kViewsFormat || format == kTopologicalMapFormat;
    return is_of_objects && !parts_->objects;
  }

  /// A part that is not read may still lead nowhere.
  Result<void> leave_out(const ExtensionEntry& entry, const std::string& owner) {
    HYPERMAP_TRY(members_.check(entry.file, owner));
    left_out_.push_back(entry);
    if (entry.format != kOctomapFormat || octree_resolution_m_) return {};
    constexpr std::size_t kOctreeStartBytes = std::size_t{1} << 12U;
    const auto start = members_.start_of(entry.file, kOctreeStartBytes);
    if (!start) return {};
    const auto header = parse_octomap_header(*start);
    if (!header || header->id != kSemanticOctreeId) return {};
    octree_resolution_m_ = header->resolution_m;
    archive_.floor = floor_of_keys(entry.extra).value_or(MapFloor{});
    return {};
  }

  Result<void> read_registered_layer(const ExtensionEntry& entry, const std::string& owner) {
    HYPERMAP_ASSIGN_OR_RETURN(auto layer,
                              read_extension_layer(members_, entry, owner, limits_, layers_));
    keep(std::move(layer.findings));
    return archive_.hypermap.add_layer(within_archive(std::move(layer.value)));
  }

  /// Files that nothing names may belong to what is not understood, so they are kept.
  Result<void> keep_the_rest(const HypermapConfig& config) {
    HYPERMAP_ASSIGN_OR_RETURN(archive_.opaque_files, members_.rest(limits_.zip.max_entry_bytes));
    if (!config.foreign_extensions.empty()) return {};
    for (const OpaqueFile& file : archive_.opaque_files) {
      Error error{.code = ErrorCode::kMalformedFile, .what = "is named by nothing; it is kept"};
      findings_.push_back({.error = with_source(std::move(error), members_.source_of(file.name))});
    }
    return {};
  }

  void keep(std::vector<Finding> findings) {
    std::move(findings.begin(), findings.end(), std::back_inserter(findings_));
  }

  ArchiveMembers& members_;
  const ArchiveLimits& limits_;
  const LayerRegistry& layers_;
  const std::optional<ArchiveParts>& parts_;  ///< None: all there is.
  MapArchive archive_;
  std::optional<double> octree_resolution_m_;
  std::vector<ExtensionEntry> left_out_;
  std::vector<Finding> findings_;
};

/// What is read, and how.
struct Reading {
  const ArchiveLimits& limits;
  const LayerRegistry& layers;
  const StopCheck& stop;
  std::optional<ArchiveParts> parts = std::nullopt;  ///< None: all there is.
};

Result<Loaded<PartialMap>> read_all(ArchiveMembers& members,
                                    const std::string& config_name,
                                    const std::string& file,
                                    const Reading& reading) {
  auto loaded =
      ArchiveReader(members, reading.limits, reading.layers, reading.parts).read(config_name);
  if (!loaded) return tl::make_unexpected(with_source(std::move(loaded).error(), {.file = file}));
  for (Finding& finding : loaded->findings)
    finding.error = with_source(std::move(finding.error), {.file = file});
  return loaded;
}

/// Nothing that a library throws gets past here.
template <class Read>
Result<Loaded<PartialMap>> guarded_read(const Read& read) {
  return guarded(ErrorCode::kMalformedFile, "the map", read);
}

Result<Loaded<PartialMap>> read_zip(std::shared_ptr<const ByteSource> source,
                                    const std::string& file,
                                    const Reading& reading) {
  auto zip = ZipReader::create(std::move(source), reading.limits.zip);
  if (!zip) return tl::make_unexpected(with_source(std::move(zip).error(), {.file = file}));
  ZipMembers members(std::move(*zip), file, LoadBudget(reading.limits.sums, reading.stop));
  return read_all(members, std::string(kConfigName), file, reading);
}

/// A zip file begins with a local header, or with the end record when it is empty; whatever else
/// begins with "PK" is a damaged one.
Result<bool> looks_like_zip(const ByteSource& source, const std::filesystem::path& path) {
  if (path.extension() == ".hmap" || source.size() < kSignatureBytes) return true;
  HYPERMAP_ASSIGN_OR_RETURN(const std::string start, source.read_at(0, kSignatureBytes));
  return start.starts_with("PK");
}

/// A file of another kind should be named as such, not that its first byte is no text.
Result<void> expect_configuration(const std::filesystem::path& path) {
  const auto kind = find_file_kind(path);
  const auto others = {FileKind::kOctree, FileKind::kImage, FileKind::kDepth, FileKind::kTileSet};
  if (!kind || std::find(others.begin(), others.end(), *kind) == others.end()) return {};
  return Unexpected(Error{.code = ErrorCode::kUnsupported,
                          .what = "is of kind '" + std::string(name_of(*kind)) +
                                  "', must be an archive (.hmap) or its configuration",
                          .file = path.string()});
}

Result<Loaded<PartialMap>> read_map_file(const std::filesystem::path& path,
                                         const Reading& reading) {
  return guarded_read([&]() -> Result<Loaded<PartialMap>> {
    HYPERMAP_ASSIGN_OR_RETURN(std::shared_ptr<const ByteSource> source, open_file(path, kAnySize));
    HYPERMAP_ASSIGN_OR_RETURN(const bool is_zip, looks_like_zip(*source, path));
    if (is_zip) return read_zip(std::move(source), path.string(), reading);
    HYPERMAP_TRY(expect_configuration(path));
    FolderMembers members(
        path, LoadBudget(reading.limits.sums, reading.stop), reading.limits.reach);
    return read_all(members, path.filename().string(), path.string(), reading);
  });
}

Result<Loaded<MapArchive>> whole(Result<Loaded<PartialMap>> read) {
  if (!read) return tl::make_unexpected(std::move(read).error());
  return Loaded<MapArchive>{.value = std::move(read->value.map),
                            .findings = std::move(read->findings)};
}

}  // namespace

Result<Loaded<MapArchive>> load_archive(const std::filesystem::path& path,
                                        const ArchiveLimits& limits,
                                        const LayerRegistry& layers,
                                        const StopCheck& stop) {
  return whole(read_map_file(path, {.limits = limits, .layers = layers, .stop = stop}));
}

Result<Loaded<PartialMap>> load_archive_parts(const std::filesystem::path& path,
                                              const ArchiveParts& parts,
                                              const ArchiveLimits& limits,
                                              const LayerRegistry& layers,
                                              const StopCheck& stop) {
  return read_map_file(path, {.limits = limits, .layers = layers, .stop = stop, .parts = parts});
}

Result<Loaded<MapArchive>> parse_archive(std::string_view bytes,
                                         const SourceName& source,
                                         const ArchiveLimits& limits,
                                         const LayerRegistry& layers,
                                         const StopCheck& stop) {
  return whole(guarded_read([&] {
    return read_zip(
        view_bytes(bytes), source.file, {.limits = limits, .layers = layers, .stop = stop});
  }));
}

}  // namespace hypermap
