// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A placement refined by what all cells say that two grids know.
#pragma once

#include "grid_image.hpp"
#include "hypermap/grid_registration/grid_registration.hpp"

#include <Eigen/Core>

#include <cmath>

namespace hypermap {

/// How well a placement explains the moving image by the fixed one.
struct AreaAgreement {
  double overlap = 0.0;    ///< Share of the moving image's known cells that both know.
  double agreement = 0.0;  ///< Correlation coefficient of what both say there.

  /// What is compared between placements: a good one of a corner is no better than one of the
  /// whole.
  [[nodiscard]] double explained() const { return agreement * std::sqrt(overlap); }
};

/// Both images are smoothed by a cell first. Boundary: 0 where one image says the same everywhere.
[[nodiscard]] AreaAgreement agreement_of(const GridImage& moving,
                                         const GridImage& fixed,
                                         const Eigen::Matrix3d& fixed_from_moving);

/// The placement near `start` with the least squares of differences over the cells that both know,
/// when the moving image is taken for as sure as the fixed one (mean and spread there made alike):
/// a single reading belongs where it shows the same as a map of many. Gauss-Newton on images that
/// are smoothed by 3, then 1.5, then 0.8 cells. `start` itself where too little is common.
/// Requires: `start` is of the kind.
[[nodiscard]] Eigen::Matrix3d aligned_by_area(const GridImage& moving,
                                              const GridImage& fixed,
                                              const Eigen::Matrix3d& start,
                                              RegistrationKind kind);

}  // namespace hypermap
