// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The types of layers that archives know from the start.
#pragma once

#include "hypermap/projection/layers/layer_registry.hpp"

namespace hypermap {

/// Those of LayerRegistry (the strict form's two), the grid stack and the supercells. A program
/// adds its own to a copy.
[[nodiscard]] LayerRegistry archive_layer_types();

}  // namespace hypermap
