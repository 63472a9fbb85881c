// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How likely each cell of the plane is occupied.
///
/// Source: [hypermap] 3.3.3, occupancy layer: one signed byte per cell, 0 to 100 per cent, -1
/// unknown.
#pragma once

#include "hypermap/projection/grids/grid_geometry.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace hypermap {

inline constexpr std::int8_t kFreeCell = 0;
inline constexpr std::int8_t kOccupiedCell = 100;
inline constexpr std::int8_t kUnknownCell = -1;
/// Where it is asked whether something stands in a cell: from this occupancy on.
inline constexpr std::int8_t kLeastBlocked = 50;

struct OccupancyCounts {
  std::size_t occupied = 0;  ///< Cells of 100.
  std::size_t free = 0;      ///< Cells of 0.
  std::size_t unknown = 0;   ///< Cells of -1.
  std::size_t between = 0;   ///< Cells of 1 to 99.
};

/// A grid of occupancies. A value: copy it, compare it.
class OccupancyGrid {
 public:
  OccupancyGrid() = default;  ///< Without cells.

  /// All cells `fill`. Errors: those of validate(GridGeometry); kInvalidArgument when fill is
  /// outside -1..100; kOutOfMemory.
  [[nodiscard]] static Result<OccupancyGrid> create(const GridGeometry& geometry,
                                                    std::int8_t fill = kUnknownCell);
  /// Given cells, row-major, row 0 = min y. Errors: as create; kInvalidArgument when their number
  /// is not that of the geometry or one is outside -1..100.
  [[nodiscard]] static Result<OccupancyGrid> create(const GridGeometry& geometry,
                                                    std::vector<std::int8_t> cells);

  [[nodiscard]] const GridGeometry& geometry() const noexcept { return geometry_; }
  [[nodiscard]] std::span<const std::int8_t> cells() const noexcept { return cells_; }

  /// Requires: geometry().contains(cell).
  [[nodiscard]] std::int8_t at(Cell cell) const { return cells_[geometry_.index(cell)]; }
  /// Requires: geometry().contains(cell); value in -1..100.
  void set(Cell cell, std::int8_t value);

  /// The occupancy at a point; none outside the grid.
  [[nodiscard]] std::optional<std::int8_t> at_point(const Eigen::Vector2d& point) const;
  [[nodiscard]] OccupancyCounts counts() const;

  friend bool operator==(const OccupancyGrid&, const OccupancyGrid&) = default;

 private:
  GridGeometry geometry_;
  std::vector<std::int8_t> cells_;
};

/// "Free" at 0, "Occupied" at 100, "Unknown" otherwise. Source: [hypermap] 3.3.3.
[[nodiscard]] std::string_view occupancy_string(std::int8_t occupancy);

}  // namespace hypermap
