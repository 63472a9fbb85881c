// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/grid_registration/grid_registration.hpp"

#include "area_alignment.hpp"
#include "feature_matching.hpp"
#include "grid_image.hpp"
#include "hypermap/core/base/caught.hpp"
#include "hypermap/core/base/count_text.hpp"
#include "hypermap/core/base/nearest_name.hpp"
#include "hypermap/core/base/number_text.hpp"
#include "hypermap/core/base/option_rows.hpp"
#include "hypermap/projection/stack/resampling.hpp"
#include "match_consensus.hpp"
#include "rival_search.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap {
namespace {

constexpr int kMaxSideCells = 4096;
constexpr std::string_view kKindNames[] = {"rigid", "similarity", "homography"};

constexpr OptionRow kRegistrationRows[] = {
    option::choice<&GridRegistrationOptions::kind>(
        "kind",
        kKindNames,
        {.source = "[sogm] III-C.2", .effect = "What may lie between the grids."}),
    option::count<&GridRegistrationOptions::max_features>(
        "max_features", {.min = 10, .max = 5000}, {.effect = "Of each grid."}),
    option::number<&GridRegistrationOptions::inlier_cells>(
        "inlier_cells",
        option::above(0.0, 20.0),
        {.unit = "cells", .effect = "Features of a match lie so near to each other."}),
    option::count<&GridRegistrationOptions::min_inliers>(
        "min_inliers", {.min = 3, .max = 1000}, {.effect = "Fewer that agree are chance."}),
    option::number<&GridRegistrationOptions::min_overlap>(
        "min_overlap", {}, {.effect = "Least share of the moving grid's cells that both know."}),
    option::number<&GridRegistrationOptions::min_agreement>(
        "min_agreement", {}, {.effect = "Least correlation of what both say."}),
    option::number<&GridRegistrationOptions::max_rival_share>(
        "max_rival_share",
        option::above(0.0, 1.0),
        {.effect = "Another placement that explains more of this makes it ambiguous."}),
    option::number<&GridRegistrationOptions::max_shift_m>(
        "max_shift_m", option::above(0.0, 1e6), {.unit = "m", .effect = "From the guess."}),
    option::number<&GridRegistrationOptions::max_turn_rad>(
        "max_turn_rad", option::above(0.0, 3.2), {.unit = "rad", .effect = "From the guess."}),
};

Result<void> check_grid(const LogOddsGrid& grid, const char* field) {
  const GridGeometry& geometry = grid.geometry();
  if (geometry.num_cells() == 0) {
    return fail(ErrorCode::kInvalidArgument, "has no cells", field);
  }
  if (geometry.cols <= kMaxSideCells && geometry.rows <= kMaxSideCells) return {};
  return fail(ErrorCode::kLimit,
              "must have at most 4096 cells a side, has " + std::to_string(geometry.cols) + " x " +
                  std::to_string(geometry.rows),
              field);
}

Result<void> check_guess(const Eigen::Matrix3d& guess) {
  if (guess.allFinite() && std::abs(guess.determinant()) > 0.0) return {};
  return fail(ErrorCode::kInvalidArgument, "must be finite and have an inverse", "guess");
}

Unexpected not_registered(std::string why, std::string field) {
  return fail(ErrorCode::kNotFound, std::move(why), std::move(field));
}

/// The grid at another resolution, where it lies.
Result<LogOddsGrid> at_resolution(const LogOddsGrid& grid, double resolution_m) {
  GridGeometry geometry = grid.geometry();
  if (geometry.resolution_m == resolution_m) return grid;
  const double factor = geometry.resolution_m / resolution_m;
  constexpr double kMostCells = 1e6;
  geometry.resolution_m = resolution_m;
  geometry.cols = static_cast<int>(std::min(std::ceil(geometry.cols * factor), kMostCells));
  geometry.rows = static_cast<int>(std::min(std::ceil(geometry.rows * factor), kMostCells));
  return resampled(grid, geometry, Eigen::Matrix3d(Eigen::Matrix3d::Identity()));
}

double turn_of(const Eigen::Matrix3d& placement) {
  return std::atan2(placement(1, 0) - placement(0, 1), placement(0, 0) + placement(1, 1));
}

/// Two grids of one resolution, ready to be compared. Placements are in cells.
class GridPair {
 public:
  GridPair(const LogOddsGrid& moving,
           const LogOddsGrid& fixed,
           const GridRegistrationOptions& options,
           const Eigen::Matrix3d& guess)
      : moving_(image_of(moving)),
        fixed_(image_of(fixed)),
        options_(options),
        resolution_m_(fixed.geometry().resolution_m),
        moving_frame_(frame_from_cells(moving.geometry())),
        fixed_frame_(frame_from_cells(fixed.geometry())),
        guess_(fixed_frame_.inverse() * guess * moving_frame_) {}

