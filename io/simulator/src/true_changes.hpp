// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What changed between two passes, as a layer of the truth.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/io/simulator/simulator.hpp"

#include <span>

namespace hypermap {

/// Adds a semantic layer `changes` to a truth, beside its layer `semantic` of what stands there at
/// the end; nothing when there are none. Its objects have class and footprint of the thing (of what
/// was moved or removed: in its old place) and the keys
///
///     thing: cup_1                      name in the scene
///     change: moved                     or removed, added
///     box: [x0, y0, z0, x1, y1, z1]     of that place, metres
///     at_end: 12                        its id in `semantic`; absent when it was removed
///
/// Errors: those of the layers.
[[nodiscard]] Result<void> add_changes(std::span<const SceneChange> changes, MapArchive& truth);

}  // namespace hypermap
