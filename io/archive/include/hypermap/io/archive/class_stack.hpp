// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What the 3D map says of each class, as a semantic occupancy grid.
///
/// Source: [sogm] III-B: the 3D map is one more sensor (leaf_evidence.hpp).
#pragma once

#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/leaf.hpp"
#include "hypermap/core/vocabulary/class_vocabulary.hpp"
#include "hypermap/projection/grids/occupancy_projection.hpp"
#include "hypermap/projection/stack/grid_stack.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace hypermap {

/// The layer of an archive that holds the stack of its classes.
inline constexpr std::string_view kStackLayer = "stack";

struct ClassStackRequest {
  HeightBand band = {};  ///< Voxels that count, by heights of the map.
  std::vector<std::string> classes =
      {};                           ///< Only what these ask for (asked_names); all when empty.
  ClassVocabulary vocabulary = {};  ///< By which they are understood.
  GridStackOptions options = {};    ///< Of the stack; its frame is that of the leaves.
};

/// A layer for each class that some leaf in the band bears: project_class_evidence, as it is, of as
/// many classes as are registered.
///
/// Boundary: no layers where no leaf in the band has one of the classes. Errors: kNotFound when no
/// leaf lies in the band or a class is not known; those of project_class_evidence and
/// GridStack::create.
[[nodiscard]] Result<GridStack> class_stack(const LeafSource& leaves,
                                            const ClassRegistry& classes,
                                            const ClassStackRequest& request);

}  // namespace hypermap
