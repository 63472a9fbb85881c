// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What a grid of log-odds says on the cells of another grid: of another pose, size and resolution,
/// or seen under a homography.
///
/// Source: [sogm] III-C.1, Eq. (3) to (5), figure 3.
/// Erratum: f of Eq. (4) is called an approximation of the odds model of Eq. (3). With alpha =
/// ln((1 - e0) / e0) and R mapped to [0, 1] it is the model itself; and as the weights of Eq. (5)
/// sum to 1, alpha cancels: biodds interpolation is bilinear interpolation of clamped log-odds,
/// which is what is computed here. The tests hold it against both equations as printed.
#pragma once

#include "hypermap/core/base/log_odds.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/projection/grids/grid_geometry.hpp"
#include "hypermap/projection/stack/log_odds_grid.hpp"

#include <Eigen/Core>

#include <cstdint>

namespace hypermap {

struct OptionTable;

/// How a value between the centres of cells is had.
enum class ResamplingRule : std::uint8_t {
  kNearest,   ///< That of the cell that the point lies in.
  kBilinear,  ///< Probabilities are linear between the centres.
  kBiodds,    ///< The number of readings is: [sogm] Eq. (5).
};

struct ResamplingOptions {
  ResamplingRule rule = ResamplingRule::kBiodds;  ///< Between the centres of cells.
  /// No cell counts as surer than this, or than 1 minus it, whatever the rule. e0 of [sogm] Eq.
  /// (3).
  Probability epsilon{1e-6};
  friend bool operator==(const ResamplingOptions&, const ResamplingOptions&) = default;
};

/// Errors: kInvalidArgument naming the field.
[[nodiscard]] Result<void> validate(const ResamplingOptions& options);
[[nodiscard]] const OptionTable& option_table(const ResamplingOptions& options);

/// Four cells whose centres make a square; the first digit counts along x, the second along y.
struct CellSquare {
  LogOdds l00;
  LogOdds l10;
  LogOdds l01;
  LogOdds l11;
};

/// The value at (x, y) between the centres, both in [0, 1].
///
/// Source: [sogm] Eq. (5). Monotone in each cell, and within the smallest and largest of the four.
/// Boundary: x or y of 0.5 is the upper cell's by kNearest. Requires: options are valid.
[[nodiscard]] LogOdds interpolated(const CellSquare& square,
                                   double x,
                                   double y,
                                   const ResamplingOptions& options);

/// The grid on the cells of `target`, each taking the value at its centre.
///
/// A cell of `target` that covers more than one cell of the source takes the mean of all that it
/// covers, each by its share (kNearest still takes the one at its centre): then log-odds times
/// area, summed over the cells, stay what they were. Unknown cells, and all that is outside the
/// source, have log-odds 0: they add nothing and are never taken for a number. Frame:
/// `target_from_source` takes points of the source's frame (x, y, 1) to the target's frame, up to a
/// factor: a pose in the plane (`Isometry2d::matrix()`) or any other homography. Boundary: what
/// lies beyond the homography's horizon, on the other side than the middle of the source, is
/// unknown. Cells are rounded to steps. Errors: kInvalidArgument when a grid has no cells, the
/// homography is not finite, has no inverse or has the middle of the source at its horizon, or the
/// grids do not meet; those of validate(GridGeometry) and validate(ResamplingOptions);
/// kOutOfMemory. Cost: O(cells of the target that meet the source + cells of the source).
[[nodiscard]] Result<LogOddsGrid> resampled(const LogOddsGrid& source,
                                            const GridGeometry& target,
                                            const Eigen::Matrix3d& target_from_source,
                                            const ResamplingOptions& options = {});

}  // namespace hypermap
