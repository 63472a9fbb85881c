// SPDX-License-Identifier: BSD-3-Clause
#include "layer_files.hpp"

#include "hypermap/io/archive/map_server.hpp"
#include "hypermap/io/archive/semantic_yaml.hpp"
#include "hypermap/io/codec/picture_file.hpp"

#include <filesystem>
#include <iterator>
#include <utility>
#include <variant>

namespace hypermap {
namespace {

void append_findings(std::vector<Finding>& findings, std::vector<Finding> more) {
  std::move(more.begin(), more.end(), std::back_inserter(findings));
}

std::string file_of(const LayerInfo& info) {
  return info.file.value_or(info.name);
}

/// The member that `image:` names: beside its metadata.
std::string picture_member(const std::string& metadata_member, const std::string& image) {
  return (std::filesystem::path(metadata_member).parent_path() / image).string();
}

Result<Loaded<LayerContent>> read_grid(ArchiveMembers& members,
                                       const LayerInfo& info,
                                       const std::string& owner,
                                       const ArchiveLimits& limits) {
  HYPERMAP_ASSIGN_OR_RETURN(auto layer, read_occupancy(members, file_of(info), owner, limits));
  return Loaded<LayerContent>{.value = std::move(layer.value),
                              .findings = std::move(layer.findings)};
}

Result<Loaded<LayerContent>> read_shapes(ArchiveMembers& members,
                                         const LayerInfo& info,
                                         const std::string& owner,
                                         const ArchiveLimits& limits) {
  const std::string file = file_of(info);
  HYPERMAP_ASSIGN_OR_RETURN(const std::string bytes,
                            members.take(file, owner, limits.max_text_bytes));
  HYPERMAP_ASSIGN_OR_RETURN(auto layer, parse_semantic_layer(bytes, members.source_of(file)));
  return Loaded<LayerContent>{.value = std::move(layer.value),
                              .findings = std::move(layer.findings)};
}

/// Keeps the file of a layer that is not understood, if there is one.
Result<Loaded<LayerContent>> read_opaque_layer(ArchiveMembers& members,
                                               const LayerEntry& entry,
                                               const std::string& owner,
                                               const ArchiveLimits& limits) {
  OpaqueLayer layer{.class_name = entry.class_name};
  const std::string file = file_of(entry.info);
  if (entry.info.load_file && members.contains(file)) {
    HYPERMAP_ASSIGN_OR_RETURN(std::string bytes,
                              members.take(file, owner, limits.zip.max_entry_bytes));
    layer.files.push_back({.name = file, .bytes = std::move(bytes)});
  }
  Loaded<LayerContent> loaded{.value = std::move(layer), .findings = {}};
  loaded.findings.push_back(
      {.error = {.code = ErrorCode::kUnsupported,
                 .what = "unknown layer class '" + printable(entry.class_name, 40) +
                         "' is kept as it is, unread",
                 .field = owner}});
  return loaded;
}

/// What an unread layer of a known class starts with.
LayerContent empty_layer(const LayerEntry& entry) {
  if (entry.class_name == kOccupancyLayerClass) return OccupancyLayer{};
  return SemanticLayer();
}

/// A layer that is not to be loaded must have nothing to lose.
Result<std::vector<OpaqueFile>> check_empty(const Layer& layer) {
  const bool empty = layer.content == LayerContent(OccupancyLayer{}) ||
                     layer.content == LayerContent(SemanticLayer());
  if (empty) return std::vector<OpaqueFile>{};
  return fail(ErrorCode::kInvalidArgument,
              "has content, yet load_file is false: it would be lost",
              "layer " + printable(layer.info.name));
}

}  // namespace

Result<Loaded<OccupancyLayer>> read_occupancy(ArchiveMembers& members,
                                              const std::string& stem,
                                              const std::string& owner,
                                              const ArchiveLimits& limits) {
  const std::string metadata_member = stem + ".yaml";
  const SourceName source = members.source_of(metadata_member);
  HYPERMAP_ASSIGN_OR_RETURN(const std::string yaml,
                            members.take(metadata_member, owner, limits.max_text_bytes));
  HYPERMAP_ASSIGN_OR_RETURN(auto metadata, parse_map_metadata(yaml, source));
  const std::string image = picture_member(metadata_member, metadata.value.image);
  HYPERMAP_ASSIGN_OR_RETURN(
      const std::string bytes,
      members.take(image, metadata_member + ": image", limits.zip.max_entry_bytes));
  HYPERMAP_ASSIGN_OR_RETURN(const Picture picture, decode_picture(bytes, members.source_of(image)));
  auto grid = grid_from_picture(picture, metadata.value, MapDialect::kHypermap);
  if (!grid) return tl::make_unexpected(with_source(std::move(grid).error(), source));
  Loaded<OccupancyLayer> loaded{
      .value = {.grid = std::move(grid->value), .extra = std::move(metadata.value.extra)},
      .findings = std::move(metadata.findings)};
  for (Finding& finding : grid->findings)
    finding.error = with_source(std::move(finding.error), source);
  append_findings(loaded.findings, std::move(grid->findings));
  return loaded;
}

Result<std::vector<OpaqueFile>> write_occupancy(const OccupancyLayer& layer,
                                                const std::string& stem) {
  const std::string picture = stem + ".png";
  HYPERMAP_ASSIGN_OR_RETURN(
      MapFiles files, write_scale_map(layer, std::filesystem::path(picture).filename().string()));
  return std::vector<OpaqueFile>{{.name = stem + ".yaml", .bytes = std::move(files.yaml)},
                                 {.name = picture, .bytes = std::move(files.picture)}};
}

Result<Loaded<LayerContent>> read_layer(ArchiveMembers& members,
                                        const LayerEntry& entry,
                                        std::size_t index,
                                        const ArchiveLimits& limits) {
  const std::string owner = "layers[" + std::to_string(index) + "].file";
  const bool known =
      entry.class_name == kOccupancyLayerClass || entry.class_name == kSemanticLayerClass;
  HYPERMAP_TRY(members.check(file_of(entry.info), owner));
  if (!known) return read_opaque_layer(members, entry, owner, limits);
  if (!entry.info.load_file)
    return Loaded<LayerContent>{.value = empty_layer(entry), .findings = {}};
  if (entry.class_name == kOccupancyLayerClass)
    return read_grid(members, entry.info, owner, limits);
  return read_shapes(members, entry.info, owner, limits);
}

Result<std::vector<OpaqueFile>> write_layer(const Layer& layer) {
  if (const auto* opaque = std::get_if<OpaqueLayer>(&layer.content)) return opaque->files;
  if (!layer.info.load_file) return check_empty(layer);
  const std::string file = file_of(layer.info);
  if (const auto* occupancy = std::get_if<OccupancyLayer>(&layer.content))
    return write_occupancy(*occupancy, file);
  return std::vector<OpaqueFile>{
      {.name = file, .bytes = write_semantic_layer(std::get<SemanticLayer>(layer.content))}};
}

}  // namespace hypermap
