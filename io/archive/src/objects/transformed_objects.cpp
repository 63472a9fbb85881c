// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/geometry/block_looks.hpp"
#include "hypermap/core/geometry/lattice_motion.hpp"
#include "transformed_parts.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kMaxCoordinateM = 1e6;

/// Whole bins that come nearest to the turn, 0 to num_bins - 1.
std::size_t bins_turned(double yaw_rad, std::size_t num_bins) {
  const auto n = static_cast<long>(num_bins);
  const long turned = std::lround(yaw_rad / kTurn * static_cast<double>(n));
  return static_cast<std::size_t>((turned % n + n) % n);
}

Result<ShapeEvidence> moved_shapes(const ShapeEvidence& shapes, const UprightMotion& motion) {
  ShapeEvidenceState state = shapes.state();
  for (Polygon& shape : state.shapes) {
    HYPERMAP_ASSIGN_OR_RETURN(shape, transformed(shape, motion));
  }
  if (state.hull) {
    HYPERMAP_ASSIGN_OR_RETURN(state.hull, transformed(*state.hull, motion));
  }
  const Eigen::Isometry2d plane = motion.in_plane();
  state.centroid_sum = plane.linear() * state.centroid_sum +
                       static_cast<double>(state.num_seen) * plane.translation();
  return ShapeEvidence::from_state(std::move(state));
}

Result<PointCell> moved_cell(const PointCell& cell, const LatticeMotion& motion, double edge_m) {
  const Eigen::Vector3d moved = motion(Eigen::Vector3d(cell.x + 0.5, cell.y + 0.5, cell.z + 0.5));
  if (!(moved.cwiseAbs().maxCoeff() * edge_m <= kMaxCoordinateM) ||
      !(moved.cwiseAbs().maxCoeff() < INT32_MAX)) {
    return fail(ErrorCode::kLimit, "would lie beyond 1e6 m", "points");
  }
  const auto index = [](double v) { return static_cast<std::int32_t>(std::floor(v)); };
  return PointCell{index(moved.x()), index(moved.y()), index(moved.z())};
}

LatticeMotion in_cells(const UprightMotion& motion, double edge_m) {
  Eigen::Isometry3d in_edges = motion.in_space();
  in_edges.translation() /= edge_m;
  return LatticeMotion::of(in_edges).value();  // it is upright
}

/// A cell after a motion, and how often its block was in view before.
struct MovedCell {
  PointVote vote;
  std::uint32_t looks = 0;
};

Result<OccupancyVotes> moved_votes(const OccupancyVotes& points, const UprightMotion& motion) {
  OccupancyVotesState state = points.state();
  const LatticeMotion cells = in_cells(motion, state.edge_m);
  const std::vector<std::uint32_t> looks = looks_of_cells(state);
  std::vector<MovedCell> moved;
  moved.reserve(state.votes.size());
  for (std::size_t i = 0; i < state.votes.size(); ++i) {
    HYPERMAP_ASSIGN_OR_RETURN(const PointCell cell,
                              moved_cell(state.votes[i].cell, cells, state.edge_m));
    moved.push_back({{cell, state.votes[i].votes}, looks[i]});
  }
  std::ranges::sort(moved, {}, [](const MovedCell& cell) { return cell.vote.cell; });
  std::vector<std::uint32_t> moved_looks;
  state.votes.clear();
  for (const MovedCell& cell : moved) {
    state.votes.push_back(cell.vote);
    moved_looks.push_back(cell.looks);
  }
  state.looks = looks_of_blocks(state.votes, moved_looks, state.num_observations);
  return OccupancyVotes::from_state(points.options(), std::move(state));
}

Result<VisibilityHistogram> turned_histogram(const VisibilityHistogram& histogram, double yaw_rad) {
  std::vector<LogOdds> bins(histogram.bins().begin(), histogram.bins().end());
  const std::size_t turned = bins_turned(yaw_rad, bins.size());
  std::rotate(bins.rbegin(), bins.rbegin() + static_cast<std::ptrdiff_t>(turned), bins.rend());
  return VisibilityHistogram::from_bins(histogram.options(), std::move(bins));
}

void turn(ObservationLogEntry& entry, double yaw_rad) {
  if (yaw_rad == 0.0) return;
  entry.bearing_rad =
      static_cast<float>(std::remainder(static_cast<double>(entry.bearing_rad) + yaw_rad, kTurn));
}

Result<ObservationLog> turned_log(const ObservationLog& log, double yaw_rad) {
  ObservationLogState state = log.state();
  if (state.first) turn(*state.first, yaw_rad);
  for (ObservationLogEntry& entry : state.newest) turn(entry, yaw_rad);
  const std::size_t turned = bins_turned(yaw_rad, ObservationLog::kNumBearingBins);
  for (ObservationLogSummary& summary : state.summaries) {
    summary.bearing_bin =
        static_cast<std::uint8_t>((summary.bearing_bin + turned) % ObservationLog::kNumBearingBins);
  }
  const auto key = [](const ObservationLogSummary& s) {
    return std::tuple(s.kind, s.detector, s.class_id, s.bearing_bin);
  };
  std::sort(state.summaries.begin(), state.summaries.end(), [&](const auto& a, const auto& b) {
    return key(a) < key(b);
  });
  return ObservationLog::from_state(std::move(state));
}

/// A shift takes the box along as it is. Of a turned object it is the box of the moved points where
/// it was that of the points; else one around the moved box.
void move_box(Object& object, const OccupancyVotes& before, const UprightMotion& motion) {
  const bool is_of_points = motion.yaw_rad != 0.0 && before.agreed_box() == object.box;
  const auto box = is_of_points ? object.points.agreed_box() : std::nullopt;
  const bool has_its_centre = object.centroid_in_map == object.box.centre();
  object.centroid_in_map = box && has_its_centre
                               ? box->centre()
                               : Eigen::Vector3d(motion.in_space() * object.centroid_in_map);
  object.box = box.value_or(transformed(object.box, motion));
}

Result<Object> moved_object(Object object, const UprightMotion& motion) {
  HYPERMAP_ASSIGN_OR_RETURN(object.shapes, moved_shapes(object.shapes, motion));
  HYPERMAP_ASSIGN_OR_RETURN(OccupancyVotes points, moved_votes(object.points, motion));
  std::swap(object.points, points);
  move_box(object, points, motion);
  HYPERMAP_ASSIGN_OR_RETURN(object.histogram, turned_histogram(object.histogram, motion.yaw_rad));
  HYPERMAP_ASSIGN_OR_RETURN(object.observation_log,
                            turned_log(object.observation_log, motion.yaw_rad));
  return object;
}

}  // namespace

Result<ObjectMap> transformed(const ObjectMap& objects, const UprightMotion& motion) {
  std::vector<Object> moved;
  moved.reserve(objects.size());
  for (const Object& object : objects.objects()) {
    auto there = moved_object(object, motion);
    if (!there) {
      return fail(
          there.error().code, there.error().what, "object " + std::to_string(object.id.value));
    }
    moved.push_back(std::move(*there));
  }
  return ObjectMap::restore(std::move(moved), objects.next_id());
}

}  // namespace hypermap
