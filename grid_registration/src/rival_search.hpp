// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Whether another placement than the best explains about as much.
#pragma once

#include "grid_image.hpp"
#include "match_consensus.hpp"

#include <Eigen/Core>

namespace hypermap {

/// Nearer placements are the best one itself. Unit: cell.
inline constexpr int kRivalDistanceCells = 5;

/// What the best rival explains (AreaAgreement::explained) as a share of what `placement` does:
/// moved by whole cells, farther than kRivalDistanceCells along a column or row, and turned by no,
/// one, two or three quarters, as far as `is_allowed`, where three tenths of the moving image's
/// known cells are common.
///
/// All shifts at once, by masked correlation. Source: D. Padfield, "Masked object registration in
/// the Fourier domain", 2012. Images over 256 cells a side are compared at half, a quarter, ... of
/// their resolution. Boundary: 0 where there is no rival. Cost: 4 times 12 Fourier transforms.
[[nodiscard]] double best_rival_share(const GridImage& moving,
                                      const GridImage& fixed,
                                      const Eigen::Matrix3d& placement,
                                      const PlacementFilter& is_allowed);

}  // namespace hypermap
