// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Names of classes that a job was given and that its input does not know.
#pragma once

#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/core/base/result.hpp"

#include <span>
#include <string>
#include <vector>

namespace hypermap {

/// A finding for each name of no class that the input speaks of, with the nearest one that there
/// is: it may be misspelt. `option` is where the names come from.
[[nodiscard]] std::vector<Finding> unknown_names(std::span<const std::string> names,
                                                 const char* option,
                                                 const ClassRegistry& classes);

}  // namespace hypermap
