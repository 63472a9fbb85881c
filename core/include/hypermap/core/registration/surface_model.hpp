// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The surfaces that frames showed, as planes to register further frames to.
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace hypermap {

/// A piece of a surface: the points near `point_m` lie along its normal within `stddev_m`.
struct SurfacePlane {
  Eigen::Vector3d point_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< Of length 1, either sign.
  double stddev_m = 0.0;
};

/// A point of a surface, and towards which side the surface looks there.
struct OrientedPoint {
  Eigen::Vector3d place_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< Of length 1; rough is enough.
};

/// Cubic cells of one size with count, mean and covariance of the points in them (voxelised
/// Gaussians), apart for the six directions that a surface may mostly look to: so the two faces of
/// a corner, and the front and back of a thin board, are two planes and not one that lies between
/// them.
///
/// A plane is fitted to the 2 x 2 x 2 cells nearest to a place: windows overlap, so that a surface
/// along the border of two cells, whose noise puts points into both, is one plane and not two that
/// lie too far apart. A value. Memory: 120 B a cell and 4 to 8 B a slot of the index, at least two
/// slots a cell.
class SurfaceGrid {
 public:
  /// Requires: cell_m > 0, max_cells >= 2.
  SurfaceGrid(double cell_m, std::size_t max_cells);

  /// Adds the points of one frame, in its order. With more than `max_cells` cells those that
  /// received no point for the longest time are dropped until about half of them are left (cells of
  /// one frame stay or go together). A cell of many points forgets the oldest ones slowly.
  /// Boundary: points farther than 2^19 cells from the origin, or not finite, are left out.
  void add(std::span<const OrientedPoint> points);

  /// The plane around `point` that looks to the same side; none when fewer than 12 points lie there
  /// or they are no plane: their standard deviation across it is more than `max_stddev_m`, or more
  /// than a third of that along its shorter side. Cost: eight look-ups.
  [[nodiscard]] std::optional<SurfacePlane> plane_at(const OrientedPoint& point,
                                                     double max_stddev_m) const;

  [[nodiscard]] std::size_t num_cells() const noexcept { return cells_.size(); }
  void clear() noexcept;

 private:
  /// Sums over the points, relative to the centre of the cell.
  struct Cell {
    std::uint64_t key = 0;
    std::uint64_t newest_frame = 0;
    double weight = 0.0;  ///< Number of points, less what was forgotten.
    Eigen::Vector3d sum_m = Eigen::Vector3d::Zero();
    Eigen::Matrix3d products_m2 = Eigen::Matrix3d::Zero();
  };
  [[nodiscard]] std::size_t slot_of(std::uint64_t key) const noexcept;
  [[nodiscard]] const Cell* find(std::uint64_t key) const noexcept;
  Cell& find_or_add(std::uint64_t key);
  void rebuild_index(std::size_t num_slots);
  void drop_oldest();

  double cell_m_;
  std::size_t max_cells_;
  std::uint64_t num_frames_ = 0;
  std::vector<Cell> cells_;
  std::vector<std::uint32_t> slots_;  ///< Positions in `cells_` plus 1 by hash of key; 0: free.
};

/// Surfaces in cells of `cell_m` and of half that: near the sensor the small ones tell the faces of
/// things apart, where noise or distance leaves too few points for these the large ones hold.
/// A value. Memory: that of two grids of at most `max_cells` cells.
class SurfaceModel {
 public:
  /// Requires: cell_m > 0, max_cells >= 2.
  SurfaceModel(double cell_m, std::size_t max_cells)
      : fine_(0.5 * cell_m, max_cells), coarse_(cell_m, max_cells) {}

  /// Adds the points of one frame, in its order. See SurfaceGrid::add.
  void add(std::span<const OrientedPoint> points);
  /// The plane around `point` of small cells, else that of large ones. See SurfaceGrid::plane_at.
  [[nodiscard]] std::optional<SurfacePlane> plane_at(const OrientedPoint& point,
                                                     double max_stddev_m) const;
  void clear() noexcept;

 private:
  SurfaceGrid fine_;
  SurfaceGrid coarse_;
};

}  // namespace hypermap
