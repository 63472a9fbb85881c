// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What belongs where and how large it is, as a user wrote it.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/places/place_classifier.hpp"

#include <filesystem>

namespace hypermap {

/// A YAML map of `belongings`, a map from each class of objects, in any spelling, to a map from
/// classes of places to weights; where given `tempering`, `min_probability` and `metre_costs`, a
/// map from places, and `sizes`, a map from classes of objects to `longer`, `shorter` and `height`,
/// each [least, most] in metres. All places that occur are classes of places. `data/places.yaml` is
/// one.
///
/// Errors: kIo; those of `read_yaml`; kNotFound for an unknown key, with the nearest known name;
/// kMalformedFile naming file, line and key for a value of another kind or out of its range
/// (`validate` of PlaceRules) and for a class that stands twice.
[[nodiscard]] Result<PlaceRules> read_place_rules(const std::filesystem::path& path);

}  // namespace hypermap
