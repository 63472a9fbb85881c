// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Upright motions of a map as bijections between the cells of a grid.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <optional>

namespace hypermap {

/// A turn about z and a shift that takes each cell to one cell, no two to the same, such that the
/// motion back takes each to where it was. Unit: the edge of a cell; the grid's corner is at 0.
///
/// A quarter turn is exact; what is left of the turn, at most 45 degrees, is three shears by whole
/// cells about the point of the plane that it leaves in place; a shift is rounded. A cell comes
/// near where its centre goes by the motion itself: within 1.07 in x, 0.86 in y (a quarter turn
/// may exchange them) and 0.5 in z.
/// Source: Paeth (Graphics Interface 1986), a rotation as three shears; Andres (DGCI 1996), that
/// rounded shears are a bijection of the grid.
class LatticeMotion {
 public:
  /// None for a motion that tilts z.
  [[nodiscard]] static std::optional<LatticeMotion> of(const Eigen::Isometry3d& new_from_old);

  /// Where the cell comes whose centre this is, as a centre again: whole numbers and a half.
  [[nodiscard]] Eigen::Vector3d operator()(const Eigen::Vector3d& centre) const noexcept;

 private:
  LatticeMotion() = default;
  void turn_quarters(Eigen::Vector3d& centre) const noexcept;
  void shear(Eigen::Vector3d& centre) const noexcept;

  int quarters_ = 0;            ///< 0 .. 3, counterclockwise.
  bool quarters_first_ = true;  ///< Else last, so that a motion back undoes the steps in turn.
  double shear_x_ = 0.0;        ///< Columns by row, before and after ...
  double shear_y_ = 0.0;        ///< ... rows by column; both 0 where nothing is left to turn.
  Eigen::Vector2d fixed_ = Eigen::Vector2d::Zero();  ///< What the shears leave in place.
  Eigen::Vector3d shift_ = Eigen::Vector3d::Zero();  ///< Whole cells.
};

}  // namespace hypermap
