// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How a grid lies to another one of the same place, by what both show: a sensor's grid to the
/// stack's surroundings, or two sensors' grids to each other.
///
/// Source: [sogm] III-C.2, scan matching: ORB features of both, matched by the distance of pairs,
/// give a homography. E. Rublee et al., "ORB: an efficient alternative to SIFT or SURF", 2011.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/projection/stack/grid_stack.hpp"
#include "hypermap/projection/stack/log_odds_grid.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <string>

namespace hypermap {

struct OptionTable;

/// What may lie between two grids.
enum class RegistrationKind : std::uint8_t {
  kRigid,       ///< A shift and a turn.
  kSimilarity,  ///< And a factor of scale.
  kHomography,  ///< Any homography near a similarity, as a wrong tilt of a camera makes.
};

struct GridRegistrationOptions {
  RegistrationKind kind = RegistrationKind::kRigid;  ///< What may lie between the grids.
  int max_features = 500;                            ///< Of each grid.
  double inlier_cells = 2.0;   ///< Features of a match lie so near to each other. Unit: cell.
  int min_inliers = 6;         ///< Fewer matches that agree are chance.
  double min_overlap = 0.3;    ///< Least share of the moving grid's known cells that both know.
  double min_agreement = 0.6;  ///< Least correlation of what both say there.
  /// Another placement that explains as much, as a share of what the best one does, makes it
  /// ambiguous.
  double max_rival_share = 0.9;
  /// From the guess, at the middle of what the moving grid knows: no other placements are
  /// considered, nor as rivals.
  double max_shift_m = 1000.0;
  double max_turn_rad = 3.2;  ///< The same of the turn; half a turn is any.
  friend bool operator==(const GridRegistrationOptions&, const GridRegistrationOptions&) = default;
};

/// Errors: kInvalidArgument naming the field.
[[nodiscard]] Result<void> validate(const GridRegistrationOptions& options);
[[nodiscard]] const OptionTable& option_table(const GridRegistrationOptions& options);

struct GridRegistration {
  /// Takes points (x, y, 1) of the moving grid's frame to the fixed one's; as `resampled` asks.
  Eigen::Matrix3d fixed_from_moving = Eigen::Matrix3d::Identity();
  std::size_t num_matches = 0;  ///< Pairs of similar features.
  /// Of these, that lie together at the result; fewer than proposed it, where noise moved features.
  std::size_t num_inliers = 0;
  double residual_m = 0.0;   ///< Root mean square of their distances.
  double overlap = 0.0;      ///< Share of the moving grid's known cells that both know.
  double agreement = 0.0;    ///< Correlation of what both say there, up to 1.
  double rival_share = 0.0;  ///< What the best other placement explains, of what this one does.
};

/// Finds the placement of `moving` in which both grids say the same.
///
/// Matches of ORB features of what is occupied propose placements; each is refined on the cells
/// that both know, below the size of a cell, by least squares (Gauss-Newton). The one is taken that
/// explains most: its agreement times its overlap. It is then held against all others that are a
/// whole number of cells, more than 5, or of quarter turns away, by correlation.
/// Frame: `guess` as the result; only its limits use it. Deviation: the paper takes a homography
/// straight from the matches, which is good to a cell or two, and never refuses. Errors:
/// kInvalidArgument when a grid has no cells or `guess` is no homography, and those of validate;
/// kNotFound, naming the field, with the reason: too few features (`features`), matches that agree
/// (`inliers`), common cells (`overlap`) or agreement (`agreement`), several placements about as
/// good, as in a corridor or a symmetric room (`rivals`); kLimit for a grid over 4096 cells a side;
/// kOutOfMemory. Boundary: grids of different resolutions are compared in that of `fixed`. Same
/// input, same result; no random numbers but seeded ones. Cost: a second for grids of 512 x 512.
[[nodiscard]] Result<GridRegistration> register_grids(
    const LogOddsGrid& moving,
    const LogOddsGrid& fixed,
    const GridRegistrationOptions& options = {},
    const Eigen::Matrix3d& guess = Eigen::Matrix3d::Identity());

/// How a fused grid was placed, and how many cells it reached.
struct RegisteredFusion {
  GridRegistration registration;
  std::size_t num_reached = 0;
};

/// Registers what `sensor` says to a layer of the stack, `reference`, and fuses it where it
/// belongs.
///
/// Frame: `stack_from_sensor` is where the sensor thinks it is: the guess. Errors: kNotFound when
/// the stack has no such layer; those of register_grids and GridStack::fuse; then the stack is as
/// it was.
[[nodiscard]] Result<RegisteredFusion> fuse_registered(
    GridStack& stack,
    const SensorGrid& sensor,
    const std::string& reference,
    const GridRegistrationOptions& options = {},
    const Eigen::Matrix3d& stack_from_sensor = Eigen::Matrix3d::Identity());

}  // namespace hypermap
