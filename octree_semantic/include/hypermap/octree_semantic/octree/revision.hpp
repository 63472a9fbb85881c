// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Moments in the life of a map.
#pragma once

#include <cstdint>

namespace hypermap {

/// Counts the changes of one map: each frame, each relabelling, each voxel set by itself is one
/// more. 0: before anything was written. Copies go on counting from where they were made.
using Revision = std::uint64_t;

}  // namespace hypermap