  /// Errors: kNotFound, with the reason.
  [[nodiscard]] Result<GridRegistration> registered() const {
    HYPERMAP_TRY(check_known());
    const FeatureMatches found = matched_features(moving_, fixed_, options_.max_features);
    HYPERMAP_TRY(check_features(found));
    const std::vector<Consensus> candidates = best_consensuses(found.matches, span(), consensus());
    HYPERMAP_TRY(check_inliers(candidates, found));
    const Consensus best = best_by_area(candidates, found.matches);
    const AreaAgreement area = agreement_of(moving_, fixed_, best.fixed_from_moving);
    HYPERMAP_TRY(check_area(best, area));
    const double rival_share = best_rival_share(moving_, fixed_, best.fixed_from_moving, allowed());
    HYPERMAP_TRY(check_rivals(rival_share));
    const Eigen::Matrix3d in_frames =
        fixed_frame_ * best.fixed_from_moving * moving_frame_.inverse();
    return GridRegistration{.fixed_from_moving = in_frames / in_frames(2, 2),
                            .num_matches = found.matches.size(),
                            .num_inliers = best.num_inliers,
                            .residual_m = best.rms * resolution_m_,
                            .overlap = area.overlap,
                            .agreement = area.agreement,
                            .rival_share = rival_share};
  }

 private:
  [[nodiscard]] Result<void> check_known() const {
    const bool both = moving_.known.maxCoeff() > 0.0F && fixed_.known.maxCoeff() > 0.0F;
    if (both) return {};
    return not_registered("a grid knows nothing", "features");
  }

  [[nodiscard]] Result<void> check_features(const FeatureMatches& found) const {
    const auto least = static_cast<std::size_t>(options_.min_inliers);
    if (found.num_moving >= least && found.num_fixed >= least) return {};
    return not_registered("too few features: " + std::to_string(found.num_moving) + " and " +
                              std::to_string(found.num_fixed) + ", both must have at least " +
                              std::to_string(least),
                          "features");
  }

  [[nodiscard]] Result<void> check_inliers(const std::vector<Consensus>& candidates,
                                           const FeatureMatches& found) const {
    const std::size_t most = candidates.empty() ? 0 : candidates.front().num_inliers;
    if (most >= static_cast<std::size_t>(options_.min_inliers)) return {};
    return not_registered("of " + count_text(found.matches.size(), "pair") +
                              " of similar features " + std::to_string(most) +
                              " agree on a placement, must be at least " +
                              std::to_string(options_.min_inliers),
                          "inliers");
  }

  [[nodiscard]] Result<void> check_area(const Consensus& best, const AreaAgreement& area) const {
    if (!allowed()(best.fixed_from_moving)) {
      return not_registered("the best placement is farther from the guess than allowed", "inliers");
    }
    if (area.overlap < options_.min_overlap) {
      return not_registered("share of common cells must be at least " +
                                number_text(options_.min_overlap) + ", is " +
                                number_text(area.overlap),
                            "overlap");
    }
    if (area.agreement >= options_.min_agreement) return {};
    return not_registered("correlation must be at least " + number_text(options_.min_agreement) +
                              ", is " + number_text(area.agreement),
                          "agreement");
  }

  [[nodiscard]] Result<void> check_rivals(double rival_share) const {
    if (rival_share <= options_.max_rival_share) return {};
    return not_registered("ambiguous: another placement explains " + number_text(rival_share) +
                              " of what the best one does, must be at most " +
                              number_text(options_.max_rival_share),
                          "rivals");
  }

