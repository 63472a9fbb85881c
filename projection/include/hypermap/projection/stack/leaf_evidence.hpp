// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The 3D map as evidence for a stack: what its columns say for and against each class.
///
/// Ours, in the sense of [sogm] III-B: the map is one more sensor, whose grids come from its
/// voxels.
#pragma once

#include "hypermap/core/base/ids.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/leaf.hpp"
#include "hypermap/projection/grids/occupancy_projection.hpp"
#include "hypermap/projection/stack/log_odds_grid.hpp"

#include <cstddef>
#include <vector>

namespace hypermap {

/// Evidence that each cell holds the class.
struct ClassEvidenceGrid {
  ClassId id;
  LogOddsGrid grid;
};

/// A grid for each class that some occupied leaf in the band bears, by ascending id, all of one
/// geometry: that of project_occupancy with the same band and options.
///
/// A column's evidence for a class is the sum of what its leaves of that class say for it, each by
/// the share of the cell that it covers and by its height within the band, in edges of the smallest
/// leaf: voxels count, however leaves join them. A leaf says logit(p) - logit(1 / num_classes), by
/// how much more likely its class is than before anything was seen ([smap] Eq. (3.18)): of 80
/// classes one of p = 0.4 is a strong hint, no doubt. A column without such leaves but with others
/// is evidence against the class: minus what those say for their classes, or, of leaves without a
/// class, minus their occupancy. A column that project_occupancy calls free has the sum of its free
/// leaves' occupancies. All else is unknown. So signs are those of project_class_grids wherever
/// leaves say something for their class. Errors: as project_class_grids. Boundary: a map
/// without leaves, or without classes in the band, gives no grid; fewer than two classes count as
/// two, which are as likely as not. Cost: four walks over the leaves;
/// 4 bytes a cell and class besides the grids.
[[nodiscard]] Result<std::vector<ClassEvidenceGrid>> project_class_evidence(
    const LeafSource& leaves,
    const HeightBand& band = {},
    const OccupancyProjectionOptions& options = {},
    std::size_t num_classes = 2);

}  // namespace hypermap
