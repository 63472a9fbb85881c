// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/simulator/camera_path.hpp"

#include "hypermap/core/base/option_rows.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <utility>

namespace hypermap {
namespace {

using State = Eigen::Matrix<double, 5, 1>;  // x, y, z, heading, pitch

constexpr double kShortestLegS = 0.2;

constexpr OptionRow kPathRows[] = {
    option::number<&CameraPath::Options::speed_m_per_s>(
        "speed_m_per_s", option::above(0, kUnbounded), {.unit = "m/s", .effect = "Of driving."}),
    option::number<&CameraPath::Options::turn_rate_rad_per_s>(
        "turn_rate_rad_per_s",
        option::above(0, kUnbounded),
        {.unit = "rad/s", .effect = "Of turning the gaze."}),
};

/// `angle` plus the number of full turns that brings it nearest to `reference`.
double unwrapped(double angle, double reference) {
  return angle -
         2.0 * std::numbers::pi * std::round((angle - reference) / (2.0 * std::numbers::pi));
}

Result<State> state_at(const CameraWaypoint& waypoint) {
  const Eigen::Vector3d gaze = waypoint.look_at_in_map - waypoint.position_in_map;
  if (!waypoint.position_in_map.allFinite() || !gaze.allFinite())
    return fail(ErrorCode::kInvalidArgument, "must be finite", "waypoints");
  if (gaze.head<2>().norm() < 0.01)
    return fail(ErrorCode::kInvalidArgument,
                "look_at must lie 1 cm or more aside of the camera, not above or below it",
                "waypoints");
  State state;
  state << waypoint.position_in_map, std::atan2(gaze.y(), gaze.x()),
      std::atan2(gaze.z(), gaze.head<2>().norm());
  return state;
}

double leg_duration_s(const State& from, const State& to, const CameraPath::Options& options) {
  const double drive = (to - from).head<3>().norm() / options.speed_m_per_s;
  const double turn = (to - from).tail<2>().cwiseAbs().maxCoeff() / options.turn_rate_rad_per_s;
  return std::max({drive, turn, kShortestLegS});
}

/// The slope at a knot between two legs that keeps the curve monotone wherever the knots are: the
/// harmonic mean of the legs' slopes, 0 where they have different signs.
double monotone_slope(double before, double after) {
  return before * after > 0.0 ? 2.0 * before * after / (before + after) : 0.0;
}

Eigen::Matrix3d camera_axes(double heading_rad, double pitch_rad) {
  const Eigen::Vector3d forward{std::cos(pitch_rad) * std::cos(heading_rad),
                                std::cos(pitch_rad) * std::sin(heading_rad),
                                std::sin(pitch_rad)};
  const Eigen::Vector3d right{std::sin(heading_rad), -std::cos(heading_rad), 0.0};
  Eigen::Matrix3d axes;
  axes << right, forward.cross(right), forward;
  return axes;
}

MapFromCamera camera_pose(const State& state) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = camera_axes(state[3], state[4]);
  pose.translation() = state.head<3>();
  return MapFromCamera(pose);
}

}  // namespace

const OptionTable& option_table(const CameraPath::Options&) {
  static constexpr OptionTable kTable{kPathRows};
  return kTable;
}

Result<CameraPath> CameraPath::create(const std::vector<CameraWaypoint>& waypoints,
                                      const Options& options) {
  HYPERMAP_TRY(check_options(options, "path"));
  if (waypoints.size() < 2)
    return fail(ErrorCode::kInvalidArgument,
                "must have 2 stops or more, has " + std::to_string(waypoints.size()),
                "waypoints");
  std::vector<Knot> knots;
  for (const CameraWaypoint& waypoint : waypoints) {
    HYPERMAP_ASSIGN_OR_RETURN(State state, state_at(waypoint));
    double time_s = 0.0;
    if (!knots.empty()) {
      state[3] = unwrapped(state[3], knots.back().state[3]);
      time_s = knots.back().time_s + leg_duration_s(knots.back().state, state, options);
    }
    knots.push_back({time_s, state, State::Zero()});
  }
  for (std::size_t i = 1; i + 1 < knots.size(); ++i) {
    const State before =
        (knots[i].state - knots[i - 1].state) / (knots[i].time_s - knots[i - 1].time_s);
    const State after =
        (knots[i + 1].state - knots[i].state) / (knots[i + 1].time_s - knots[i].time_s);
    knots[i].rate = before.binaryExpr(after, &monotone_slope);
  }
  return CameraPath(std::move(knots));
}

MapFromCamera CameraPath::pose_at(double time_s) const {
  const double time = std::clamp(time_s, 0.0, duration_s());
  const auto next =
      std::upper_bound(knots_.begin() + 1, knots_.end() - 1, time, [](double t, const Knot& knot) {
        return t < knot.time_s;
      });
  const Knot& to = *next;
  const Knot& from = *(next - 1);
  const double span = to.time_s - from.time_s;
  const double u = (time - from.time_s) / span;
  const double from_weight = (1.0 + 2.0 * u) * (1.0 - u) * (1.0 - u);  // cubic Hermite basis
  return camera_pose(from_weight * from.state + (1.0 - from_weight) * to.state +
                     u * (1.0 - u) * (1.0 - u) * span * from.rate -
                     u * u * (1.0 - u) * span * to.rate);
}

MapFromCamera look_at(const Eigen::Vector3d& position_in_map,
                      const Eigen::Vector3d& target_in_map) {
  const Eigen::Vector3d gaze = target_in_map - position_in_map;
  State state;
  state << position_in_map, std::atan2(gaze.y(), gaze.x()),
      std::atan2(gaze.z(), gaze.head<2>().norm());
  return camera_pose(state);
}

}  // namespace hypermap
