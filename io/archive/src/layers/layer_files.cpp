// SPDX-License-Identifier: BSD-3-Clause
#include "layer_files.hpp"

#include "hypermap/io/archive/map_server.hpp"
#include "hypermap/io/codec/bounded_yaml.hpp"
#include "hypermap/io/codec/image_file.hpp"
#include "hypermap/io/codec/value_keys.hpp"
#include "layer_member_files.hpp"

#include <array>
#include <filesystem>
#include <iterator>
#include <optional>
#include <utility>

namespace hypermap {
namespace {

using Flag = std::optional<bool> LayerInfo::*;
constexpr std::array<std::pair<std::string_view, Flag>, 3> kFlags{
    {{"subscribe_mode", &LayerInfo::subscribe_mode},
     {"enable_update", &LayerInfo::enable_update},
     {"publish_global_topics", &LayerInfo::publish_global_topics}}};
constexpr std::array<std::string_view, 3> kFlagKeys{
    kFlags[0].first, kFlags[1].first, kFlags[2].first};

/// Runs the loader of a class; what it finds wrong is told of the member read last.
Result<Loaded<LayerContent>> load_content(const LayerType& type, MemberFileReader& reader) {
  auto content = type.load(reader);
  if (!content) {
    Error error = std::move(content).error();
    if (error.file.empty()) error = with_source(std::move(error), reader.last_source());
    return tl::make_unexpected(std::move(error));
  }
  return Loaded<LayerContent>{.value = std::move(*content), .findings = reader.take_findings()};
}

/// Keeps the file of a layer that is not understood, if there is one.
Result<Loaded<LayerContent>> read_opaque_layer(ArchiveMembers& members,
                                               const LayerEntry& entry,
                                               const std::string& owner,
                                               const ArchiveLimits& limits) {
  std::optional<std::string> bytes;
  const std::string file = stem_of(entry.info);
  if (entry.info.load_file && members.contains(file)) {
    HYPERMAP_ASSIGN_OR_RETURN(bytes, members.take_opaque(file, owner, limits.zip.max_entry_bytes));
  }
  Loaded<LayerContent> loaded{.value = OpaqueLayer(entry.class_name, std::move(bytes)),
                              .findings = {}};
  loaded.findings.push_back(
      {.error = {.code = ErrorCode::kUnsupported,
                 .what = "unknown layer class '" + printable(entry.class_name, 40) +
                         "' is kept as it is, unread",
                 .field = owner}});
  return loaded;
}

/// A layer that is not to be loaded must have nothing to lose.
Result<void> check_nothing_is_lost(const Layer& layer) {
  const bool kept = layer.info.load_file || layer.content.as<OpaqueLayer>() != nullptr;
  if (kept || layer.content == OccupancyLayer() || layer.content == SemanticLayer()) return {};
  return fail(
      ErrorCode::kInvalidArgument,
      "has content, yet load_file is false, so it would be lost: its configuration must say "
      "load_file: true",
      "layer " + printable(layer.info.name));
}

/// What the configuration says of the layer besides its file. Errors: kMalformedFile for a flag
/// that is none.
Result<LayerInfo> info_of(const ExtensionEntry& entry) {
  LayerInfo info{.name = entry.name,
                 .frame_id = entry.frame_id,
                 .file = entry.file,
                 .extra = other_keys(entry.extra, kFlagKeys)};
  const SourceName unnamed;
  const YamlNode keys(entry.extra, "", unnamed);
  for (const auto& [key, flag] : kFlags) {
    const auto node = keys.find(key);
    if (!node) continue;
    HYPERMAP_ASSIGN_OR_RETURN(info.*flag, node->as_bool());
  }
  return info;
}

}  // namespace

std::string stem_of(const LayerInfo& info) {
  return info.file.value_or(info.name);
}

std::string image_member(const std::string& metadata_member, const std::string& image) {
  return (std::filesystem::path(metadata_member).parent_path() / image).string();
}

Result<Loaded<OccupancyLayer>> read_occupancy(ArchiveMembers& members,
                                              const std::string& stem,
                                              const std::string& owner,
                                              const ArchiveLimits& limits) {
  const std::string metadata_member = stem + ".yaml";
  const SourceName source = members.source_of(metadata_member);
  HYPERMAP_ASSIGN_OR_RETURN(const std::string yaml,
                            members.take(metadata_member, owner, limits.max_text_bytes));
  HYPERMAP_ASSIGN_OR_RETURN(auto metadata, parse_map_metadata(yaml, source));
  const std::string image = image_member(metadata_member, metadata.value.image);
  HYPERMAP_ASSIGN_OR_RETURN(
      const std::string bytes,
      members.take(image, metadata_member + ": image", limits.zip.max_entry_bytes));
  HYPERMAP_ASSIGN_OR_RETURN(const DecodedImage decoded,
                            decode_image(bytes, members.source_of(image), {}, members.budget()));
  auto grid = grid_from_image(decoded, metadata.value, MapDialect::kHypermap, members.budget());
  if (!grid) return tl::make_unexpected(with_source(std::move(grid).error(), source));
  Loaded<OccupancyLayer> loaded{
      .value = OccupancyLayer(std::move(grid->value), std::move(metadata.value.extra)),
      .findings = std::move(metadata.findings)};
  for (Finding& finding : grid->findings) {
    finding.error = with_source(std::move(finding.error), source);
    loaded.findings.push_back(std::move(finding));
  }
  return loaded;
}

Result<std::vector<OpaqueFile>> write_occupancy(const OccupancyLayer& layer,
                                                const std::string& stem) {
  const std::string image = stem + ".png";
  HYPERMAP_ASSIGN_OR_RETURN(
      MapFiles files, write_scale_map(layer, std::filesystem::path(image).filename().string()));
  return std::vector<OpaqueFile>{{.name = stem + ".yaml", .bytes = std::move(files.yaml)},
                                 {.name = image, .bytes = std::move(files.image)}};
}

Result<Loaded<LayerContent>> read_layer(ArchiveMembers& members,
                                        const LayerEntry& entry,
                                        std::size_t index,
                                        const ArchiveLimits& limits,
                                        const LayerRegistry& types) {
  const std::string owner = "layers[" + std::to_string(index) + "].file";
  HYPERMAP_TRY(members.check(stem_of(entry.info), owner));
  const LayerType* type = types.find(entry.class_name);
  if (type == nullptr) return read_opaque_layer(members, entry, owner, limits);
  if (!entry.info.load_file) return Loaded<LayerContent>{.value = type->empty, .findings = {}};
  MemberFileReader reader(members, {.stem = stem_of(entry.info), .owner = owner}, limits);
  return load_content(*type, reader);
}

Result<Loaded<Layer>> read_extension_layer(ArchiveMembers& members,
                                           const ExtensionEntry& entry,
                                           const std::string& owner,
                                           const ArchiveLimits& limits,
                                           const LayerRegistry& types) {
  HYPERMAP_ASSIGN_OR_RETURN(LayerInfo info, info_of(entry));
  MemberFileReader reader(
      members,
      {.stem = entry.file, .owner = owner, .version = static_cast<int>(entry.version)},
      limits);
  HYPERMAP_ASSIGN_OR_RETURN(auto content, load_content(*types.find(entry.format), reader));
  return Loaded<Layer>{.value = {.info = std::move(info), .content = std::move(content.value)},
                       .findings = std::move(content.findings)};
}

Result<std::vector<OpaqueFile>> write_layer(const Layer& layer) {
  HYPERMAP_TRY(check_nothing_is_lost(layer));
  if (!layer.info.load_file && layer.content.as<OpaqueLayer>() == nullptr)
    return std::vector<OpaqueFile>{};
  MemberFileWriter writer(stem_of(layer.info));
  if (auto saved = layer.content->save(writer); !saved) {
    return tl::make_unexpected(with_source(
        std::move(saved).error(), {.file = {}, .entry = "layer " + printable(layer.info.name)}));
  }
  return std::move(writer).files();
}

ExtensionEntry extension_of(const Layer& layer) {
  ExtensionEntry entry{.format = std::string(class_of(layer)),
                       .version = layer.content->version(),
                       .name = layer.info.name,
                       .frame_id = layer.info.frame_id,
                       .file = stem_of(layer.info)};
  std::vector<ValueTree::Entry> keys;
  for (const auto& [key, flag] : kFlags) {
    if (const auto& set = layer.info.*flag) keys.emplace_back(std::string(key), make_bool(*set));
  }
  append_keys(keys, layer.info.extra);
  if (!keys.empty()) entry.extra = make_map(std::move(keys));
  return entry;
}

}  // namespace hypermap
