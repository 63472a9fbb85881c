// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/options/place_rules_file.hpp"

#include "hypermap/io/codec/bounded_yaml.hpp"

#include <array>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>

namespace hypermap {
namespace {

constexpr std::array<std::string_view, 5> kPlaceKeys{
    "belongings", "metre_costs", "min_probability", "sizes", "tempering"};
constexpr std::array<std::string_view, 3> kLengthKeys{"longer", "shorter", "height"};

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

/// None where the class has no such length.
Result<std::optional<LengthRange>> read_length(const YamlNode& size, std::string_view length) {
  const auto node = size.find(length);
  if (!node) return std::optional<LengthRange>();
  HYPERMAP_ASSIGN_OR_RETURN(const auto numbers, node->as_doubles(2));
  return std::optional(LengthRange{.least_m = numbers[0], .most_m = numbers[1]});
}

Result<ClassSizes> read_sizes(const YamlNode& node) {
  ClassSizes sizes;
  HYPERMAP_ASSIGN_OR_RETURN(const auto entries, node.as_map());
  for (const auto& [name, lengths] : entries) {
    HYPERMAP_TRY(lengths.refuse_other_keys(kLengthKeys));
    ClassSize size;
    HYPERMAP_ASSIGN_OR_RETURN(size.longer, read_length(lengths, "longer"));
    HYPERMAP_ASSIGN_OR_RETURN(size.shorter, read_length(lengths, "shorter"));
    HYPERMAP_ASSIGN_OR_RETURN(size.height, read_length(lengths, "height"));
    if (!sizes.emplace(canonical_class_name(name), size).second) {
      return Unexpected(lengths.error("stands there in another spelling already"));
    }
  }
  return sizes;
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

/// Of the entries below a field, by the names that `validate` has for them.
Result<Lines> lines_below(const YamlNode& node, const std::string& field) {
  Lines lines;
  HYPERMAP_ASSIGN_OR_RETURN(const auto entries, node.as_map());
  for (const auto& [place, value] : entries)
    lines.emplace(std::string(field).append(".").append(place), value.line());
  return lines;
}

/// By the names that `validate` has for them.
Result<Lines> lines_of_sizes(const YamlNode& node) {
  Lines lines;
  HYPERMAP_ASSIGN_OR_RETURN(const auto entries, node.as_map());
  for (const auto& [name, lengths] : entries) {
    const std::string field = "sizes." + printable(canonical_class_name(name));
    lines.emplace(field, lengths.line());
    HYPERMAP_ASSIGN_OR_RETURN(Lines of_class, lines_below(lengths, field));
    lines.merge(of_class);
  }
  return lines;
}

/// Of all numbers of the file.
Result<Lines> lines_of_numbers(const YamlNode& root) {
  Lines lines;
  for (const char* field : {"tempering", "min_probability"}) {
    if (const auto number = root.find(field)) lines.emplace(field, number->line());
  }
  if (const auto costs = root.find("metre_costs")) {
    HYPERMAP_ASSIGN_OR_RETURN(Lines of_costs, lines_below(*costs, "metre_costs"));
    lines.merge(of_costs);
  }
  if (const auto sizes = root.find("sizes")) {
    HYPERMAP_ASSIGN_OR_RETURN(Lines of_sizes, lines_of_sizes(*sizes));
    lines.merge(of_sizes);
  }
  HYPERMAP_ASSIGN_OR_RETURN(const YamlNode belongings, root.at("belongings"));
  HYPERMAP_ASSIGN_OR_RETURN(const auto classes, belongings.as_map());
  for (const auto& [name, places] : classes) {
    const std::string field = "belongings." + printable(canonical_class_name(name));
    HYPERMAP_ASSIGN_OR_RETURN(Lines of_class, lines_below(places, field));
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
  if (const auto sizes = root.find("sizes")) {
    HYPERMAP_ASSIGN_OR_RETURN(rules.sizes, read_sizes(*sizes));
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
