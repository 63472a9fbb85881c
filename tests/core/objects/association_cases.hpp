// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What the tests of association see: classes, a chair, observations of boxes.
#pragma once

#include "hypermap/core/objects/association.hpp"
#include "support/object_builders.hpp"

#include <cstdint>

namespace hypermap::testing_support {

inline constexpr ClassId kChairClass{0};
inline constexpr ClassId kCupClass{1};
inline constexpr ClassId kOvenClass{2};
inline constexpr ClassId kFridge{3};
inline constexpr ClassId kTv{4};

inline Observation seen(const Box& box, ClassId id, std::uint64_t frame = 0) {
  return observed(surface_of(box), scores(id, 0.8), frame);
}

inline AssociationOptions with(AssociationPolicy policy) {
  AssociationOptions options;
  options.policy = policy;
  return options;
}

inline const Box kChairBox = box_at({0, 0, 0.45}, {0.5, 0.5, 0.9});

}  // namespace hypermap::testing_support
