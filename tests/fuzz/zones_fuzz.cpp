// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz_target.hpp"
#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/io/exports/zone_masks.hpp"
#include "targets.hpp"

namespace hypermap::fuzz {

void fuzz_zones(std::string_view bytes) {
  const auto rules = read_zone_rules(file_of(bytes, "zones.yaml"));
  if (!rules) return;
  require(rules->robot_height_m >= 0.0, "no height is negative");
  for (const auto& [name, rule] : rules->of_class) {
    require(canonical_class_name(name) == name, "names are canonical");
    require(rule.keepout_m || rule.speed, "a rule says something");
    require(!rule.keepout_m || (*rule.keepout_m >= 0.0 && *rule.keepout_m <= 100.0),
            "a distance is in its range");
    require(!rule.speed || (rule.speed->percent >= 1 && rule.speed->percent <= 100),
            "a speed is in its range");
    require(zone_rule_of(name, *rules, {}) == rule, "a rule is found by its name");
  }
}

}  // namespace hypermap::fuzz
