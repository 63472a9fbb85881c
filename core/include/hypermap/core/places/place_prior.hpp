// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What the surroundings of an observation say of its class: cups stand in kitchens.
///
/// Source: [smap] Eq. (3.17) (prior knowledge by an external factor, as place classification),
/// table 2.1 (conceptual map: what belongs where).
#pragma once

#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/objects/association.hpp"
#include "hypermap/core/objects/class_prior.hpp"
#include "hypermap/core/objects/object_map.hpp"
#include "hypermap/core/places/place_classifier.hpp"
#include "hypermap/core/places/topological_map.hpp"

#include <string_view>
#include <utility>

namespace hypermap {

struct OptionTable;

/// Outside knowledge of classes. A program may have its own: a network that looks at the whole
/// image, the time of the day. Threads: const functions are called concurrently.
class ClassPriorSource {
 public:
  virtual ~ClassPriorSource() = default;

  /// What is known of the class of what was observed, before the map has the observation. It must
  /// not follow from detections of the same object: those count by themselves.
  [[nodiscard]] virtual ClassPrior prior_of(const Observation& observation,
                                            const ObjectMap& objects,
                                            const TopologicalMap& places,
                                            const ClassRegistry& classes) const = 0;

 protected:
  ClassPriorSource() = default;
  ClassPriorSource(const ClassPriorSource&) = default;
  ClassPriorSource(ClassPriorSource&&) = default;
  ClassPriorSource& operator=(const ClassPriorSource&) = default;
  ClassPriorSource& operator=(ClassPriorSource&&) = default;
};

/// Where outside knowledge comes from.
enum class ClassPriorKind {
  kNone,    ///< There is none.
  kPlaces,  ///< From the objects around and what belongs where (`PlacePrior`).
};

struct PlacePriorOptions {
  ClassPriorKind source = ClassPriorKind::kNone;
  /// No class becomes less probable by more than this.
  double max_factor = 4.0;
  /// Objects at vertices so many edges away are the surroundings.
  int num_layers = 3;
  /// Objects less probable to be real are no surroundings. No unit.
  double min_real = 0.5;
  friend bool operator==(const PlacePriorOptions&, const PlacePriorOptions&) = default;
};
[[nodiscard]] Result<void> validate(const PlacePriorOptions& options);
[[nodiscard]] const OptionTable& option_table(const PlacePriorOptions& options);

/// How many times as many objects of a class there are in such a place as in one of which nothing
/// is known: sum of P(place) w(class, place), divided by the mean of w over all places.
///
/// Source: [smap] Eq. (3.17). Boundary: 1 where all places are equally probable, and for a class
/// that belongs nowhere in particular.
[[nodiscard]] double belonging_factor(const PlaceRules& rules,
                                      std::string_view canonical_class,
                                      const PlaceBelief& place);

/// The place's belief about its objects: the objects around an observation, by their detections
/// alone, tell what kind of place it is, and that what belongs there.
///
/// What may be the object itself (one is within the other's box) is no evidence for it, and a
/// neighbour counts without its own prior, so that no evidence comes back to where it came from.
///
/// It speaks against what does not belong to the place, never for what does: rules compare places
/// for one class, and that sofas are mostly in living rooms does not say that there are more sofas
/// in them than chairs.
class PlacePrior final : public ClassPriorSource {
 public:
  /// Errors: those of validate(rules) and validate(options).
  [[nodiscard]] static Result<PlacePrior> create(PlaceRules rules,
                                                 const PlacePriorOptions& options);

  /// Of the classes that the rules and the registry name, those whose factor is below 1: the object
  /// may have been called so in other frames, which this observation's names do not tell.
  /// Cost: of the objects around, O(log n + their classes); of the rules, O(weights).
  [[nodiscard]] ClassPrior prior_of(const Observation& observation,
                                    const ObjectMap& objects,
                                    const TopologicalMap& places,
                                    const ClassRegistry& classes) const override;

 private:
  PlacePrior(BelongingsClassifier classifier, const PlacePriorOptions& options)
      : classifier_(std::move(classifier)), options_(options) {}

  /// The factors below 1 in such a place.
  [[nodiscard]] ClassPrior not_at_home(const PlaceBelief& place,
                                       const ClassRegistry& classes) const;

  BelongingsClassifier classifier_;
  PlacePriorOptions options_;
};

}  // namespace hypermap
