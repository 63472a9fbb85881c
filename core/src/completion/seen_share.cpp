// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/completion/completion.hpp"
#include "hypermap/core/objects/object_outline.hpp"
#include "seen_directions.hpp"

#include <algorithm>
#include <bitset>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace hypermap {
namespace {

constexpr double kFacedCosine = 0.5;  ///< Of 60 degrees.

}  // namespace

std::vector<Eigen::Vector2d> seen_directions(const ObservationLog& log) {
  std::bitset<ObservationLog::kNumBearingBins> bins;
  for (const ObservationLogSummary& s : log.state().summaries) {
    if (s.kind == ObservationKind::kDetection) bins.set(s.bearing_bin);
  }
  std::vector<Eigen::Vector2d> directions;
  for (std::size_t bin = 0; bin < bins.size(); ++bin) {
    if (!bins.test(bin)) continue;
    const double bearing_rad = 2.0 * std::numbers::pi * (static_cast<double>(bin) + 0.5) /
                               static_cast<double>(bins.size());
    directions.emplace_back(std::cos(bearing_rad), std::sin(bearing_rad));
  }
  return directions;
}

bool is_faced(const Eigen::Vector2d& normal, const std::vector<Eigen::Vector2d>& directions) {
  return std::any_of(directions.begin(), directions.end(), [&](const Eigen::Vector2d& direction) {
    return normal.dot(direction) >= kFacedCosine;
  });
}

double seen_share(const Object& object) {
  const auto directions = seen_directions(object.observation_log);
  const Ring ring = outline_of(object);
  double seen_m = 0.0;
  double length_m = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Eigen::Vector2d edge = ring[(i + 1) % ring.size()] - ring[i];
    const double edge_m = edge.norm();
    if (edge_m <= 0.0) continue;
    length_m += edge_m;
    // Outer rings are counter-clockwise: outside is to the right of the edge.
    if (is_faced(Eigen::Vector2d(edge.y(), -edge.x()) / edge_m, directions)) seen_m += edge_m;
  }
  return length_m > 0.0 ? seen_m / length_m : 0.0;
}

}  // namespace hypermap
