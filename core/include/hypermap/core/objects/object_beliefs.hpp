// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// All that is believed of one object at once, as probabilities, and how undecided its class is.
#pragma once

#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/core/base/log_odds.hpp"
#include "hypermap/core/objects/object.hpp"
#include "hypermap/core/segmentation/detection.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace hypermap {

/// How undecided a distribution is: - sum of p ln p, where 0 ln 0 is 0; from 0, one class is
/// certain, to ln n, n classes are equally probable.
///
/// Source: C. E. Shannon, "A mathematical theory of communication", 1948. Unit: nats.
/// Boundary: none of no class at all, which decides nothing. Requires: the probabilities sum to 1.
[[nodiscard]] std::optional<double> entropy_nats(std::span<const ClassEvidence> distribution);

/// What `class_distribution`, `entropy_nats`, `real_probability` and `object_confidence` (rule
/// real and class) say of an object, each read from its evidence once.
struct ObjectBeliefs {
  /// The most probable first; of equals the one most believed in, then the lowest id. The first is
  /// `best_class`, the second the runner-up. Classes of probability 0 are left out.
  /// Boundary: empty without any evidence of a class.
  std::vector<ClassEvidence> classes;
  std::optional<double> class_entropy_nats;  ///< Of `classes`.
  Probability real;                          ///< That it is one real object.
  Probability confidence;                    ///< That it is real and of the best class.

  friend bool operator==(const ObjectBeliefs&, const ObjectBeliefs&) = default;
};

/// Cost: that of `class_distribution` and of sorting it.
[[nodiscard]] ObjectBeliefs object_beliefs(const Object& object);

/// What an object is called wherever it has a name: that of its `best_class`, "unknown" without any
/// evidence of one. Requires: its classes are of the registry.
[[nodiscard]] std::string best_class_name(const Object& object, const ClassRegistry& classes);

}  // namespace hypermap
