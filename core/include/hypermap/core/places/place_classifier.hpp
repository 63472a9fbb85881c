// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What kind of place a part of the map is, by the objects in it.
///
/// Source: [smap] 3.5.1 (places have classes), table 2.1 (conceptual map: what belongs where).
#pragma once

#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/objects/object_beliefs.hpp"
#include "hypermap/core/places/class_sizes.hpp"

#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace hypermap {

/// How many objects of a class there are to be expected, by the class' canonical name.
using ClassAmounts = std::map<std::string, double, std::less<>>;

/// Of some objects: each counts as much as it is probable to be real, spread over its classes.
[[nodiscard]] ClassAmounts class_amounts(std::span<const ObjectBeliefs> objects,
                                         const ClassRegistry& classes);

struct PlaceProbability {
  std::string place;
  double probability = 0.0;
  friend bool operator==(const PlaceProbability&, const PlaceProbability&) = default;
};

/// What a place may be: all classes of places, the most probable first, of equals by name; their
/// probabilities sum to 1. Empty where there are no classes.
using PlaceBelief = std::vector<PlaceProbability>;

/// Tells what kind of place it is from the objects there. A program may have its own. Threads:
/// const functions are called concurrently.
class PlaceClassifier {
 public:
  virtual ~PlaceClassifier() = default;

  [[nodiscard]] virtual PlaceBelief classify(const ClassAmounts& objects) const = 0;
  /// The class of a place of such a belief; none where nothing is probable enough.
  [[nodiscard]] virtual std::optional<std::string> decide(const PlaceBelief& belief) const = 0;

 protected:
  PlaceClassifier() = default;
  PlaceClassifier(const PlaceClassifier&) = default;
  PlaceClassifier(PlaceClassifier&&) = default;
  PlaceClassifier& operator=(const PlaceClassifier&) = default;
  PlaceClassifier& operator=(PlaceClassifier&&) = default;
};

/// What belongs where, and how large it is. `data/places.yaml` has some for homes and offices.
struct PlaceRules {
  /// By the canonical name of a class of objects and the name of a class of places: how many times
  /// as many are there as in places that the class does not name. From 0.01 to 100.
  std::map<std::string, std::map<std::string, double>, std::less<>> belongings;
  std::vector<std::string> places;  ///< All classes of places, ascending.
  /// Of n objects of a class n to the power of this count: six chairs are no six witnesses. In (0,
  /// 1].
  double tempering = 0.5;
  double min_probability = 0.5;  ///< Of a place that is said to be of a class, in [0, 1].
  /// What a metre costs in a place of a class, 1 unless it stands here. From 0.01 to 1000.
  std::map<std::string, double, std::less<>> metre_costs;
  ClassSizes sizes = {};  ///< Of classes of objects.
  friend bool operator==(const PlaceRules&, const PlaceRules&) = default;
};

/// Errors: kInvalidArgument naming the field: a number out of its range, places not ascending,
/// none, or one in two spellings, a belonging or cost of a place that is none of them, a class
/// whose name is not canonical; those of validate(rules.sizes).
[[nodiscard]] Result<void> validate(const PlaceRules& rules);

/// Naive Bayes over what belongs where, with a uniform prior: the weights of the classes of objects
/// that are there multiply, each to the power of their tempered amount.
///
/// Boundary: of objects that say nothing, as of none, all places are equally probable, and it
/// decides for none of several.
class BelongingsClassifier final : public PlaceClassifier {
 public:
  /// Errors: those of validate.
  [[nodiscard]] static Result<BelongingsClassifier> create(PlaceRules rules);

  [[nodiscard]] PlaceBelief classify(const ClassAmounts& objects) const override;
  [[nodiscard]] std::optional<std::string> decide(const PlaceBelief& belief) const override;

  [[nodiscard]] const PlaceRules& rules() const noexcept { return rules_; }

 private:
  explicit BelongingsClassifier(PlaceRules rules) : rules_(std::move(rules)) {}

  PlaceRules rules_;
};

}  // namespace hypermap
