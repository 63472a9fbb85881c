// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/places/place_classifier.hpp"

#include "hypermap/core/base/number_text.hpp"

#include <algorithm>
#include <cmath>

namespace hypermap {
namespace {

struct NumberRange {
  double min = 0.0;
  double max = 1.0;
};
constexpr NumberRange kWeights{0.01, 100.0};
constexpr NumberRange kMetreCosts{0.01, 1000.0};
constexpr NumberRange kTempering{0.01, 1.0};
constexpr NumberRange kProbabilities{0.0, 1.0};

Result<void> check_number(const std::string& field, double value, const NumberRange& range) {
  if (value >= range.min && value <= range.max) return {};
  return fail(ErrorCode::kInvalidArgument,
              "must be " + number_text(range.min) + " .. " + number_text(range.max) + ", is " +
                  number_text(value),
              field);
}

/// Of numbers by place, each a place of the rules.
template <class Numbers>
Result<void> check_by_place(const PlaceRules& rules,
                            const std::string& field,
                            const Numbers& numbers,
                            const NumberRange& range) {
  for (const auto& [place, value] : numbers) {
    if (!std::ranges::binary_search(rules.places, place)) {
      return fail(ErrorCode::kInvalidArgument,
                  "names the place \"" + printable(place) + "\", which is none of places",
                  field);
    }
    std::string name = field;
    name.append(".").append(place);
    HYPERMAP_TRY(check_number(name, value, range));
  }
  return {};
}

/// Two names of one place would be two places, each with a share of its probability.
Result<void> refuse_second_spellings(const std::vector<std::string>& places) {
  std::map<std::string, std::string> first_of;
  for (const std::string& place : places) {
    const auto [first, is_new] = first_of.emplace(canonical_class_name(place), place);
    if (is_new) continue;
    return fail(
        ErrorCode::kInvalidArgument,
        "\"" + printable(place) + "\" is another spelling of \"" + printable(first->second) + "\"",
        "places");
  }
  return {};
}

}  // namespace

ClassAmounts class_amounts(std::span<const ObjectBeliefs> objects, const ClassRegistry& classes) {
  ClassAmounts amounts;
  for (const ObjectBeliefs& object : objects) {
    for (const ClassEvidence& evidence : object.classes) {
      amounts[canonical_class_name(classes.name(evidence.id))] +=
          object.real.value() * evidence.probability.value();
    }
  }
  return amounts;
}

Result<void> validate(const PlaceRules& rules) {
  if (rules.places.empty()) {
    return fail(ErrorCode::kInvalidArgument, "none is named: belongings must name some", "places");
  }
  const auto unordered = std::ranges::adjacent_find(rules.places, std::ranges::greater_equal());
  if (unordered != rules.places.end()) {
    return fail(ErrorCode::kInvalidArgument, "must be names in ascending order", "places");
  }
  HYPERMAP_TRY(refuse_second_spellings(rules.places));
  HYPERMAP_TRY(check_number("tempering", rules.tempering, kTempering));
  HYPERMAP_TRY(check_number("min_probability", rules.min_probability, kProbabilities));
  HYPERMAP_TRY(check_by_place(rules, "metre_costs", rules.metre_costs, kMetreCosts));
  for (const auto& [name, weights] : rules.belongings) {
    if (canonical_class_name(name) != name) {
      return fail(ErrorCode::kInvalidArgument,
                  "must be the canonical name \"" + canonical_class_name(name) + "\"",
                  "belongings." + printable(name));
    }
    HYPERMAP_TRY(check_by_place(rules, "belongings." + printable(name), weights, kWeights));
  }
  return validate(rules.sizes);
}

Result<BelongingsClassifier> BelongingsClassifier::create(PlaceRules rules) {
  HYPERMAP_TRY(validate(rules));
  return BelongingsClassifier(std::move(rules));
}

PlaceBelief BelongingsClassifier::classify(const ClassAmounts& objects) const {
  std::map<std::string, double> log_weights;
  for (const std::string& place : rules_.places) log_weights[place] = 0.0;
  for (const auto& [name, amount] : objects) {
    const auto belongs = rules_.belongings.find(name);
    if (belongs == rules_.belongings.end() || !(amount > 0.0)) continue;
    const double exponent = std::pow(amount, rules_.tempering);
    for (const auto& [place, weight] : belongs->second) {
      log_weights[place] += exponent * std::log(weight);
    }
  }
  double largest = log_weights.begin()->second;
  for (const auto& [place, weight] : log_weights) largest = std::max(largest, weight);
  double sum = 0.0;
  for (const auto& [place, weight] : log_weights) sum += std::exp(weight - largest);
  PlaceBelief belief;
  belief.reserve(log_weights.size());
  for (const auto& [place, weight] : log_weights) {
    belief.push_back({place, std::exp(weight - largest) / sum});
  }
  std::ranges::stable_sort(belief, std::ranges::greater(), &PlaceProbability::probability);
  return belief;
}

std::optional<std::string> BelongingsClassifier::decide(const PlaceBelief& belief) const {
  if (belief.empty() || belief.front().probability < rules_.min_probability) return std::nullopt;
  const bool is_tie = belief.size() > 1 && belief[0].probability == belief[1].probability;
  if (is_tie) return std::nullopt;
  return belief.front().place;
}

}  // namespace hypermap
