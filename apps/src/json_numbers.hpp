// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Numbers that may be unknown, as JSON.
#pragma once

#include <nlohmann/json.hpp>

#include <optional>

namespace hypermap::app {

/// null where it is unknown.
[[nodiscard]] inline nlohmann::ordered_json number_json(const std::optional<double>& value) {
  return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}

}  // namespace hypermap::app
