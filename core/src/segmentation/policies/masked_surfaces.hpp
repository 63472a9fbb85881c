// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which of the surfaces in a detection's mask are the detected object.
#pragma once

#include "segmentation/background_planes.hpp"
#include "surface_choice.hpp"

#include <cstdint>
#include <vector>

namespace hypermap {

/// The kinds with `kOthersKind` outside the mask, so that no surface crosses its edge.
/// Requires: a window with a mask.
[[nodiscard]] std::vector<std::uint8_t> kinds_in_mask(const DepthWindow& window,
                                                      std::vector<std::uint8_t> kind_of_cell);

/// All surfaces in the mask but those that networks put into masks by mistake:
///
/// * strips along the mask's edge that go on outside it, since masks are some pixels off: a few
///   columns of the wall beside a screen, or of the table below it. The foot of an object, which is
///   within what the plane below it tolerates, rises from that plane and stays. A mask that is
///   strips for more than its half is thin, and keeps them;
/// * what is seen through the object, since masks are filled: the floor between a chair's legs. It
///   lies on a plane of the background or goes on outside, is less than half of the mask, and
///   hardly any part of the mask is behind it, while others are before it. What hides it from
///   outside the mask is no sign of that: flat things stay whole though a post stands before them.
///
/// Where that is all of them, none is a mistake: the mask stays whole.
///
/// `kind_of_cell` are the kinds before `kinds_in_mask`, of `planes`; `labelled` are the surfaces
/// after it. Empty when the mask has no measurement.
/// Requires: a window with a mask. Cost: O(cells). Deviation: in none of the sources, which know
/// boxes alone.
[[nodiscard]] ComponentIds masked_surfaces(const DepthWindow& window,
                                           const DepthComponents& labelled,
                                           const std::vector<std::uint8_t>& kind_of_cell,
                                           const std::vector<Plane>& planes,
                                           const ForegroundOptions& options);

}  // namespace hypermap
