// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/map_server.hpp"
#include "hypermap/io/codec/bounded_yaml.hpp"
#include "hypermap/io/codec/value_keys.hpp"
#include "hypermap/io/codec/value_limits.hpp"

#include <algorithm>
#include <array>

namespace hypermap {
namespace {

constexpr std::array<std::string_view, 7> kMapMetadataKeys = {
    "image", "resolution", "origin", "negate", "occupied_thresh", "free_thresh", "mode"};

Result<double> number_at(const YamlNode& root, std::string_view key, double min, double max) {
  HYPERMAP_ASSIGN_OR_RETURN(const YamlNode node, root.at(key));
  return node.as_double(min, max);
}

Result<std::string> image_at(const YamlNode& root) {
  HYPERMAP_ASSIGN_OR_RETURN(const YamlNode node, root.at("image"));
  HYPERMAP_ASSIGN_OR_RETURN(std::string image, node.as_string());
  if (image.empty()) return tl::make_unexpected(node.error("is empty, expected a file name"));
  return image;
}

Result<std::array<double, 3>> origin_at(const YamlNode& root) {
  HYPERMAP_ASSIGN_OR_RETURN(const YamlNode node, root.at("origin"));
  HYPERMAP_ASSIGN_OR_RETURN(const std::vector<double> numbers, node.as_doubles(3));
  const bool is_far = std::any_of(numbers.begin(), numbers.end(), [](double n) {
    return n < -kMaxCoordinate || n > kMaxCoordinate;
  });
  if (is_far) return tl::make_unexpected(node.error("lies beyond 1e6 m"));
  return std::array<double, 3>{numbers[0], numbers[1], numbers[2]};
}

/// ROS writes 0 or 1, others a truth value.
Result<bool> negate_at(const YamlNode& root) {
  HYPERMAP_ASSIGN_OR_RETURN(const YamlNode node, root.at("negate"));
  if (const auto truth = node.as_bool()) return *truth;
  if (const auto number = node.as_int(0, 1)) return *number == 1;
  return tl::make_unexpected(
      node.error("is '" + printable(node.value().text) + "', expected 0, 1, true or false"));
}

Result<MapMode> mode_at(const YamlNode& root) {
  const auto node = root.find("mode");
  if (!node) return MapMode::kTrinary;
  HYPERMAP_ASSIGN_OR_RETURN(const std::string mode, node->as_string());
  if (mode == "trinary") return MapMode::kTrinary;
  if (mode == "scale") return MapMode::kScale;
  if (mode == "raw") return MapMode::kRaw;
  return tl::make_unexpected(
      node->error("is '" + printable(mode) + "', expected trinary, scale or raw"));
}

Result<MapMetadata> parse(const YamlNode& root) {
  MapMetadata metadata;
  HYPERMAP_ASSIGN_OR_RETURN(metadata.image, image_at(root));
  HYPERMAP_ASSIGN_OR_RETURN(metadata.resolution_m, number_at(root, "resolution", 1e-6, 1e3));
  HYPERMAP_ASSIGN_OR_RETURN(metadata.origin, origin_at(root));
  HYPERMAP_ASSIGN_OR_RETURN(metadata.negate, negate_at(root));
  HYPERMAP_ASSIGN_OR_RETURN(metadata.occupied_thresh, number_at(root, "occupied_thresh", 0, 1));
  HYPERMAP_ASSIGN_OR_RETURN(metadata.free_thresh, number_at(root, "free_thresh", 0, 1));
  HYPERMAP_ASSIGN_OR_RETURN(metadata.mode, mode_at(root));
  if (metadata.occupied_thresh < metadata.free_thresh) {
    return tl::make_unexpected(
        root.at("occupied_thresh")->error("is below free_thresh, expected it above"));
  }
  return metadata;
}

}  // namespace

Result<Loaded<MapMetadata>> parse_map_metadata(std::string_view yaml, const SourceName& source) {
  HYPERMAP_ASSIGN_OR_RETURN(const YamlDocument document, parse_yaml(yaml, source));
  const YamlNode root = document.root();
  HYPERMAP_ASSIGN_OR_RETURN(MapMetadata metadata, parse(root));
  metadata.extra = other_keys(document.value, kMapMetadataKeys);
  return Loaded<MapMetadata>{std::move(metadata), root.unknown_keys(kMapMetadataKeys)};
}

}  // namespace hypermap
