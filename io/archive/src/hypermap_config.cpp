// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/hypermap_config.hpp"

#include "hypermap/io/codec/bounded_yaml.hpp"
#include "hypermap/io/codec/value_keys.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <set>
#include <utility>

namespace hypermap {
namespace {

using Keys = std::span<const std::string_view>;

constexpr std::array<std::string_view, 4> kRootKeys{
    "layers", "transforms", "format_version", "extensions"};
constexpr std::array<std::string_view, 8> kLayerKeys{"class",
                                                     "name",
                                                     "frame_id",
                                                     "load_file",
                                                     "file",
                                                     "subscribe_mode",
                                                     "enable_update",
                                                     "publish_global_topics"};
constexpr std::array<std::string_view, 3> kTransformKeys{
    "frame_id", "child_frame_id", "transform_pose"};
constexpr std::array<std::string_view, 5> kExtensionKeys{
    "format", "version", "name", "frame_id", "file"};
constexpr std::array kLayerFormats{kOctomapFormat,
                                   kOctreeTwinFormat,
                                   kObjectsFormat,
                                   kClassesFormat,
                                   kDetectorsFormat,
                                   kVocabularyFormat,
                                   kClassGridFormat,
                                   kProvenanceFormat,
                                   kCheckpointFormat,
                                   kEmbeddingsFormat,
                                   kViewsFormat,
                                   kTopologicalMapFormat,
                                   kTrueSurfacesFormat};
constexpr std::int64_t kExtensionVersion = 1;
constexpr std::size_t kMaxExtensions = 1024;
constexpr std::size_t kMaxFieldBytes = 256;

Result<std::string> text_at(const YamlNode& map, std::string_view key) {
  HYPERMAP_ASSIGN_OR_RETURN(const YamlNode node, map.at(key));
  HYPERMAP_ASSIGN_OR_RETURN(std::string text, node.as_string());
  if (text.empty() || text.size() > kMaxFieldBytes)
    return tl::make_unexpected(node.error("has " + std::to_string(text.size()) +
                                          " bytes, expected 1 to " +
                                          std::to_string(kMaxFieldBytes)));
  return text;
}

Result<std::optional<bool>> flag_at(const YamlNode& map, std::string_view key) {
  const auto node = map.find(key);
  if (!node) return std::optional<bool>();
  HYPERMAP_ASSIGN_OR_RETURN(const bool flag, node->as_bool());
  return std::optional<bool>(flag);
}

Result<std::int64_t> version_at(const YamlNode& map, std::string_view key, std::int64_t newest) {
  HYPERMAP_ASSIGN_OR_RETURN(const YamlNode node, map.at(key));
  HYPERMAP_ASSIGN_OR_RETURN(const std::int64_t version,
                            node.as_int(1, std::numeric_limits<std::int32_t>::max()));
  if (version > newest)
    return tl::make_unexpected(node.error("written by a newer version " + std::to_string(version) +
                                              ", the newest that is read here is " +
                                              std::to_string(newest),
                                          ErrorCode::kUnsupported));
  return version;
}

/// Reads the configuration's parts and gathers what is noticed on the way.
class ConfigParser {
 public:
  explicit ConfigParser(const LayerRegistry& layers) : layers_(layers) {}

  Result<Loaded<HypermapConfig>> parse(const YamlNode& root) {
    HYPERMAP_TRY(root.as_map());
    HYPERMAP_TRY(take_format_version(root));
    HYPERMAP_TRY(take_list(root, "layers", true, Hypermap::kMaxLayers, &ConfigParser::take_layer));
    HYPERMAP_TRY(
        take_list(root, "transforms", false, Hypermap::kMaxLayers, &ConfigParser::take_transform));
    HYPERMAP_TRY(
        take_list(root, "extensions", false, kMaxExtensions, &ConfigParser::take_extension));
    config_.extra = others(root, kRootKeys);
    return Loaded<HypermapConfig>{.value = std::move(config_), .findings = std::move(findings_)};
  }

 private:
  Result<void> take_format_version(const YamlNode& root) {
    if (!root.find("format_version")) return {};
    HYPERMAP_ASSIGN_OR_RETURN(config_.format_version,
                              version_at(root, "format_version", kArchiveFormatVersion));
    return {};
  }

