// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Bounds that several readers set for single values. Beyond, a file is not what it says it is.
#pragma once

namespace hypermap {

/// Width or height of an image.
inline constexpr int kMaxImageSidePx = 65'535;
/// Magnitude of a coordinate, in metres or pixels.
inline constexpr double kMaxCoordinate = 1e6;

}  // namespace hypermap
