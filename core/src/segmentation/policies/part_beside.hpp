// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Parts of an object between which something nearer stands.
#pragma once

#include "segmentation/depth_components.hpp"

#include <cstdint>

namespace hypermap {

/// Whether surface `id` is a part of the object whose best surface is `best` though something
/// nearer stands between them in the picture: the two ends of a microwave behind a vase.
///
/// In most rows of the picture that both have, all that is measured between them is clearly nearer
/// than either, and their ends there are no farther apart in depth than half of what they are
/// sideways: so far a face may be turned from the camera. Not in the sources. Requires: both have
/// cells in the box. Cost: O(cells of the bounds of both).
[[nodiscard]] bool is_part_beside(const DepthWindow& window,
                                  const DepthComponents& labelled,
                                  std::uint32_t best,
                                  std::uint32_t id);

}  // namespace hypermap
