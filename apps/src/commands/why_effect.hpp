// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// In words, what one observation changed of an object.
#pragma once

#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/core/objects/observation_log.hpp"

#include <string>

namespace hypermap::app {

/// "in log-odds: existence 0.85 more, cup 1.23 more, and remote 0.41 less": what changed by at
/// least 0.005, the entry's own class before the other ones. Empty: nothing did, or it is not kept.
[[nodiscard]] std::string effect_text(const ObservationLogEntry& entry,
                                      const ClassRegistry& classes);

}  // namespace hypermap::app