  Result<void> take_list(const YamlNode& root,
                         std::string_view key,
                         bool required,
                         std::size_t limit,
                         Result<void> (ConfigParser::*take)(const YamlNode&)) {
    if (!required && !root.find(key)) return {};
    HYPERMAP_ASSIGN_OR_RETURN(const YamlNode list, root.at(key));
    HYPERMAP_ASSIGN_OR_RETURN(const std::vector<YamlNode> items, list.as_list());
    if (items.size() > limit)
      return tl::make_unexpected(list.error(
          std::to_string(items.size()) + " entries, the limit is " + std::to_string(limit),
          ErrorCode::kLimit));
    for (const YamlNode& item : items) {
      HYPERMAP_TRY(item.as_map());
      HYPERMAP_TRY((this->*take)(item));
    }
    return {};
  }

  Result<void> take_layer(const YamlNode& node) {
    LayerEntry layer;
    HYPERMAP_ASSIGN_OR_RETURN(layer.class_name, text_at(node, "class"));
    HYPERMAP_ASSIGN_OR_RETURN(layer.info.name, unique_name(node, layer_names_));
    HYPERMAP_ASSIGN_OR_RETURN(layer.info.frame_id, text_at(node, "frame_id"));
    HYPERMAP_ASSIGN_OR_RETURN(const YamlNode load_file, node.at("load_file"));
    HYPERMAP_ASSIGN_OR_RETURN(layer.info.load_file, load_file.as_bool());
    if (node.find("file")) {
      HYPERMAP_ASSIGN_OR_RETURN(layer.info.file, text_at(node, "file"));
    }
    HYPERMAP_ASSIGN_OR_RETURN(layer.info.subscribe_mode, flag_at(node, "subscribe_mode"));
    HYPERMAP_ASSIGN_OR_RETURN(layer.info.enable_update, flag_at(node, "enable_update"));
    HYPERMAP_ASSIGN_OR_RETURN(layer.info.publish_global_topics,
                              flag_at(node, "publish_global_topics"));
    layer.info.extra = others(node, kLayerKeys);
    config_.layers.push_back(std::move(layer));
    return {};
  }

  Result<void> take_transform(const YamlNode& node) {
    FrameTransform transform;
    HYPERMAP_ASSIGN_OR_RETURN(transform.frame_id, text_at(node, "frame_id"));
    HYPERMAP_ASSIGN_OR_RETURN(transform.child_frame_id, text_at(node, "child_frame_id"));
    HYPERMAP_ASSIGN_OR_RETURN(const YamlNode pose, node.at("transform_pose"));
    HYPERMAP_ASSIGN_OR_RETURN(const std::vector<double> numbers, pose.as_doubles(3));
    transform.x_m = numbers[0];
    transform.y_m = numbers[1];
    transform.yaw_rad = numbers[2];
    transform.extra = others(node, kTransformKeys);
    if (auto added = config_.frames.add(std::move(transform)); !added)
      return tl::make_unexpected(node.error(added.error().what));
    return {};
  }

  Result<void> take_extension(const YamlNode& node) {
    HYPERMAP_ASSIGN_OR_RETURN(const std::string format, text_at(node, "format"));
    const std::int64_t newest = newest_version(format);
    if (newest == 0) {
      findings_.push_back({.error = node.error("unknown format '" + printable(format, 40) +
                                               "' is kept as it is, unread")});
      config_.foreign_extensions.push_back(node.value());
      return {};
    }
    ExtensionEntry extension{.format = format};
    HYPERMAP_ASSIGN_OR_RETURN(extension.version, version_at(node, "version", newest));
    HYPERMAP_ASSIGN_OR_RETURN(extension.name, unique_name(node, extension_names_));
    HYPERMAP_ASSIGN_OR_RETURN(extension.frame_id, text_at(node, "frame_id"));
    HYPERMAP_ASSIGN_OR_RETURN(extension.file, text_at(node, "file"));
    extension.extra = other_keys(node.value(), kExtensionKeys);
    config_.extensions.push_back(std::move(extension));
    return {};
  }

