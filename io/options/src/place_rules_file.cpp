// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/options/place_rules_file.hpp"

#include "hypermap/io/codec/bounded_yaml.hpp"

#include <array>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>

namespace hypermap {
namespace {

constexpr std::array<std::string_view, 4> kPlaceKeys{
    "belongings", "metre_costs", "min_probability", "tempering"};

/// Numbers by place; ranges are those of `validate`.
template <class Numbers>
Result<Numbers> numbers_by_place(const YamlNode& node) {
  Numbers numbers;
  HYPERMAP_ASSIGN_OR_RETURN(const auto entries, node.as_map());
  for (const auto& [place, value] : entries) {
    HYPERMAP_ASSIGN_OR_RETURN(numbers[place], value.as_double());
  }
  return numbers;
}

using Weights = std::map<std::string, double>;

Result<decltype(PlaceRules::belongings)> read_belongings(const YamlNode& node) {
  decltype(PlaceRules::belongings) belongings;
  HYPERMAP_ASSIGN_OR_RETURN(const auto entries, node.as_map());
  for (const auto& [name, places] : entries) {
    HYPERMAP_ASSIGN_OR_RETURN(Weights weights, numbers_by_place<Weights>(places));
    if (!belongings.emplace(canonical_class_name(name), std::move(weights)).second) {
      return Unexpected(places.error("stands there in another spelling already"));
    }
  }
  return belongings;
}

std::vector<std::string> all_places(const PlaceRules& rules) {
  std::set<std::string> places;
  for (const auto& [name, weights] : rules.belongings) {
    for (const auto& [place, weight] : weights) places.insert(place);
  }
  for (const auto& [place, cost] : rules.metre_costs) places.insert(place);
  return {places.begin(), places.end()};
}

using Lines = std::map<std::string, int>;

/// By the names that `validate` has for numbers by place.
Result<Lines> lines_by_place(const YamlNode& node, const std::string& field) {
  Lines lines;
  HYPERMAP_ASSIGN_OR_RETURN(const auto entries, node.as_map());
  for (const auto& [place, value] : entries)
    lines.emplace(std::string(field).append(".").append(place), value.line());
  return lines;
}

/// Of all numbers of the file.
Result<Lines> lines_of_numbers(const YamlNode& root) {
  Lines lines;
  for (const char* field : {"tempering", "min_probability"}) {
    if (const auto number = root.find(field)) lines.emplace(field, number->line());
  }
  if (const auto costs = root.find("metre_costs")) {
    HYPERMAP_ASSIGN_OR_RETURN(Lines of_costs, lines_by_place(*costs, "metre_costs"));
    lines.merge(of_costs);
  }
  HYPERMAP_ASSIGN_OR_RETURN(const YamlNode belongings, root.at("belongings"));
  HYPERMAP_ASSIGN_OR_RETURN(const auto classes, belongings.as_map());
  for (const auto& [name, places] : classes) {
    const std::string field = "belongings." + printable(canonical_class_name(name));
    HYPERMAP_ASSIGN_OR_RETURN(Lines of_class, lines_by_place(places, field));
    lines.merge(of_class);
  }
  return lines;
}

}  // namespace

Result<PlaceRules> read_place_rules(const std::filesystem::path& path) {
  HYPERMAP_ASSIGN_OR_RETURN(const YamlDocument document, read_yaml(path));
  const YamlNode root = document.root();
  HYPERMAP_TRY(root.refuse_other_keys(kPlaceKeys));
  PlaceRules rules;
  HYPERMAP_ASSIGN_OR_RETURN(const YamlNode belongings, root.at("belongings"));
  HYPERMAP_ASSIGN_OR_RETURN(rules.belongings, read_belongings(belongings));
  if (const auto costs = root.find("metre_costs")) {
    HYPERMAP_ASSIGN_OR_RETURN(rules.metre_costs,
                              numbers_by_place<decltype(rules.metre_costs)>(*costs));
  }
  if (const auto tempering = root.find("tempering")) {
    HYPERMAP_ASSIGN_OR_RETURN(rules.tempering, tempering->as_double());
  }
  if (const auto least = root.find("min_probability")) {
    HYPERMAP_ASSIGN_OR_RETURN(rules.min_probability, least->as_double());
  }
  rules.places = all_places(rules);
  if (auto ok = validate(rules); !ok) {
    Error error = std::move(ok).error();
    error.code = ErrorCode::kMalformedFile;
    error.file = path.string();
    HYPERMAP_ASSIGN_OR_RETURN(Lines lines, lines_of_numbers(root));
    error.line = lines[error.field];
    return Unexpected(std::move(error));
  }
  return rules;
}

}  // namespace hypermap
