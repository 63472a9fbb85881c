// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A topological map as lines of JSON: a head with its options and where the sensor is, then one
/// line for each vertex with those before it that it is joined to, so that what is read equals what
/// was written bit by bit.
#pragma once

#include "hypermap/core/base/load_budget.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/places/topological_map.hpp"
#include "hypermap/io/codec/source_name.hpp"

#include <cstddef>
#include <string>
#include <string_view>

namespace hypermap {

/// The newest version that is read, and the one that is written.
inline constexpr int kTopologicalMapVersion = 1;

struct TopologicalMapLimits {
  std::size_t max_vertices = 1'000'000;
  std::size_t max_line_bytes = std::size_t{1} << 20;  ///< A vertex is a line.
};

/// Errors: kLimit beyond the limits.
[[nodiscard]] Result<std::string> write_topological_map(const TopologicalMap& map,
                                                        const TopologicalMapLimits& limits = {});

/// Errors: kMalformedFile with line and path for a missing or unknown key, a wrong type, vertices
/// that are not those before, what `TopologicalMap::create` refuses (rules 1 and 3 among it), a
/// number of lines that is not the one said; kUnsupported "written by a newer version N"; kLimit;
/// kInterrupted when `budget` is told to stop; nothing is drawn of it.
[[nodiscard]] Result<TopologicalMap> parse_topological_map(std::string_view bytes,
                                                           const SourceName& source,
                                                           const TopologicalMapLimits& limits = {},
                                                           const LoadBudget& budget = {});

}  // namespace hypermap
