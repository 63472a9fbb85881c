// SPDX-License-Identifier: BSD-3-Clause
#include "scene_yaml.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

namespace hypermap {
namespace {

constexpr std::array<std::pair<std::string_view, SurfacePattern>, 8> kPatterns{
    {{"plain", SurfacePattern::kPlain},
     {"wood", SurfacePattern::kWood},
     {"tiles", SurfacePattern::kTiles},
     {"fabric", SurfacePattern::kFabric},
     {"keys", SurfacePattern::kKeys},
     {"screen", SurfacePattern::kScreen},
     {"notes", SurfacePattern::kNotes},
     {"brick", SurfacePattern::kBrick}}};

}  // namespace

Result<void> require_map(const YamlNode& node, std::span<const std::string_view> known) {
  if (!node.is_map()) return refuse(node, "must be a map");
  const std::vector<Finding> unknown = node.unknown_keys(known);
  if (!unknown.empty()) return tl::make_unexpected(unknown.front().error);
  return {};
}

Result<double> read_number(
    const YamlNode& map, std::string_view key, double usual, double min, double max) {
  const auto node = map.find(key);
  if (!node) return usual;
  return node->as_double(min, max);
}

Result<std::string> read_text(const YamlNode& map, std::string_view key) {
  HYPERMAP_ASSIGN_OR_RETURN(const YamlNode node, map.at(key));
  HYPERMAP_ASSIGN_OR_RETURN(std::string text, node.as_string());
  if (text.empty() || text.size() > 256) return refuse(node, "must have 1 to 256 bytes");
  return text;
}

Result<std::vector<YamlNode>> read_list(const YamlNode& map,
                                        std::string_view key,
                                        std::size_t limit) {
  const auto node = map.find(key);
  if (!node) return std::vector<YamlNode>{};
  HYPERMAP_ASSIGN_OR_RETURN(std::vector<YamlNode> items, node->as_list());
  if (items.size() > limit)
    return refuse(*node,
                  "must have " + std::to_string(limit) + " items or fewer, has " +
                      std::to_string(items.size()),
                  ErrorCode::kLimit);
  return items;
}

Result<Rgb8> read_color(const YamlNode& node) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::vector<YamlNode> items, node.as_list());
  if (items.size() != 3) return refuse(node, "must be [red, green, blue]");
  std::array<std::uint8_t, 3> channels{};
  for (std::size_t i = 0; i < 3; ++i) {
    HYPERMAP_ASSIGN_OR_RETURN(const std::int64_t value, items[i].as_int(0, 255));
    channels[i] = static_cast<std::uint8_t>(value);
  }
  return Rgb8{channels[0], channels[1], channels[2]};
}

Result<SurfaceMaterial> read_surface(const YamlNode& map, SurfaceMaterial usual) {
  if (const auto color = map.find("color")) {
    HYPERMAP_ASSIGN_OR_RETURN(usual.color, read_color(*color));
  }
  const auto pattern = map.find("pattern");
  if (!pattern) return usual;
  HYPERMAP_ASSIGN_OR_RETURN(const std::string name, pattern->as_string());
  const auto found = std::ranges::find(kPatterns, name, &decltype(kPatterns)::value_type::first);
  if (found == kPatterns.end())
    return refuse(
        *pattern,
        "must be plain, wood, tiles, fabric, keys, screen, notes or brick, is " + printable(name));
  usual.pattern = found->second;
  return usual;
}

Result<Ring> read_ring(const YamlNode& node) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::vector<YamlNode> items, node.as_list());
  if (items.size() > kMaxSceneObjects)
    return refuse(node, "must have 1000 points or fewer", ErrorCode::kLimit);
  Ring ring;
  for (const YamlNode& item : items) {
    HYPERMAP_ASSIGN_OR_RETURN(const Eigen::Vector2d point, read_vector<2>(item));
    ring.push_back(point);
  }
  return ring;
}

}  // namespace hypermap
