// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Classes that a map speaks of and has no names for.
#pragma once

#include "hypermap/io/archive/map_archive.hpp"

#include <string>

namespace hypermap {

/// Gives each class that octree and objects speak of a name: class_<id> where it has none. What was
/// done, for people; empty: nothing.
[[nodiscard]] std::string name_absent_classes(MapArchive& archive);

}  // namespace hypermap
