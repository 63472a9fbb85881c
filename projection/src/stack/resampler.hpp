// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The cells of another grid, one at a time.
#pragma once

#include "hypermap/projection/stack/resampling.hpp"

#include <Eigen/Core>

#include <array>
#include <optional>

namespace hypermap {

/// Cells from `first` to before `end`.
struct CellWindow {
  Cell first;
  Cell end;

  [[nodiscard]] bool is_empty() const noexcept {
    return first.col >= end.col || first.row >= end.row;
  }
};

/// What a grid says on cells of another one. Refers to the source.
class Resampler {
 public:
  /// Errors: those of `resampled` but kOutOfMemory. Requires: the source outlives it.
  [[nodiscard]] static Result<Resampler> create(const LogOddsGrid& source,
                                                const GridGeometry& target,
                                                const Eigen::Matrix3d& target_from_source,
                                                const ResamplingOptions& options);

  /// All other cells of the target are unknown. Never empty.
  [[nodiscard]] const CellWindow& window() const noexcept { return window_; }
  [[nodiscard]] LogOddsSteps at(Cell target) const;

 private:
  using Quad = std::array<Eigen::Vector2d, 4>;

  Resampler(const LogOddsGrid& source, const ResamplingOptions& options);
  [[nodiscard]] std::optional<Eigen::Vector2d> in_source(double col, double row) const;
  [[nodiscard]] std::optional<Quad> quad_of(Cell target) const;
  [[nodiscard]] LogOdds value(int col, int row) const;
  [[nodiscard]] LogOdds at_point(const Eigen::Vector2d& cells) const;
  [[nodiscard]] LogOdds mean_over(const Quad& quad, double area) const;

  const LogOddsGrid* source_;
  ResamplingOptions options_;
  LogOdds bound_;
  Eigen::Matrix3d source_from_lattice_ = Eigen::Matrix3d::Identity();  ///< Both in cells.
  Cell first_;  ///< Of the target, on that lattice.
  CellWindow window_;
};

}  // namespace hypermap
