// SPDX-License-Identifier: BSD-3-Clause
#include "match_consensus.hpp"

#include "hypermap/core/base/random_numbers.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <optional>

namespace hypermap {
namespace {

constexpr int kNumDraws = 6000;
constexpr std::size_t kMaxKept = 6;
constexpr double kMinBaseCells = 8.0;  ///< Between the places of a pair, so that turns are exact.

/// Of each feature that has a match within `inlier_cells`, the nearest.
std::vector<FeatureMatch> inliers_of(const Eigen::Matrix3d& fixed_from_moving,
                                     std::span<const FeatureMatch> matches,
                                     double inlier_cells) {
  std::vector<FeatureMatch> inliers;
  double nearest = 0.0;
  for (const FeatureMatch& match : matches) {
    const double distance = (moved(fixed_from_moving, match.moving) - match.fixed).norm();
    if (!(distance <= inlier_cells)) continue;
    const bool is_same = !inliers.empty() && inliers.back().feature == match.feature;
    if (is_same && distance >= nearest) continue;
    if (is_same) inliers.pop_back();
    inliers.push_back(match);
    nearest = distance;
  }
  return inliers;
}

/// By least squares: with points as complex numbers from their means, the turn is that of the sum
/// of fixed times conjugated moving. Source: S. Umeyama, "Least-squares estimation of
/// transformation parameters between two point patterns", 1991, in the plane.
Eigen::Matrix3d fitted(std::span<const FeatureMatch> matches, bool has_scale) {
  Eigen::Vector2d moving_mean = Eigen::Vector2d::Zero();
  Eigen::Vector2d fixed_mean = Eigen::Vector2d::Zero();
  for (const FeatureMatch& match : matches) {
    moving_mean += match.moving / static_cast<double>(matches.size());
    fixed_mean += match.fixed / static_cast<double>(matches.size());
  }
  double along = 0.0;
  double across = 0.0;
  double squares = 0.0;
  for (const FeatureMatch& match : matches) {
    const Eigen::Vector2d moving = match.moving - moving_mean;
    const Eigen::Vector2d fixed = match.fixed - fixed_mean;
    along += moving.dot(fixed);
    across += moving.x() * fixed.y() - moving.y() * fixed.x();
    squares += moving.squaredNorm();
  }
  const double scale = has_scale && squares > 0.0 ? std::hypot(along, across) / squares : 1.0;
  const Eigen::Matrix2d turn =
      scale * Eigen::Rotation2Dd(std::atan2(across, along)).toRotationMatrix();
  Eigen::Matrix3d placement = Eigen::Matrix3d::Identity();
  placement.topLeftCorner<2, 2>() = turn;
  placement.topRightCorner<2, 1>() = fixed_mean - turn * moving_mean;
  return placement;
}

std::optional<Eigen::Matrix3d> proposed_by(const FeatureMatch& a,
                                           const FeatureMatch& b,
                                           const ConsensusOptions& options) {
  const double moving_base = (a.moving - b.moving).norm();
  const double fixed_base = (a.fixed - b.fixed).norm();
  if (moving_base < kMinBaseCells || fixed_base < kMinBaseCells) return std::nullopt;
  const double scale = fixed_base / moving_base;
  const bool fits = options.has_scale ? scale > 0.5 && scale < 2.0
                                      : std::abs(fixed_base - moving_base) <= options.inlier_cells;
  if (!fits) return std::nullopt;
  const FeatureMatch pair[] = {a, b};
  return fitted(pair, options.has_scale);
}

/// A placement that was drawn, and what it found at once.
struct Proposal {
  Eigen::Matrix3d fixed_from_moving;
  std::size_t num_inliers = 0;
};

std::vector<Proposal> drawn_proposals(std::span<const FeatureMatch> matches,
                                      const ConsensusOptions& options) {
  std::vector<Proposal> proposals;
  CounterRng random(0, matches.size());
  const auto count = static_cast<std::uint32_t>(matches.size());
  for (int draw = 0; draw < kNumDraws; ++draw) {
    const FeatureMatch& a = matches[random.below(count)];
    const FeatureMatch& b = matches[random.below(count)];
    const auto proposed = proposed_by(a, b, options);
    if (!proposed || !options.is_allowed(*proposed)) continue;
    const std::size_t num = inliers_of(*proposed, matches, options.inlier_cells).size();
    if (num >= 3) proposals.push_back({*proposed, num});
  }
  std::ranges::stable_sort(proposals, std::ranges::greater{}, &Proposal::num_inliers);
  return proposals;
}

/// Fitted to all that agree, again and again.
Eigen::Matrix3d settled(Eigen::Matrix3d placement,
                        std::span<const FeatureMatch> matches,
                        const ConsensusOptions& options) {
  constexpr int kMaxRounds = 5;
  for (int round = 0; round < kMaxRounds; ++round) {
    const auto inliers = inliers_of(placement, matches, options.inlier_cells);
    if (inliers.size() < 3) break;
    placement = fitted(inliers, options.has_scale);
  }
  return placement;
}

Eigen::Vector2d middle_of(std::span<const FeatureMatch> matches) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const FeatureMatch& match : matches) sum += match.moving;
  return sum / static_cast<double>(matches.size());
}

}  // namespace

Consensus consensus_of(const Eigen::Matrix3d& fixed_from_moving,
                       std::span<const FeatureMatch> matches,
                       double inlier_cells) {
  const auto inliers = inliers_of(fixed_from_moving, matches, inlier_cells);
  double squares = 0.0;
  for (const FeatureMatch& match : inliers) {
    squares += (moved(fixed_from_moving, match.moving) - match.fixed).squaredNorm();
  }
  const double count = std::max<double>(1.0, static_cast<double>(inliers.size()));
  return {fixed_from_moving, inliers.size(), std::sqrt(squares / count)};
}

std::vector<Consensus> best_consensuses(std::span<const FeatureMatch> matches,
                                        double span_cells,
                                        const ConsensusOptions& options) {
  std::vector<Consensus> kept;
  if (matches.size() < 2) return kept;
  const Eigen::Vector2d middle = middle_of(matches);
  const Eigen::Vector2d aside = middle + Eigen::Vector2d(span_cells, 0.0);
  const auto is_near = [&](const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
    const double near = 2.0 * options.inlier_cells;
    return (moved(a, middle) - moved(b, middle)).norm() < near &&
           (moved(a, aside) - moved(b, aside)).norm() < near;
  };
  const auto is_kept = [&](const Eigen::Matrix3d& placement) {
    return std::ranges::any_of(
        kept, [&](const Consensus& known) { return is_near(known.fixed_from_moving, placement); });
  };
  for (const Proposal& proposal : drawn_proposals(matches, options)) {
    if (kept.size() == kMaxKept) break;
    if (is_kept(proposal.fixed_from_moving)) continue;
    const Eigen::Matrix3d better = settled(proposal.fixed_from_moving, matches, options);
    if (is_kept(better)) continue;
    kept.push_back(consensus_of(better, matches, options.inlier_cells));
  }
  std::ranges::stable_sort(kept, std::ranges::greater{}, &Consensus::num_inliers);
  return kept;
}

}  // namespace hypermap
