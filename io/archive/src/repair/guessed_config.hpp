// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The configuration of an archive that has lost its own.
#pragma once

#include "hypermap/io/archive/hypermap_config.hpp"
#include "salvaged_members.hpp"

#include <span>
#include <string_view>

namespace hypermap {

/// Formats of extensions that a map has once, in the order in which archives list them.
[[nodiscard]] std::span<const std::string_view> single_formats();

/// Members by the names that an archive of ours gives them are what they are there; of others,
/// metadata of a grid are an occupancy layer, a list of shapes a semantic one, `.ot` and `.bt`
/// octrees. All lie in the frame `map`. Class grids are left out: nothing else tells their classes.
[[nodiscard]] HypermapConfig guess_config(const SalvagedContents& members);

}  // namespace hypermap
