// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Explanations of objects and places as JSON.
#pragma once

#include "hypermap/core/objects/explanation.hpp"
#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/io/archive/place_explanation.hpp"

#include <string>

namespace hypermap::app {

/// One document, indented.
[[nodiscard]] std::string json_text(const Explanation& why,
                                    const MapArchive& archive,
                                    bool is_shown);
[[nodiscard]] std::string json_text(const PlaceExplanation& place,
                                    const MapArchive& archive,
                                    const PlanPoint& at);

}  // namespace hypermap::app
