// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/places/place_prior.hpp"

#include "hypermap/core/base/option_rows.hpp"
#include "hypermap/core/completion/completion.hpp"
#include "hypermap/core/objects/object_outline.hpp"
#include "hypermap/core/places/object_vertices.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

namespace hypermap {
namespace {

constexpr std::string_view kPriorKindNames[] = {"none", "places"};

constexpr OptionRow kPlacePriorRows[] = {
    option::choice<&PlacePriorOptions::source>(
        "source",
        kPriorKindNames,
        {.source = "[smap] (3.17)",
         .effect =
             "Outside knowledge of classes: none, or what belongs where and how large it is."}),
    option::number<&PlacePriorOptions::max_factor>(
        "max_factor",
        {1, 1000},
        {.effect = "By what a class is less probable where it does not belong, at most."}),
    option::number<&PlacePriorOptions::max_size_factor>(
        "max_size_factor",
        {1, 1000},
        {.effect = "By what a class is less probable whose things have another size, at most."}),
    option::count<&PlacePriorOptions::num_layers>(
        "num_layers",
        {0, 100},
        {.source = "[smap] 3.5.4",
         .effect = "Objects at vertices so many edges away tell the place."}),
    option::number<&PlacePriorOptions::min_real>(
        "min_real", {0, 1}, {.effect = "Less real objects tell nothing of the place."}),
};

/// Smaller logarithms of a factor are the rounding of numbers that are equal.
constexpr double kLeastLogFactor = 1e-9;

/// Whether what was observed may be this object.
bool may_be(const Observation& observation, const Object& object) {
  return object.box.contains(observation.segment.centroid_in_map) ||
         observation.segment.box.contains(object.centroid_in_map);
}

/// Boxes of one object share so much of their union; what stands in or under another does not.
constexpr double kLeastOverlap = 0.2;

/// The object that the observation is of, as far as boxes tell; null where there is none.
const Object* observed_object(const Observation& observation, const ObjectMap& objects) {
  const Object* best = nullptr;
  double best_overlap = kLeastOverlap;
  for (const ObjectId id : objects.query(observation.segment.box)) {
    const Object& object = objects.at(id);
    const double overlap = intersection_over_union(observation.segment.box, object.box);
    if (overlap <= best_overlap) continue;
    best = &object;
    best_overlap = overlap;
  }
  return best;
}

/// As many objects of each class as there are to be expected.
std::map<ClassId, double> expected_classes(const Observation& observation,
                                           const ObjectMap& objects,
                                           std::span<const ObjectId> around,
                                           double min_real) {
  std::map<ClassId, double> amounts;
  for (const ObjectId id : around) {
    const Object& object = objects.at(id);
    const double real = real_probability(object).value();
    if (real < min_real || may_be(observation, object)) continue;
    for (const ClassEvidence& one : detected_distribution(object)) {
      amounts[one.id] += real * one.probability.value();
    }
  }
  return amounts;
}

ClassAmounts by_name(const std::map<ClassId, double>& amounts, const ClassRegistry& classes) {
  ClassAmounts named;
  for (const auto& [id, amount] : amounts) {
    if (classes.contains(id)) named[canonical_class_name(classes.name(id))] += amount;
  }
  return named;
}

}  // namespace

const OptionTable& option_table(const PlacePriorOptions&) {
  static constexpr OptionTable kTable{kPlacePriorRows};
  return kTable;
}

Result<void> validate(const PlacePriorOptions& options) {
  return check_options(options);
}

double belonging_factor(const PlaceRules& rules,
                        std::string_view canonical_class,
                        const PlaceBelief& place) {
  const auto belongs = rules.belongings.find(canonical_class);
  if (belongs == rules.belongings.end() || place.empty()) return 1.0;
  double here = 0.0;
  double anywhere = 0.0;
  for (const auto& [name, probability] : place) {
    const auto weight = belongs->second.find(name);
    const double times = weight == belongs->second.end() ? 1.0 : weight->second;
    here += probability * times;
    anywhere += times / static_cast<double>(place.size());
  }
  return here / anywhere;
}

Result<PlacePrior> PlacePrior::create(PlaceRules rules, const PlacePriorOptions& options) {
  HYPERMAP_TRY(validate(options));
  HYPERMAP_ASSIGN_OR_RETURN(auto classifier, BelongingsClassifier::create(std::move(rules)));
  return PlacePrior(std::move(classifier), options);
}

ClassPrior PlacePrior::prior_of(const Observation& observation,
                                const ObjectMap& objects,
                                const TopologicalMap& places,
                                const ClassRegistry& classes) const {
  LogFactors sums = of_place(observation, objects, places, classes);
  for (const auto& [id, log_factor] : of_size(observation, objects, classes)) {
    sums[id] += log_factor;
  }
  std::vector<ClassLogOdds> log_factors;
  log_factors.reserve(sums.size());
  for (const auto& [id, log_factor] : sums) log_factors.push_back({id, LogOdds(log_factor)});
  return ClassPrior::create(std::move(log_factors)).value_or(ClassPrior{});
}

PlacePrior::LogFactors PlacePrior::of_place(const Observation& observation,
                                            const ObjectMap& objects,
                                            const TopologicalMap& places,
                                            const ClassRegistry& classes) const {
  const auto vertex = places.nearest(observation.segment.centroid_in_map);
  if (!vertex) return {};
  const auto around = objects_near(places, objects, *vertex, options_.num_layers);
  const auto amounts = expected_classes(observation, objects, around, options_.min_real);
  const PlaceBelief place = classifier_.classify(by_name(amounts, classes));
  const double most = std::log(options_.max_factor);
  LogFactors log_factors;
  for (const auto& [name, weights] : classifier_.rules().belongings) {
    const auto id = classes.find(name);
    if (!id) continue;
    const double log_factor = std::log(belonging_factor(classifier_.rules(), name, place));
    // What is at home here is no likelier for that than others.
    if (log_factor > -kLeastLogFactor) continue;
    log_factors.emplace(*id, std::max(log_factor, -most));
  }
  return log_factors;
}

PlacePrior::LogFactors PlacePrior::of_size(const Observation& observation,
                                           const ObjectMap& objects,
                                           const ClassRegistry& classes) const {
  const ClassSizes& sizes = classifier_.rules().sizes;
  const Object* object = sizes.empty() ? nullptr : observed_object(observation, objects);
  if (object == nullptr) return {};
  const Eigen::Vector3d extent_m = turned_box_of(*object).extent();
  const bool is_seen_whole = seen_share(*object) >= kWholeSeenShare;
  const double most = std::log(options_.max_size_factor);
  LogFactors log_factors;
  for (const auto& [name, size] : sizes) {
    const auto id = classes.find(name);
    if (!id) continue;
    const double log_factor = size_log_factor(size, extent_m, is_seen_whole);
    if (log_factor < -kLeastLogFactor) log_factors.emplace(*id, std::max(log_factor, -most));
  }
  return log_factors;
}

}  // namespace hypermap
