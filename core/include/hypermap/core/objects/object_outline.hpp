// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What an object covers, by its points where it has any, else by its box.
#pragma once

#include "hypermap/core/geometry/turned_box.hpp"
#include "hypermap/core/objects/object.hpp"

namespace hypermap {

/// The footprint of an object, else that of its box. Cost: that of `footprint`.
[[nodiscard]] Ring outline_of(const Object& object);

/// The least rectangle around the object's outline, as high as its box.
/// Cost: the square of the outline's corners.
[[nodiscard]] TurnedBox turned_box_of(const Object& object);

}  // namespace hypermap
