// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What is known of an observation's class besides detections: cups stand in kitchens, and are
/// smaller than bottles.
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

#include <map>
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
  kPlaces,  ///< From the objects around, what belongs where, and how large it is (`PlacePrior`).
};

struct PlacePriorOptions {
  ClassPriorKind source = ClassPriorKind::kNone;
  /// No class becomes less probable by more than this for its place,
  double max_factor = 4.0;
  /// and by this for its size.
  double max_size_factor = 10.0;
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
///
/// Likewise the size of the object that the observation may be of (whose box shares most with
/// its own, a fifth of their union at least) speaks against classes that are not so large, or,
/// where it was seen whole, not so small (`size_log_factor`). A first observation has no size yet.
class PlacePrior final : public ClassPriorSource {
 public:
  /// Errors: those of validate(rules) and validate(options).
  [[nodiscard]] static Result<PlacePrior> create(PlaceRules rules,
                                                 const PlacePriorOptions& options);

  /// Of the classes that the rules and the registry name, those whose factor is below 1: the object
  /// may have been called so in other frames, which this observation's names do not tell.
  /// Cost: of the objects around, O(log n + their classes); of the rules, O(weights); `seen_share`
  /// and `turned_box_of` of one object.
  [[nodiscard]] ClassPrior prior_of(const Observation& observation,
                                    const ObjectMap& objects,
                                    const TopologicalMap& places,
                                    const ClassRegistry& classes) const override;

 private:
  PlacePrior(BelongingsClassifier classifier, const PlacePriorOptions& options)
      : classifier_(std::move(classifier)), options_(options) {}

  /// Logarithms of the factors below 1.
  using LogFactors = std::map<ClassId, double>;
  [[nodiscard]] LogFactors of_place(const Observation& observation,
                                    const ObjectMap& objects,
                                    const TopologicalMap& places,
                                    const ClassRegistry& classes) const;
  [[nodiscard]] LogFactors of_size(const Observation& observation,
                                   const ObjectMap& objects,
                                   const ClassRegistry& classes) const;

  BelongingsClassifier classifier_;
  PlacePriorOptions options_;
};

}  // namespace hypermap
