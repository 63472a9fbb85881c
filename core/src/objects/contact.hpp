// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How two bodies (observations or objects) lie to each other, and whether they are one thing.
#pragma once

#include "hypermap/core/objects/association.hpp"
#include "touch_grid.hpp"

#include <vector>

namespace hypermap {

/// Box, points and classes of an observation or an object, ready to be compared.
struct Body {
  Box box;
  std::vector<Eigen::Vector3d> points;  ///< Thinned evenly to at most 300.
  std::vector<ClassEvidence> classes;   ///< Ascending by id.
  TouchGrid grid;                       ///< Of all points.
  std::uint32_t num_observations = 1;
};

[[nodiscard]] Body body_of(const Observation& observation, double near_m);
[[nodiscard]] Body body_of(const Object& object, double near_m);

struct Contact {
  double share_of_first = 0.0;   ///< Of its points, those near the second.
  double share_of_second = 0.0;  ///< Of its points, those near the first.
  double box_share = 0.0;        ///< Of the smaller box, what lies in the other.
  double distance = 0.0;         ///< Of the centres in mean diagonals.
  double diagonal_ratio =
      0.0;                 ///< The diagonal of the body with the larger share over the other's.
  double agreement = 0.0;  ///< Of the class vectors, in [0, 1].
  /// Observations of the body with the larger share over those of the other.
  double maturity_ratio = 1.0;
};

[[nodiscard]] Contact contact(const Body& first, const Body& second, double near_m);

/// The most that both say about one class, each relative to its favourite, in [0, 1]: 1 when the
/// favourites are the same. Requires: ascending by id.
[[nodiscard]] double class_agreement(std::span<const ClassEvidence> a,
                                     std::span<const ClassEvidence> b);

/// The contact is close enough for one thing; `strictness` >= 1 asks for that much more.
[[nodiscard]] bool is_same_thing(const Contact& contact,
                                 const AssignmentOptions& options,
                                 double strictness = 1.0);

/// How well the two go together, > 0; only for ranking.
[[nodiscard]] double affinity(const Contact& contact);

}  // namespace hypermap
