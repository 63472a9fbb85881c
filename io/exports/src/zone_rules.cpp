// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/io/codec/bounded_yaml.hpp"
#include "hypermap/io/exports/zone_masks.hpp"

#include <array>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

constexpr std::array<std::string_view, 2> kZoneFileKeys{"robot_height_m", "zones"};
constexpr std::array<std::string_view, 3> kZoneKeys{"keepout_m", "speed_percent", "speed_radius_m"};
constexpr double kMaxZoneM = 100.0;

Result<std::optional<SpeedZone>> parse_speed(const YamlNode& node) {
  const auto percent = node.find("speed_percent");
  const auto radius = node.find("speed_radius_m");
  if (!percent && !radius) return std::optional<SpeedZone>();
  if (!percent || !radius) {
    return Unexpected(node.error("speed_percent and speed_radius_m go together"));
  }
  SpeedZone zone;
  HYPERMAP_ASSIGN_OR_RETURN(const auto value, percent->as_int(1, 100));
  zone.percent = static_cast<int>(value);
  HYPERMAP_ASSIGN_OR_RETURN(zone.radius_m, radius->as_double(0.0, kMaxZoneM));
  return std::optional(zone);
}

Result<ZoneRule> parse_rule(const YamlNode& node) {
  HYPERMAP_TRY(node.refuse_other_keys(kZoneKeys));
  ZoneRule rule;
  if (const auto keepout = node.find("keepout_m")) {
    HYPERMAP_ASSIGN_OR_RETURN(rule.keepout_m, keepout->as_double(0.0, kMaxZoneM));
  }
  HYPERMAP_ASSIGN_OR_RETURN(rule.speed, parse_speed(node));
  if (rule == ZoneRule{}) return Unexpected(node.error("says neither keepout_m nor a speed"));
  return rule;
}

}  // namespace

Result<ZoneRules> read_zone_rules(const std::filesystem::path& path) {
  HYPERMAP_ASSIGN_OR_RETURN(const YamlDocument document, read_yaml(path));
  const YamlNode root = document.root();
  HYPERMAP_TRY(root.refuse_other_keys(kZoneFileKeys));
  ZoneRules rules;
  if (const auto height = root.find("robot_height_m")) {
    HYPERMAP_ASSIGN_OR_RETURN(rules.robot_height_m, height->as_double(0.0, kMaxZoneM));
  }
  HYPERMAP_ASSIGN_OR_RETURN(const YamlNode zones, root.at("zones"));
  HYPERMAP_ASSIGN_OR_RETURN(const auto entries, zones.as_map());
  for (const auto& [name, node] : entries) {
    HYPERMAP_ASSIGN_OR_RETURN(const ZoneRule rule, parse_rule(node));
    if (!rules.of_class.emplace(canonical_class_name(name), rule).second) {
      return Unexpected(node.error("stands there in another spelling already"));
    }
  }
  return rules;
}

std::optional<ZoneRule> zone_rule_of(std::string_view name,
                                     const ZoneRules& rules,
                                     const ClassVocabulary& vocabulary) {
  std::vector<std::string> candidates{canonical_class_name(name)};
  const auto add_names_of = [&](const std::string& class_name) {
    candidates.push_back(class_name);
    const std::vector<std::string> names = vocabulary.same_names(class_name);
    candidates.insert(candidates.end(), names.begin(), names.end());
  };
  add_names_of(vocabulary.class_of(name));
  for (const std::string& above : vocabulary.super_classes_of(name)) add_names_of(above);
  for (const std::string& candidate : candidates) {
    const auto rule = rules.of_class.find(candidate);
    if (rule != rules.of_class.end()) return rule->second;
  }
  return std::nullopt;
}

}  // namespace hypermap
