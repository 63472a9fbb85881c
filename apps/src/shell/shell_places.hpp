// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Locations and areas as they are typed at the shell.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/plan_point.hpp"
#include "hypermap/core/geometry/polygon.hpp"

#include <string>

namespace hypermap::app {

/// "1.5,2", "1.5 2", "(1.5, 2)", "POINT (1.5 2)", each also with a height behind. Unit: metre.
/// Errors: kInvalidArgument naming `location`.
[[nodiscard]] Result<PlanPoint> parse_location(const std::string& text);

/// "0 0,1 0,1 1", "0,0 1,0 1,1", both also in parentheses, or "POLYGON ((0 0, 1 0, 1 1))", with
/// holes. Errors: kInvalidArgument naming `area`; those of read_wkt.
[[nodiscard]] Result<Polygon> parse_shell_area(const std::string& text);

}  // namespace hypermap::app
