// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What questions to a map have in common: whether it knows a frame, and how it says that nothing
/// fulfils their conditions.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/archive/map_query.hpp"

#include <concepts>
#include <string>
#include <string_view>

namespace hypermap {

/// What an object is to fulfil beside its place: " of class 'stool' in the area".
[[nodiscard]] std::string conditions_of(const MapQuery& query);

/// The same of what no object fulfils, with the name that may have been meant.
[[nodiscard]] std::string unmet_conditions_of(const MapQuery& query, const MapArchive& archive);

/// A frame is known when a layer or a transform has it; the empty one always is. Errors: kNotFound.
[[nodiscard]] Result<void> check_frame(const MapArchive& archive, const std::string& frame_id);

/// The layer of that name, else the first, that holds a T; null when there is none.
template <std::derived_from<MapLayer> T>
[[nodiscard]] const Layer* find_layer_of(const MapArchive& archive, std::string_view name) {
  const Layer* named = archive.hypermap.find(name);
  if (named != nullptr && named->content.as<T>() != nullptr) return named;
  for (const Layer& layer : archive.hypermap.layers()) {
    if (layer.content.as<T>() != nullptr) return &layer;
  }
  return nullptr;
}

}  // namespace hypermap
