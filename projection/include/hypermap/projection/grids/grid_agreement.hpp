// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How far an occupancy grid says of the floor what is true.
///
/// Ours: no source evaluates its occupancy layer.
#pragma once

#include "hypermap/projection/grids/occupancy_grid.hpp"

#include <cstddef>
#include <optional>

namespace hypermap {

struct GridAgreement {
  std::size_t free = 0;            ///< Free cells of the map where the truth is known.
  std::size_t free_right = 0;      ///< Of these: free in truth.
  std::size_t occupied = 0;        ///< Blocked cells of the map where the truth is known.
  std::size_t occupied_right = 0;  ///< Of these: one of the nine around is blocked in truth.
  std::size_t true_free = 0;       ///< Free cells of the truth.
  std::size_t free_found = 0;      ///< Of these: free in the map.
  std::size_t true_occupied = 0;   ///< Blocked cells of the truth.
  std::size_t occupied_found = 0;  ///< Of these: one of the nine around is blocked in the map.
  std::size_t occupied_free = 0;   ///< Of the true ones: free in the map, where a robot would go.

  /// None where nothing is divided.
  [[nodiscard]] std::optional<double> free_precision() const;
  [[nodiscard]] std::optional<double> free_recall() const;
  [[nodiscard]] std::optional<double> occupied_precision() const;
  [[nodiscard]] std::optional<double> occupied_recall() const;

  friend bool operator==(const GridAgreement&, const GridAgreement&) = default;
};

/// Of free cells it is asked whether just they are free; of blocked ones whether the other grid has
/// one within a cell, since a wall on an edge may lie on either side of it.
///
/// Frame: one for both. Boundary: cells of the map count where the truth is known at their middle;
/// grids of other lattices are asked at the middles of cells; beyond a grid is unknown.
/// Cost: O(cells of both).
[[nodiscard]] GridAgreement grid_agreement(const OccupancyGrid& map, const OccupancyGrid& truth);

}  // namespace hypermap
