// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How sure it is that each cell of the plane is occupied, as log-odds: what sensors say, and what
/// a layer of a stack has learnt from them.
///
/// Source: [sogm] III-A, III-B.
#pragma once

#include "hypermap/core/base/log_odds.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/projection/grids/occupancy_grid.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace hypermap {

/// Log-odds as a whole number of steps of 0.001, so that sums are the same in any order.
using LogOddsSteps = std::int16_t;

/// The most that a cell can say: l = 13.815, a probability within 1e-6 of certainty.
inline constexpr LogOddsSteps kMaxLogOddsSteps = 13'815;

/// The nearest number of steps; half a step goes away from 0. Boundary: what is beyond
/// kMaxLogOddsSteps, infinity too, becomes that. Requires: not NaN.
[[nodiscard]] LogOddsSteps to_steps(LogOdds log_odds) noexcept;
[[nodiscard]] constexpr LogOdds from_steps(int steps) noexcept {
  return LogOdds(steps / 1000.0);
}

/// Log-odds of each cell. A cell of log-odds 0 is unknown: nothing was said of it, or as much for
/// as against. A value: copy it, compare it.
class LogOddsGrid {
 public:
  LogOddsGrid() = default;  ///< Without cells.

  /// All cells unknown. Errors: those of validate(GridGeometry); kOutOfMemory.
  [[nodiscard]] static Result<LogOddsGrid> create(const GridGeometry& geometry);
  /// Given cells, row-major, row 0 = min y. Errors: as above; kInvalidArgument when their number is
  /// not that of the geometry or one is beyond kMaxLogOddsSteps.
  [[nodiscard]] static Result<LogOddsGrid> create(const GridGeometry& geometry,
                                                  std::vector<LogOddsSteps> cells);
  /// Probabilities of occupancy, 0.5 for unknown. Errors: as above; kInvalidArgument for one that
  /// is not in [0, 1], NaN included. Boundary: 0 and 1 become the most that a cell can say.
  [[nodiscard]] static Result<LogOddsGrid> of_probabilities(const GridGeometry& geometry,
                                                            std::span<const double> probabilities);
  /// Per cents of occupancy; -1 is unknown, and so is 50. Errors: kOutOfMemory.
  [[nodiscard]] static Result<LogOddsGrid> of_occupancy(const OccupancyGrid& occupancy);

  [[nodiscard]] const GridGeometry& geometry() const noexcept { return geometry_; }
  [[nodiscard]] std::span<const LogOddsSteps> cells() const noexcept { return cells_; }

  /// Requires, for these: geometry().contains(cell).
  [[nodiscard]] LogOddsSteps at(Cell cell) const { return cells_[geometry_.index(cell)]; }
  [[nodiscard]] LogOdds log_odds(Cell cell) const { return from_steps(at(cell)); }
  /// Requires: no more than kMaxLogOddsSteps either way.
  void set(Cell cell, LogOddsSteps steps);

  [[nodiscard]] std::size_t num_known() const noexcept;

  friend bool operator==(const LogOddsGrid&, const LogOddsGrid&) = default;

 private:
  GridGeometry geometry_;
  std::vector<LogOddsSteps> cells_;
};

/// The grid as others know it: the probability in whole per cents, -1 where it is unknown.
/// Errors: kOutOfMemory.
[[nodiscard]] Result<OccupancyGrid> to_occupancy(const LogOddsGrid& grid);

}  // namespace hypermap
