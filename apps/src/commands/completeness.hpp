// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How much of the objects in an answer was seen, and guesses of their boxes.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/box.hpp"
#include "hypermap/io/archive/map_query.hpp"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <map>
#include <optional>

namespace hypermap::app {

/// What a query says of an object besides what every layer says.
struct Completeness {
  double seen_share = 0.0;
  /// In the frame of the answer; where that is turned, the smallest box around the guess.
  std::optional<Box> completed = std::nullopt;
};

using CompletenessById = std::map<std::uint64_t, Completeness>;

/// Of the objects that `query` was answered with, by their ids; with guesses when `complete` is
/// set. Boundary: none when the query asks another layer than that of the objects.
/// Errors: those of FrameTree::to_from.
[[nodiscard]] Result<CompletenessById> completeness_of(const MapArchive& archive,
                                                       const MapQuery& query,
                                                       const MapAnswers& answers,
                                                       bool complete);

/// The guess as six numbers, `guess` beside them; null when there is none.
[[nodiscard]] nlohmann::ordered_json guess_json(const Completeness& object);

}  // namespace hypermap::app
