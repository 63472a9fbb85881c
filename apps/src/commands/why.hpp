// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What `query --why` and `--why-not` say.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/plan_point.hpp"
#include "hypermap/io/archive/map_archive.hpp"

namespace hypermap::app {

/// To standard output: why the object is in the map, for people or as one JSON document.
/// Errors: kNotFound, field "--why", when the map has no object of that id.
[[nodiscard]] Result<void> print_why(const MapArchive& archive, ObjectId id, bool json);

/// The same of a place that shows no object. Errors: those of `explain_place`.
[[nodiscard]] Result<void> print_why_not(const MapArchive& archive, const PlanPoint& at, bool json);

}  // namespace hypermap::app
