// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A grid of log-odds as an image of numbers from -1, free, to 1, occupied.
#pragma once

#include "hypermap/projection/stack/log_odds_grid.hpp"

#include <Eigen/Geometry>

namespace hypermap {

/// Row r, column c is the cell of that row and column.
using Plane = Eigen::Array<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Unknown cells have value 0 and known 0; others known 1.
struct GridImage {
  Plane value;  ///< 2 p - 1.
  Plane known;  ///< A share, once it is smoothed.

  [[nodiscard]] int cols() const noexcept { return static_cast<int>(value.cols()); }
  [[nodiscard]] int rows() const noexcept { return static_cast<int>(value.rows()); }
};

[[nodiscard]] GridImage image_of(const LogOddsGrid& grid);

/// The Gaussian mean of the known cells around each known one. Requires: sigma_cells > 0.
[[nodiscard]] GridImage smoothed(const GridImage& image, double sigma_cells);
/// The Gaussian mean around each cell; what is outside counts as 0.
[[nodiscard]] Plane blurred(const Plane& plane, double sigma_cells);

/// A value between the centres of cells, and how it changes along columns and rows.
struct PlaneSample {
  double value = 0.0;
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();
};

/// Bilinear at (column, row). Requires: is_inside.
[[nodiscard]] PlaneSample sampled(const Plane& plane, const Eigen::Vector2d& at);
/// Whether four cells surround the point.
[[nodiscard]] bool is_inside(const Plane& plane, const Eigen::Vector2d& at);

/// Takes (column, row, 1) to points of the grid's frame; whole numbers are centres of cells.
[[nodiscard]] Eigen::Matrix3d frame_from_cells(const GridGeometry& geometry);

/// The middle of the known cells, (column, row). Requires: there are such.
[[nodiscard]] Eigen::Vector2d middle_of_known(const GridImage& image);

/// A point under a homography. Requires: not at its horizon.
[[nodiscard]] inline Eigen::Vector2d moved(const Eigen::Matrix3d& homography,
                                           const Eigen::Vector2d& point) {
  return (homography * point.homogeneous()).hnormalized();
}

}  // namespace hypermap
