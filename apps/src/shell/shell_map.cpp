// SPDX-License-Identifier: BSD-3-Clause
#include "shell_map.hpp"

#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/core/base/value_tree.hpp"
#include "hypermap/io/archive/archive_layers.hpp"
#include "hypermap/io/codec/file_kind.hpp"
#include "load_arguments.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

namespace hypermap::app {
namespace {

constexpr ArchiveParts kLayersAlone{.octrees = false, .objects = false, .class_grids = false};
constexpr std::int64_t kNanosecondsPerSecond = 1'000'000'000;

bool has_all(const ArchiveParts& parts) {
  return parts.octrees && parts.objects && parts.class_grids;
}

bool is_within(const ArchiveParts& asked, const ArchiveParts& read) {
  return (read.octrees || !asked.octrees) && (read.objects || !asked.objects) &&
         (read.class_grids || !asked.class_grids);
}

ArchiveParts both(const ArchiveParts& a, const ArchiveParts& b) {
  return {.octrees = a.octrees || b.octrees,
          .objects = a.objects || b.objects,
          .class_grids = a.class_grids || b.class_grids};
}

/// By which name the extension is asked as a layer.
std::string layer_name_of(const ExtensionEntry& entry) {
  if (entry.format != kClassGridFormat) return entry.name;
  const ValueTree* name = entry.extra.find("class");
  return name == nullptr ? entry.name : name->text;
}

Result<bool> is_configuration(const std::filesystem::path& path) {
  const auto kind = find_file_kind(path);
  if (kind) return *kind == FileKind::kConfig;
  if (kind.error().code == ErrorCode::kIo) return Unexpected(kind.error());
  return false;
}

}  // namespace

Result<ShellMap::FileIdentity> ShellMap::identity_of(const std::filesystem::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) {
    return Unexpected(Error{.code = ErrorCode::kIo,
                            .what = std::string("cannot be opened: ") + std::strerror(errno),
                            .file = path.string()});
  }
  return FileIdentity{
      .device = status.st_dev,
      .number = status.st_ino,
      .num_bytes = status.st_size,
      .changed_ns = status.st_mtim.tv_sec * kNanosecondsPerSecond + status.st_mtim.tv_nsec};
}

Result<void> ShellMap::load(const std::filesystem::path& path) {
  HYPERMAP_ASSIGN_OR_RETURN(const bool is_config, is_configuration(path));
  if (is_config) return load_whole_config(path);
  HYPERMAP_ASSIGN_OR_RETURN(FileIdentity identity, identity_of(path));
  HYPERMAP_ASSIGN_OR_RETURN(
      auto loaded,
      load_archive_parts(
          path, kLayersAlone, limits_, archive_layer_types(), stop_when_interrupted()));
  told_.clear();
  take(std::move(loaded.value), kLayersAlone);
  keep(std::move(loaded.findings));
  is_whole_ = false;
  archive_ = path;
  identity_ = identity;
  unsaved_.reset();
  ++revision_;
  return {};
}

Result<void> ShellMap::load_config(const std::filesystem::path& path) {
  HYPERMAP_ASSIGN_OR_RETURN(const auto kind, find_file_kind(path));
  if (kind != FileKind::kArchive) return load_whole_config(path);
  return Unexpected(Error{.code = ErrorCode::kInvalidArgument,
                          .what = "is an archive, which load reads, and no configuration",
                          .file = path.string()});
}

Result<void> ShellMap::load_whole_config(const std::filesystem::path& path) {
  HYPERMAP_ASSIGN_OR_RETURN(
      auto loaded, load_archive(path, limits_, archive_layer_types(), stop_when_interrupted()));
  told_.clear();
  take({.map = std::move(loaded.value)}, {});
  keep(std::move(loaded.findings));
  is_whole_ = true;
  archive_.reset();
  identity_.reset();
  unsaved_ = path;
  ++revision_;
  return {};
}

Result<void> ShellMap::save(const std::optional<std::filesystem::path>& path) {
  const auto& target = path ? path : archive_;
  if (!target) {
    return fail(ErrorCode::kInvalidArgument, "needs a file: the map stands for no archive yet");
  }
  HYPERMAP_ASSIGN_OR_RETURN(const MapArchive* map, whole());
  HYPERMAP_TRY(save_archive(*map, *target, {.limits = limits_}));
  const std::filesystem::path saved = *target;  // it may be that of archive_
  archive_ = saved;
  unsaved_.reset();
  return {};
}