  /// The candidate that, refined, explains most; of those with enough inliers.
  [[nodiscard]] Consensus best_by_area(const std::vector<Consensus>& candidates,
                                       const std::vector<FeatureMatch>& matches) const {
    Eigen::Matrix3d best = candidates.front().fixed_from_moving;
    double explained = -1.0;
    for (const Consensus& candidate : candidates) {
      if (candidate.num_inliers < static_cast<std::size_t>(options_.min_inliers)) continue;
      const Eigen::Matrix3d refined =
          aligned_by_area(moving_, fixed_, candidate.fixed_from_moving, options_.kind);
      const double by_this = agreement_of(moving_, fixed_, refined).explained();
      if (by_this <= explained) continue;
      best = refined;
      explained = by_this;
    }
    return consensus_of(best, matches, options_.inlier_cells);
  }

  [[nodiscard]] ConsensusOptions consensus() const {
    return {.has_scale = options_.kind != RegistrationKind::kRigid,
            .inlier_cells = options_.inlier_cells,
            .is_allowed = allowed()};
  }

  /// Within the limits about the guess.
  [[nodiscard]] PlacementFilter allowed() const {
    const Eigen::Vector2d middle = middle_of_known(moving_);
    const double max_shift = options_.max_shift_m / resolution_m_;
    return [this, middle, max_shift](const Eigen::Matrix3d& placement) {
      const double shift = (moved(placement, middle) - moved(guess_, middle)).norm();
      const double turn =
          std::remainder(turn_of(placement) - turn_of(guess_), 2.0 * std::numbers::pi);
      return shift <= max_shift && std::abs(turn) <= options_.max_turn_rad;
    };
  }

  [[nodiscard]] double span() const { return 0.5 * std::hypot(moving_.cols(), moving_.rows()); }

  GridImage moving_;
  GridImage fixed_;
  GridRegistrationOptions options_;
  double resolution_m_;
  Eigen::Matrix3d moving_frame_;
  Eigen::Matrix3d fixed_frame_;
  Eigen::Matrix3d guess_;
};

}  // namespace

const OptionTable& option_table(const GridRegistrationOptions&) {
  static constexpr OptionTable kTable{kRegistrationRows};
  return kTable;
}

Result<void> validate(const GridRegistrationOptions& options) {
  return check_options(options);
}

Result<GridRegistration> register_grids(const LogOddsGrid& moving,
                                        const LogOddsGrid& fixed,
                                        const GridRegistrationOptions& options,
                                        const Eigen::Matrix3d& guess) {
  HYPERMAP_TRY(validate(options));
  HYPERMAP_TRY(check_guess(guess));
  HYPERMAP_TRY(check_grid(fixed, "fixed"));
  HYPERMAP_TRY(check_grid(moving, "moving"));
  return guarded(ErrorCode::kUnavailable, "the registration", [&]() -> Result<GridRegistration> {
    HYPERMAP_ASSIGN_OR_RETURN(const LogOddsGrid even,
                              at_resolution(moving, fixed.geometry().resolution_m));
    HYPERMAP_TRY(check_grid(even, "moving"));
    return GridPair(even, fixed, options, guess).registered();
  });
}

Result<RegisteredFusion> fuse_registered(GridStack& stack,
                                         const SensorGrid& sensor,
                                         const std::string& reference,
                                         const GridRegistrationOptions& options,
                                         const Eigen::Matrix3d& stack_from_sensor) {
  const auto layer = stack.layers().find(reference);
  if (layer == stack.layers().end()) {
    std::vector<std::string> known;
    for (const auto& [name, grid] : stack.layers()) known.push_back(name);
    return fail(ErrorCode::kNotFound, nothing_named("layer", reference, known), "reference");
  }
  HYPERMAP_ASSIGN_OR_RETURN(const GridRegistration registration,
                            register_grids(sensor.grid, layer->second, options, stack_from_sensor));
  HYPERMAP_ASSIGN_OR_RETURN(const std::size_t num_reached,
                            stack.fuse(sensor, registration.fixed_from_moving));
  return RegisteredFusion{registration, num_reached};
}

}  // namespace hypermap
