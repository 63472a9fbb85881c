// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Keys of a map that are known, and those that are kept because they are not.
#pragma once

#include "hypermap/core/base/value_tree.hpp"

#include <span>
#include <string_view>
#include <vector>

namespace hypermap {

/// The entries of `map` whose keys are not in `known`, as a map; null when there are none.
[[nodiscard]] ValueTree other_keys(const ValueTree& map, std::span<const std::string_view> known);

/// Appends the entries of `extra`, a map or null.
void append_keys(std::vector<ValueTree::Entry>& entries, const ValueTree& extra);

}  // namespace hypermap
