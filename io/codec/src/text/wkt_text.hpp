// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Rings as their text has them, before anybody asks what they enclose.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/polygon.hpp"
#include "hypermap/io/codec/wkt.hpp"

#include <cstddef>
#include <string_view>
#include <vector>

namespace hypermap {

struct RingText {
  Ring points;  ///< Without the one that closes the ring.
  bool is_closed = false;
  std::size_t column = 1;          ///< Where it begins, 1-based.
  std::size_t missing_commas = 0;  ///< Mended, at most one.
};
using PolygonText = std::vector<RingText>;  ///< Outer ring first.

/// The polygons of a POLYGON or MULTIPOLYGON.
/// Errors: kMalformedFile, kUnsupported, kLimit with the column, as read_wkt.
[[nodiscard]] Result<std::vector<PolygonText>> parse_wkt(std::string_view text,
                                                         const WktLimits& limits);

}  // namespace hypermap
