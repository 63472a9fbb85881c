// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "hypermap/core/geometry/polygon.hpp"

#include <cstdint>
#include <span>
#include <string>

namespace hypermap {

inline constexpr std::int32_t kUndefinedCartesian = -1;

/// A MULTIPOLYGON as the standard stores it: its header with the envelope, then WKB, all little
/// endian. Source: OGC 12-128r18, clause 2.1.3; OGC 06-103r4, clause 8.2.
/// Requires: at least one part, each a valid polygon; rings are closed here.
[[nodiscard]] std::string feature_geometry(std::span<const Polygon> parts);

/// The smallest rectangle around polygons. Requires: at least one.
[[nodiscard]] Rect bounds_of_parts(std::span<const Polygon> parts);

}  // namespace hypermap
