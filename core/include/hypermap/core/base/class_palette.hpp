// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which colour a class has, in every image and export alike.
#pragma once

#include "hypermap/core/base/ids.hpp"
#include "hypermap/core/base/image.hpp"

#include <cstddef>

namespace hypermap {

/// So many classes have colours of their own; beyond, colours repeat.
inline constexpr std::size_t kNumClassColors = 96;

/// The colour of a class, by its id alone: the same in all images of one map.
///
/// Low ids differ most (any two of the first 24 by at least 0.1 in Oklab). All are of medium
/// lightness and clearly coloured, so that they stand out from greys, on white and on black.
[[nodiscard]] Rgb8 class_color(ClassId id);

}  // namespace hypermap
