// SPDX-License-Identifier: BSD-3-Clause
#include "octree_options_keys.hpp"

#include "hypermap/io/codec/bounded_yaml.hpp"
#include "hypermap/io/codec/value_keys.hpp"

#include <array>
#include <string_view>
#include <utility>

namespace hypermap {
namespace {

constexpr std::array<std::string_view, 2> kOctreeKeys{"sensor_model", "max_class_log_odds"};

struct ProbabilityKey {
  std::string_view name;
  Probability SensorModelOptions::*field;
};
constexpr std::array kModelKeys{
    ProbabilityKey{"hit", &SensorModelOptions::hit},
    ProbabilityKey{"miss", &SensorModelOptions::miss},
    ProbabilityKey{"clamp_min", &SensorModelOptions::clamp_min},
    ProbabilityKey{"clamp_max", &SensorModelOptions::clamp_max},
    ProbabilityKey{"occupied_from", &SensorModelOptions::occupied_from}};

Result<SensorModelOptions> parse_sensor_model(const YamlNode& node) {
  SensorModelOptions model;
  for (const ProbabilityKey& key : kModelKeys) {
    HYPERMAP_ASSIGN_OR_RETURN(const YamlNode value, node.at(key.name));
    HYPERMAP_ASSIGN_OR_RETURN(const double p, value.as_double(0.0, 1.0));
    model.*key.field = Probability(p);
  }
  return model;
}

}  // namespace

Result<OctreeOptions> octree_options(const ValueTree& extra) {
  const SourceName unnamed;
  const YamlNode root(extra, "", unnamed);
  OctreeOptions options;
  if (const auto model = root.find("sensor_model")) {
    HYPERMAP_ASSIGN_OR_RETURN(options.sensor_model, parse_sensor_model(*model));
  }
  if (const auto limit = root.find("max_class_log_odds")) {
    HYPERMAP_ASSIGN_OR_RETURN(const double value, limit->as_double());
    options.max_class_log_odds = LogOdds(value);
  }
  if (const auto valid = validate(options); !valid)
    return fail(ErrorCode::kMalformedFile, valid.error().what, valid.error().field);
  return options;
}

std::vector<ValueTree::Entry> octree_option_keys(const OctreeOptions& options) {
  std::vector<ValueTree::Entry> model;
  model.reserve(kModelKeys.size());
  for (const ProbabilityKey& key : kModelKeys)
    model.emplace_back(key.name, make_number((options.sensor_model.*key.field).value()));
  return {{"sensor_model", make_map(std::move(model))},
          {"max_class_log_odds", make_number(options.max_class_log_odds.value())}};
}

ValueTree without_octree_options(const ValueTree& extra) {
  return other_keys(extra, kOctreeKeys);
}

}  // namespace hypermap
