// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/wkt.hpp"

#include "hypermap/core/geometry/polygon_budget.hpp"
#include "wkt_text.hpp"

#include <algorithm>
#include <new>
#include <utility>

namespace hypermap {
namespace {

Unexpected bad_shape(const Error& error, std::size_t column) {
  const ErrorCode code =
      error.code == ErrorCode::kInvalidArgument ? ErrorCode::kMalformedFile : error.code;
  return fail(code, "column " + std::to_string(column) + ": " + error.what);
}

bool is_unclosed(const RingText& ring) {
  return ring.points.size() > 1 && !ring.is_closed;
}

Result<Polygon> polygon_of(const PolygonText& rings, const LoadBudget& budget) {
  std::vector<Ring> holes;
  for (std::size_t i = 1; i < rings.size(); ++i) holes.push_back(rings[i].points);
  return make_polygon(rings.front().points, std::move(holes), budget);
}

/// The same rings without spikes; counts those that had some.
Result<PolygonText> spike_free(PolygonText rings, std::size_t& num_spiked) {
  for (RingText& ring : rings) {
    auto clean = without_spikes(std::move(ring.points));
    if (!clean) return bad_shape(clean.error(), ring.column);
    if (clean->had_spikes) ++num_spiked;
    ring.points = std::move(clean->ring);
  }
  return rings;
}

/// Parts are in the form in which they are read when they are written; rounded crossings may leave
/// one that is no polygon.
Result<void> append_winding_fill(WktShape& shape, const RingText& ring, const LoadBudget& budget) {
  auto fill = resolve_winding(ring.points, budget);
  if (!fill) return bad_shape(fill.error(), ring.column);
  for (Polygon& part : fill->parts) {
    auto polygon = make_polygon(std::move(part.outer), std::move(part.holes), budget);
    if (!polygon) return bad_shape(polygon.error(), ring.column);
    shape.parts.push_back(*std::move(polygon));
  }
  ++shape.wound_rings;
  if (fill->had_spikes) ++shape.spiked_rings;
  return {};
}

/// A polygon is what it says, spikes apart; a single ring that is none by itself may stand for its
/// winding fill.
Result<void> append_parts(WktShape& shape, const PolygonText& rings, const LoadBudget& budget) {
  const auto unclosed = std::count_if(rings.begin(), rings.end(), is_unclosed);
  shape.unclosed_rings += static_cast<std::size_t>(unclosed);
  for (const RingText& ring : rings) shape.missing_commas += ring.missing_commas;
  auto polygon = polygon_of(rings, budget);
  if (!polygon && polygon.error().code == ErrorCode::kInvalidArgument) {
    HYPERMAP_ASSIGN_OR_RETURN(const PolygonText mended, spike_free(rings, shape.spiked_rings));
    polygon = polygon_of(mended, budget);
    if (!polygon && rings.size() == 1) return append_winding_fill(shape, mended.front(), budget);
  }
  if (!polygon) return bad_shape(polygon.error(), rings.front().column);
  shape.parts.push_back(*std::move(polygon));
  return {};
}

std::size_t num_vertices(const Polygon& polygon) {
  std::size_t count = polygon.outer.size();
  for (const Ring& hole : polygon.holes) count += hole.size();
  return count;
}

bool boxes_overlap(const Rect& a, const Rect& b) {
  return (a.min.array() < b.max.array()).all() && (b.min.array() < a.max.array()).all();
}

Result<bool> areas_overlap(const Polygon& a, const Polygon& b, const LoadBudget& budget) {
  constexpr double kRounding = 1e-12;
  HYPERMAP_TRY(budget.draw_edge_tests(num_vertices(a) * num_vertices(b)));
  return jaccard(a, b) > kRounding;
}

Result<void> check_disjoint(const std::vector<Polygon>& parts, const LoadBudget& budget) {
  std::vector<Rect> boxes;
  boxes.reserve(parts.size());
  for (const Polygon& part : parts) boxes.push_back(bounds(part));
  for (std::size_t i = 0; i < parts.size(); ++i) {
    HYPERMAP_TRY(budget.draw_edge_tests(i));
    for (std::size_t j = 0; j < i; ++j) {
      if (!boxes_overlap(boxes[i], boxes[j])) continue;
      HYPERMAP_ASSIGN_OR_RETURN(const bool overlap, areas_overlap(parts[i], parts[j], budget));
      if (!overlap) continue;
      return fail(ErrorCode::kMalformedFile,
                  "column 1: parts " + std::to_string(j) + " and " + std::to_string(i) +
                      " of the shape overlap");
    }
  }
  return {};
}

/// The limits of what the text says hold for what it stands for, too.
Result<void> check_limits(const std::vector<Polygon>& parts, const WktLimits& limits) {
  std::size_t num_vertices = 0;
  std::size_t num_holes = 0;
  for (const Polygon& part : parts) {
    num_vertices += part.outer.size();
    for (const Ring& hole : part.holes) num_vertices += hole.size();
    num_holes = std::max(num_holes, part.holes.size());
  }
  const auto check = [](std::size_t count, std::size_t limit, const char* what) -> Result<void> {
    if (count <= limit) return {};
    return fail(ErrorCode::kLimit,
                "column 1: stands for " + std::to_string(count) + what + ", the limit is " +
                    std::to_string(limit));
  };
  HYPERMAP_TRY(check(parts.size(), limits.max_parts, " parts"));
  HYPERMAP_TRY(check(num_holes, limits.max_holes, " holes"));
  return check(num_vertices, limits.max_vertices, " vertices");
}

}  // namespace

Result<WktShape> read_wkt(std::string_view text,
                          const WktLimits& limits,
                          const LoadBudget& budget) {
  try {
    HYPERMAP_ASSIGN_OR_RETURN(const auto polygons, parse_wkt(text, limits));
    WktShape shape;
    for (const PolygonText& rings : polygons) HYPERMAP_TRY(append_parts(shape, rings, budget));
    HYPERMAP_TRY(check_limits(shape.parts, limits));
    if (shape.parts.size() > 1) HYPERMAP_TRY(check_disjoint(shape.parts, budget));
    return shape;
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::kOutOfMemory, "no memory for the shape");
  }
}

}  // namespace hypermap
