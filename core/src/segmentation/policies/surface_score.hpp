// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How well a surface explains a detection's box.
#pragma once

#include "segmentation/depth_components.hpp"
#include "support_contacts.hpp"

#include <cstdint>

namespace hypermap {

/// Share of the box that the rectangle spans: a detector's box is tight around its object.
/// Requires: a box with cells.
[[nodiscard]] double span_share(const PixelRect& rect, const PixelRect& box);

/// Whether the surface fills another detection's box better than this one.
[[nodiscard]] bool is_of_competing_box(const DepthComponent& component, const DepthWindow& window);

/// Large in the box, absent outside, from edge to edge and not far beyond one, not mostly hidden by
/// what surrounds it, and not what another box is about. The one of the highest score is the
/// object's; 0 for what another detection has.
[[nodiscard]] double surface_score(const DepthWindow& window,
                                   const DepthComponents& labelled,
                                   const SupportContacts& supports,
                                   std::uint32_t id);

}  // namespace hypermap
