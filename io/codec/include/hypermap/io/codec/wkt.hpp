// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Shapes as Well-Known Text, strictly read.
///
/// Source: [hypermap] 3.3.5 (semantic files); OGC 06-103r4, section 7.
/// Scope: POLYGON and MULTIPOLYGON in the plane, keywords in any case. No EMPTY, no Z or M, no
/// SRID, no other geometry: each is refused by name.
#pragma once

#include "hypermap/core/base/load_budget.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/polygon.hpp"

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap {

/// Of the text, and of what it stands for; the vertex that closes a ring is no further one.
struct WktLimits {
  std::size_t max_vertices = 100'000;  ///< Of the whole shape.
  std::size_t max_holes = 1'000;       ///< Of one polygon.
  std::size_t max_parts = 100;         ///< Of a MULTIPOLYGON.
};

/// What a text stands for, and what was mended on reading.
struct WktShape {
  std::vector<Polygon> parts;      ///< One polygon, or several disjoint ones.
  std::size_t unclosed_rings = 0;  ///< Did not repeat their first point; hand-made maps do that.
  std::size_t wound_rings = 0;     ///< Wound more than once; stand for their non-zero winding fill.
  std::size_t spiked_rings = 0;    ///< Went straight back on themselves; spikes enclose nothing.
  std::size_t missing_commas = 0;  ///< Between two points, one a ring: "1 0 1 1".
};

/// Errors: kMalformedFile with the column (1-based, in bytes) for anything that is no such text,
/// and for a shape that is none: fewer than three distinct points, zero area, a ring that
/// crosses itself with windings of both signs, rings of a polygon that meet elsewhere than in
/// common corners, holes outside or overlapping, parts that overlap, a coordinate that is not
/// finite or beyond 1e6 m; kUnsupported for other geometries; kLimit, named; those of
/// LoadBudget::draw_edge_tests.
[[nodiscard]] Result<WktShape> read_wkt(std::string_view text,
                                        const WktLimits& limits = {},
                                        const LoadBudget& budget = {});

/// POLYGON, or MULTIPOLYGON for several parts, rings closed, numbers in their shortest form that
/// reads back to the same value: what read_wkt gave is read again as it was. Requires: parts not
/// empty.
[[nodiscard]] std::string write_wkt(std::span<const Polygon> parts);

}  // namespace hypermap