  /// Of an extension that is read here; 0 for a format that is not.
  [[nodiscard]] std::int64_t newest_version(std::string_view format) const {
    if (std::find(kLayerFormats.begin(), kLayerFormats.end(), format) != kLayerFormats.end())
      return kExtensionVersion;
    const LayerType* type = is_strict_class(format) ? nullptr : layers_.find(format);
    return type == nullptr ? 0 : type->empty->version();
  }

  static Result<std::string> unique_name(const YamlNode& map, std::set<std::string>& taken) {
    HYPERMAP_ASSIGN_OR_RETURN(std::string name, text_at(map, "name"));
    const YamlNode node = *map.find("name");
    if (const auto valid = validate_layer_name(name); !valid)
      return tl::make_unexpected(node.error(valid.error().what));
    if (!taken.insert(name).second)
      return tl::make_unexpected(node.error("is '" + printable(name) + "', which is there twice"));
    return name;
  }

  ValueTree others(const YamlNode& map, Keys known) {
    for (Finding& finding : map.unknown_keys(known)) findings_.push_back(std::move(finding));
    return other_keys(map.value(), known);
  }

  const LayerRegistry& layers_;
  HypermapConfig config_;
  std::vector<Finding> findings_;
  std::set<std::string> layer_names_;
  std::set<std::string> extension_names_;
};

ValueTree tree_of(const LayerEntry& layer) {
  const LayerInfo& info = layer.info;
  std::vector<ValueTree::Entry> entries{{"class", make_text(layer.class_name)},
                                        {"name", make_text(info.name)},
                                        {"frame_id", make_text(info.frame_id)},
                                        {"load_file", make_bool(info.load_file)}};
  const auto put_flag = [&entries](const char* key, const std::optional<bool>& flag) {
    if (flag) entries.emplace_back(key, make_bool(*flag));
  };
  if (info.file) entries.emplace_back("file", make_text(*info.file));
  put_flag("subscribe_mode", info.subscribe_mode);
  put_flag("enable_update", info.enable_update);
  put_flag("publish_global_topics", info.publish_global_topics);
  append_keys(entries, info.extra);
  return make_map(std::move(entries));
}

ValueTree tree_of(const FrameTransform& transform) {
  std::vector<ValueTree::Entry> entries{{"frame_id", make_text(transform.frame_id)},
                                        {"child_frame_id", make_text(transform.child_frame_id)},
                                        {"transform_pose",
                                         make_list({make_number(transform.x_m),
                                                    make_number(transform.y_m),
                                                    make_number(transform.yaw_rad)})}};
  append_keys(entries, transform.extra);
  return make_map(std::move(entries));
}

ValueTree tree_of(const ExtensionEntry& extension) {
  std::vector<ValueTree::Entry> entries{
      {"format", make_text(extension.format)},
      {"version", make_number(static_cast<double>(extension.version))},
      {"name", make_text(extension.name)},
      {"frame_id", make_text(extension.frame_id)},
      {"file", make_text(extension.file)}};
  append_keys(entries, extension.extra);
  return make_map(std::move(entries));
}

template <class Items>
ValueTree list_of(const Items& items) {
  std::vector<ValueTree> trees;
  trees.reserve(items.size());
  for (const auto& item : items) trees.push_back(tree_of(item));
  return make_list(std::move(trees));
}

}  // namespace

Result<Loaded<HypermapConfig>> parse_hypermap_config(std::string_view bytes,
                                                     const SourceName& source,
                                                     const LayerRegistry& layers) {
  HYPERMAP_ASSIGN_OR_RETURN(const YamlDocument document, parse_yaml(bytes, source));
  return ConfigParser(layers).parse(document.root());
}

std::string write_hypermap_config(const HypermapConfig& config) {
  std::vector<ValueTree::Entry> entries{{"layers", list_of(config.layers)}};
  if (!config.frames.transforms().empty())
    entries.emplace_back("transforms", list_of(config.frames.transforms()));
  ValueTree extensions = list_of(config.extensions);
  for (const ValueTree& foreign : config.foreign_extensions) extensions.items.push_back(foreign);
  if (!extensions.items.empty()) {
    entries.emplace_back("format_version", make_number(static_cast<double>(kArchiveFormatVersion)));
    entries.emplace_back("extensions", std::move(extensions));
  }
  append_keys(entries, config.extra);
  return write_yaml(make_map(std::move(entries)));
}

}  // namespace hypermap
