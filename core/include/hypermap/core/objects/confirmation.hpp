// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which objects are confirmed; the others are tentative.
///
/// Source: [hypermap] 3.4.5; [smap] figure 3.23, C.3.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/objects/object_map.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace hypermap {

struct OptionTable;

struct ConfirmationOptions {
  /// Existence must be above. None: no condition.
  std::optional<LogOdds> min_existence = std::nullopt;
  /// P(real) must not be below. None: no condition. Deviation: the sources ask for existence or
  /// confidence, which do not know how often a detection was to be expected. Above a half: a false
  /// object misleads more than one that is shown a few frames later.
  std::optional<Probability> min_real_probability = Probability(0.75);
  GoneRule gone = {};  ///< What is gone is not confirmed.
  /// Object confidence must not be below, o_valid. None: no condition.
  std::optional<Probability> min_confidence = std::nullopt;
  ObjectConfidenceOptions confidence = {};
  std::uint32_t min_observations = 3;  ///< Seen less often is not enough.
  /// Of two objects on the same points only the stronger one is confirmed.
  bool one_per_place = true;
  double same_place_share = 0.5;  ///< Share of the points of the smaller that lie in the other ...
  double same_place_diagonal = 0.4;  ///< ... whose diagonal it has at least this share of.
  /// Both are, when they were detected beside each other in so many frames ...
  std::uint32_t apart_frames = 6;
  double apart_share = 0.5;  ///< ... and in this share of those that show the weaker one.
  friend bool operator==(const ConfirmationOptions&, const ConfirmationOptions&) = default;
};

/// Errors: kInvalidArgument naming the first field out of its range.
[[nodiscard]] Result<void> validate(const ConfirmationOptions& options);
[[nodiscard]] const OptionTable& option_table(const ConfirmationOptions& options);

/// A condition of `ConfirmationOptions`.
enum class Condition : std::uint8_t {
  kObservations,     ///< Seen often enough.
  kClass,            ///< Some class was named.
  kNotGone,          ///< Not gone by the rule `gone`.
  kRealProbability,  ///< P(real).
  kExistence,
  kConfidence,
  kOwnPlace,  ///< No stronger object on the same points.
};

/// A condition that an object misses, with its value and the least one that is asked for; of
/// kNotGone the clear looks and those that mean gone, of kOwnPlace the stronger object alone.
struct MissedCondition {
  Condition condition = Condition::kObservations;
  double value = 0.0;
  double limit = 0.0;
  ObjectId stronger = kNoObject;
  friend bool operator==(const MissedCondition&, const MissedCondition&) = default;
};

/// Why each object is withheld: nothing of those that are confirmed. An object's own conditions
/// come first, in the order of the enumeration; kOwnPlace is asked of those alone that meet them.
struct ConfirmationResult {
  ObjectId id;
  std::vector<MissedCondition> missed;
  friend bool operator==(const ConfirmationResult&, const ConfirmationResult&) = default;
};
/// Of all objects, ascending by id.
[[nodiscard]] std::vector<ConfirmationResult> confirmation_results(
    const ObjectMap& objects, const ConfirmationOptions& options);

/// Ids of the confirmed objects, ascending: those that miss no condition.
[[nodiscard]] std::vector<ObjectId> confirmed_objects(const ObjectMap& objects,
                                                      const ConfirmationOptions& options);

}  // namespace hypermap
