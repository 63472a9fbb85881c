// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Reads an object's observation log from its line in `objects.jsonl`.
#pragma once

#include "hypermap/core/objects/observation_log.hpp"
#include "hypermap/io/codec/bounded_json.hpp"

namespace hypermap {

/// Errors: kMalformedFile with the path of the member, of what was written wrong or no log holds.
[[nodiscard]] Result<ObservationLog> observation_log_from_json(const JsonNode& node);

}  // namespace hypermap
