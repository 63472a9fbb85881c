// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Names of choices that several options have, in the order of the enumerators.
#pragma once

#include <string_view>

namespace hypermap {

/// ShapePolicy.
inline constexpr std::string_view kShapeNames[] = {"best", "hull", "voxels"};

}  // namespace hypermap
