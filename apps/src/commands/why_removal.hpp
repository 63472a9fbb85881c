// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// In words, what would take an object off the map.
#pragma once

#include "hypermap/core/objects/explanation.hpp"

#include <string>
#include <vector>

namespace hypermap::app {

/// What comes first of being hidden and being removed, then the other: what is hidden or removed
/// cannot be hidden. Empty: nothing takes it off.
[[nodiscard]] std::vector<std::string> removal_texts(const Removal& removal, bool is_shown);

}  // namespace hypermap::app
