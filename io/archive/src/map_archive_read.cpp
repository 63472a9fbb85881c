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

#include <algorithm>
#include <exception>
#include <iterator>
#include <memory>
#include <string_view>
#include <utility>

namespace hypermap {
namespace {

constexpr std::uint64_t kSignatureBytes = 4;

/// A bare configuration may name files anywhere; in the archive that the map is saved to, such a
/// file bears the layer's name.
Layer within_archive(Layer layer) {
  if (layer.info.file && !check_member_name(*layer.info.file)) layer.info.file.reset();
  return layer;
}

/// Puts a map together from the files that its configuration names.
class ArchiveReader {
 public:
  ArchiveReader(ArchiveMembers& members, const ArchiveLimits& limits, const LayerRegistry& layers)
      : members_(members), limits_(limits), layers_(layers) {}

  Result<Loaded<MapArchive>> read(const std::string& config_name) {
    HYPERMAP_ASSIGN_OR_RETURN(HypermapConfig config, read_config(config_name));
    HYPERMAP_TRY(check_declared_sizes(members_, config, limits_.sums, layers_));
    HYPERMAP_TRY(read_layers(config));
    HYPERMAP_TRY(read_extensions(config));
    HYPERMAP_TRY(check_classes(archive_));
    if (auto finding = forget_absent_objects(archive_)) findings_.push_back(std::move(*finding));
    HYPERMAP_TRY(keep_the_rest(config));
    return Loaded<MapArchive>{.value = std::move(archive_), .findings = std::move(findings_)};
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
    HYPERMAP_ASSIGN_OR_RETURN(auto findings,
                              read_extension(archive_, members_, entry, owner, limits_));
    keep(std::move(findings));
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
  MapArchive archive_;
  std::vector<Finding> findings_;
};

Result<Loaded<MapArchive>> read_all(ArchiveMembers& members,
                                    const std::string& config_name,
                                    const std::string& file,
                                    const ArchiveLimits& limits,
                                    const LayerRegistry& layers) {
  auto loaded = ArchiveReader(members, limits, layers).read(config_name);
  if (!loaded) return tl::make_unexpected(with_source(std::move(loaded).error(), {.file = file}));
  for (Finding& finding : loaded->findings)
    finding.error = with_source(std::move(finding.error), {.file = file});
  return loaded;
}

/// Nothing that a library throws gets past here.
template <class Read>
Result<Loaded<MapArchive>> guarded_read(const Read& read) {
  return guarded(ErrorCode::kMalformedFile, "the map", read);
}

Result<Loaded<MapArchive>> read_zip(std::shared_ptr<const ByteSource> source,
                                    const std::string& file,
                                    const ArchiveLimits& limits,
                                    const LayerRegistry& layers,
                                    const StopCheck& stop) {
  auto zip = ZipReader::create(std::move(source), limits.zip);
  if (!zip) return tl::make_unexpected(with_source(std::move(zip).error(), {.file = file}));
  ZipMembers members(std::move(*zip), file, LoadBudget(limits.sums, stop));
  return read_all(members, std::string(kConfigName), file, limits, layers);
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
  const auto others = {FileKind::kOctree, FileKind::kImage, FileKind::kDepth};
  if (!kind || std::find(others.begin(), others.end(), *kind) == others.end()) return {};
  return Unexpected(Error{.code = ErrorCode::kUnsupported,
                          .what = "is of kind '" + std::string(name_of(*kind)) +
                                  "', must be an archive (.hmap) or its configuration",
                          .file = path.string()});
}

}  // namespace

Result<Loaded<MapArchive>> load_archive(const std::filesystem::path& path,
                                        const ArchiveLimits& limits,
                                        const LayerRegistry& layers,
                                        const StopCheck& stop) {
  return guarded_read([&]() -> Result<Loaded<MapArchive>> {
    HYPERMAP_ASSIGN_OR_RETURN(std::shared_ptr<const ByteSource> source,
                              open_file(path, limits.zip.max_archive_bytes));
    HYPERMAP_ASSIGN_OR_RETURN(const bool is_zip, looks_like_zip(*source, path));
    if (is_zip) return read_zip(std::move(source), path.string(), limits, layers, stop);
    HYPERMAP_TRY(expect_configuration(path));
    FolderMembers members(path, LoadBudget(limits.sums, stop), limits.reach);
    return read_all(members, path.filename().string(), path.string(), limits, layers);
  });
}

Result<Loaded<MapArchive>> parse_archive(std::string_view bytes,
                                         const SourceName& source,
                                         const ArchiveLimits& limits,
                                         const LayerRegistry& layers,
                                         const StopCheck& stop) {
  return guarded_read(
      [&] { return read_zip(view_bytes(bytes), source.file, limits, layers, stop); });
}

}  // namespace hypermap
