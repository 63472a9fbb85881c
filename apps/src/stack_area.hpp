// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which cells of a stack are asked for, by area, turn and resolution.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/polygon.hpp"
#include "hypermap/projection/grids/grid_geometry.hpp"
#include "stack_arguments.hpp"

#include <optional>
#include <string>
#include <vector>

namespace hypermap::app {

/// "X0,Y0,X1,Y1"; none of no text. Errors: kInvalidArgument for what is no area.
[[nodiscard]] Result<std::optional<std::vector<double>>> parse_area(
    const std::optional<std::string>& text);

/// Where the stack is to be had: all of it, or the area, at the resolution asked for.
/// Errors: those of parse_area; kInvalidArgument for an area without a cell, kLimit for one of more
/// than a billion of them a side, with the area as it was given.
[[nodiscard]] Result<GridGeometry> geometry_asked_for(const StackArguments& arguments,
                                                      const GridGeometry& whole);

/// Errors: kNotFound for an area in which the stack has no cell.
[[nodiscard]] Result<void> check_overlap(const GridGeometry& asked, const GridGeometry& whole);

/// What must be read of a map for the area, with all that a cell of it may be made from; none: all.
/// Errors: those of parse_area.
[[nodiscard]] Result<std::optional<Rect>> rect_around_area(const StackArguments& arguments);

/// "X0,Y0,X1,Y1" to the millimetre.
[[nodiscard]] std::string corners_text(const Rect& rect);

}  // namespace hypermap::app
