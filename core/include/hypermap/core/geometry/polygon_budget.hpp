// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Polygons of strangers: the functions of polygon.hpp whose cost grows faster than their input,
/// drawn from the account of a load.
#pragma once

#include "hypermap/core/base/load_budget.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/polygon.hpp"

#include <vector>

namespace hypermap {

/// make_polygon; the search for the places of h holes, O(n h), is drawn from `budget`.
/// Errors: also those of LoadBudget::draw_edge_tests.
[[nodiscard]] Result<Polygon> make_polygon(Ring outer,
                                           std::vector<Ring> holes,
                                           const LoadBudget& budget);

/// resolve_winding; what a ring costs that crosses itself, O(n^2) and its crossings, is drawn from
/// `budget`. Errors: also those of LoadBudget::draw_edge_tests.
[[nodiscard]] Result<WindingFill> resolve_winding(Ring ring, const LoadBudget& budget);

}  // namespace hypermap