void ShellMap::clear() {
  take({}, {});
  is_whole_ = true;
  archive_.reset();
  identity_.reset();
  unsaved_.reset();
  told_.clear();
}

void ShellMap::take(PartialMap map, const ArchiveParts& parts) {
  partial_ = std::move(map);
  parts_ = parts;
}

void ShellMap::keep(std::vector<Finding> findings) {
  for (Finding& finding : findings) {
    if (told_.insert(to_string(finding.error)).second) findings_.push_back(std::move(finding));
  }
}

std::vector<Finding> ShellMap::take_findings() {
  return std::exchange(findings_, {});
}

Result<void> ShellMap::expect_same_file() const {
  HYPERMAP_ASSIGN_OR_RETURN(const FileIdentity now, identity_of(*archive_));
  if (now == identity_) return {};
  return Unexpected(Error{.code = ErrorCode::kIo,
                          .what = "has changed since it was loaded: load it again",
                          .file = archive_->string()});
}

Result<const MapArchive*> ShellMap::with(const ArchiveParts& parts) {
  const ArchiveParts wanted = both(parts, parts_);
  if (is_within(parts, parts_)) return &partial_.map;
  if (has_all(wanted)) return whole();
  HYPERMAP_TRY(expect_same_file());
  HYPERMAP_ASSIGN_OR_RETURN(
      auto loaded,
      load_archive_parts(
          *archive_, wanted, limits_, archive_layer_types(), stop_when_interrupted()));
  HYPERMAP_TRY(expect_same_file());
  take(std::move(loaded.value), wanted);
  keep(std::move(loaded.findings));
  return &partial_.map;
}

Result<const MapArchive*> ShellMap::whole() {
  if (is_whole_) return &partial_.map;
  HYPERMAP_TRY(expect_same_file());
  HYPERMAP_ASSIGN_OR_RETURN(
      auto loaded,
      load_archive(*archive_, limits_, archive_layer_types(), stop_when_interrupted()));
  HYPERMAP_TRY(expect_same_file());
  take({.map = std::move(loaded.value)}, {});
  keep(std::move(loaded.findings));
  is_whole_ = true;
  return &partial_.map;
}

ArchiveParts ShellMap::parts_of(std::string_view layer) const {
  if (partial_.map.hypermap.find(layer) != nullptr) return kLayersAlone;
  const auto is_asked = [&](const ExtensionEntry& entry) {
    return is_spelling_of(layer_name_of(entry), layer);
  };
  const auto entry = std::ranges::find_if(partial_.left_out, is_asked);
  if (is_spelling_of(kObjectsLayer, layer) || is_spelling_of(kTopologicalMapLayer, layer) ||
      (entry != partial_.left_out.end() && entry->format == kObjectsFormat)) {
    return {.octrees = false, .objects = true, .class_grids = false};
  }
  if (entry != partial_.left_out.end() && entry->format == kClassGridFormat)
    return {.octrees = false, .objects = false, .class_grids = true};
  // Voxels have the classes of objects; a name that nothing bears may be an alias of a class.
  if (entry != partial_.left_out.end() || is_spelling_of(kEvidenceLayer, layer))
    return {.octrees = true, .objects = true, .class_grids = false};
  return {};
}

Result<const MapArchive*> ShellMap::for_layer(std::string_view name) {
  return with(parts_of(name));
}

std::vector<ShellLayer> ShellMap::layers() const {
  std::vector<ShellLayer> list;
  for (const Layer& layer : archive_layers(partial_.map)) {
    list.push_back({.name = layer.info.name,
                    .class_name = std::string(class_of(layer)),
                    .frame_id = layer.info.frame_id});
  }
  for (const std::string_view format : {kOctomapFormat, kObjectsFormat, kClassGridFormat}) {
    for (const ExtensionEntry& entry : partial_.left_out) {
      if (entry.format != format) continue;
      list.push_back(
          {.name = layer_name_of(entry), .class_name = entry.format, .frame_id = entry.frame_id});
    }
  }
  return list;
}

}  // namespace hypermap::app
