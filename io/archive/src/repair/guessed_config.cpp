// SPDX-License-Identifier: BSD-3-Clause
#include "guessed_config.hpp"

#include "extension_entries.hpp"
#include "hypermap/io/codec/bounded_yaml.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

namespace hypermap {
namespace {

constexpr std::string_view kGridStem = "class_grid_";

constexpr std::array kSingleFormats{kOctomapFormat,
                                    kOctreeTwinFormat,
                                    kObjectsFormat,
                                    kEmbeddingsFormat,
                                    kViewsFormat,
                                    kTopologicalMapFormat,
                                    kClassesFormat,
                                    kDetectorsFormat,
                                    kVocabularyFormat,
                                    kProvenanceFormat,
                                    kCheckpointFormat,
                                    kTrueSurfacesFormat};

bool is_of_our_names(std::string_view name) {
  return std::ranges::any_of(
      kSingleFormats, [&](std::string_view format) { return new_entry(format).file == name; });
}

/// A layer of the strict form, as far as its text tells; none of another member.
std::optional<LayerEntry> layer_of(const std::string& name, const std::string& bytes) {
  constexpr std::string_view kYaml = ".yaml";
  const SourceName unnamed;
  const auto document = parse_yaml(bytes, unnamed);
  if (!document || name.starts_with(kGridStem)) return std::nullopt;
  const YamlNode root = document->root();
  const std::string stem =
      name.ends_with(kYaml) ? name.substr(0, name.size() - kYaml.size()) : name;
  LayerEntry entry{.class_name = "OccupancyGridLayer", .info = {.name = stem}};
  if (root.find("resolution") && name.ends_with(kYaml)) return entry;
  const auto items = root.as_list();
  const bool has_shapes =
      items && !items->empty() && items->front().find("shape") && items->front().find("name");
  if (!has_shapes) return std::nullopt;
  entry.class_name = "SemanticLayer";
  if (stem != name) entry.info.file = name;
  return entry;
}

/// Names of layers are file names; what lies in a folder is called by its last part.
void add_layer(HypermapConfig& config, LayerEntry entry) {
  std::string name = entry.info.name.substr(entry.info.name.rfind('/') + 1);
  if (name != entry.info.name && !entry.info.file) entry.info.file = entry.info.name;
  const auto is_taken = [&](const std::string& asked) {
    return std::ranges::any_of(config.layers,
                               [&](const LayerEntry& other) { return other.info.name == asked; });
  };
  std::string free_name = name;
  for (int i = 2; is_taken(free_name); ++i) free_name = name + "_" + std::to_string(i);
  if (free_name != entry.info.name && !entry.info.file) entry.info.file = entry.info.name;
  entry.info.name = std::move(free_name);
  config.layers.push_back(std::move(entry));
}

}  // namespace

std::span<const std::string_view> single_formats() {
  return kSingleFormats;
}

HypermapConfig guess_config(const SalvagedContents& members) {
  HypermapConfig config{.format_version = kArchiveFormatVersion};
  for (const std::string_view format : kSingleFormats) {
    ExtensionEntry entry = new_entry(format);
    if (members.contains(entry.file)) config.extensions.push_back(std::move(entry));
  }
  for (const auto& [name, bytes] : members) {
    if (is_of_our_names(name) || name == kConfigName) continue;
    if (name.ends_with(".ot") || name.ends_with(".bt")) {
      const std::string stem = name.substr(0, name.size() - 3);
      config.extensions.push_back({.format = std::string(kOctomapFormat),
                                   .name = stem.substr(stem.rfind('/') + 1),
                                   .file = name});
    } else if (auto layer = layer_of(name, bytes)) {
      add_layer(config, std::move(*layer));
    }
  }
  return config;
}

}  // namespace hypermap
