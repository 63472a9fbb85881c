// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Alignment of a dataset's world to gravity, so that +z is up.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/frames.hpp"
#include "hypermap/io/dataset/dataset_reader.hpp"

#include <optional>
#include <string>

namespace hypermap {

struct GravityAlignment {
  MapFromInput map_from_input;
  std::string explanation;  ///< For people: what was done and why.
};

/// `wanted` is an axis ("z", "-y"), "floor" to look for the floor plane, or none: then the
/// dataset's description decides, TUM RGB-D is taken as it is (its world is gravity aligned), and
/// in any other dataset the floor is looked for.
///
/// Errors: those of map_from_input_axis and estimate_floor; the latter say that an axis can be
/// given.
[[nodiscard]] Result<GravityAlignment> align_to_gravity(const DatasetReader& dataset,
                                                        const std::optional<std::string>& wanted);

}  // namespace hypermap
