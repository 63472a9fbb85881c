// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// One object from its JSON line.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/objects/object.hpp"
#include "hypermap/io/archive/object_json.hpp"
#include "hypermap/io/codec/bounded_json.hpp"

#include <optional>

namespace hypermap {

/// `cells`: the line of its voted cells, which a file of version 3 has. Errors: those of
/// parse_objects, naming line and path.
[[nodiscard]] Result<Object> object_from_json(const JsonNode& node,
                                              const std::optional<JsonNode>& cells,
                                              const ObjectFileLimits& limits);

}  // namespace hypermap
