// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What questions to a map have in common: whether it knows a frame, and how it says that nothing
/// fulfils their conditions.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/archive/map_query.hpp"

#include <string>

namespace hypermap {

/// What an object is to fulfil beside its place: " of class 'stool' in the area".
[[nodiscard]] std::string conditions_of(const MapQuery& query);

/// The same of what no object fulfils, with the name that may have been meant.
[[nodiscard]] std::string unmet_conditions_of(const MapQuery& query, const MapArchive& archive);

/// A frame is known when a layer or a transform has it; the empty one always is. Errors: kNotFound.
[[nodiscard]] Result<void> check_frame(const MapArchive& archive, const std::string& frame_id);

}  // namespace hypermap
