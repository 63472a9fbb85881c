// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Values of options as YAML has them.
#pragma once

#include "hypermap/core/base/option_table.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/io/codec/bounded_yaml.hpp"

#include <string>

namespace hypermap {

/// What stands behind the option's name in a file.
[[nodiscard]] std::string yaml_text(const BoundOption& option);

/// Gives the option the value of `node`.
/// Errors: kMalformedFile for a value of another kind or out of range; the option keeps its own.
[[nodiscard]] Result<void> assign_yaml(const BoundOption& option, const YamlNode& node);

}  // namespace hypermap
