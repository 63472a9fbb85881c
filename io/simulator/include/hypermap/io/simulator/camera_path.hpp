// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Where a simulated robot's camera is and what it looks at, over time.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/frames.hpp"

#include <Eigen/Core>

#include <vector>

namespace hypermap {

struct OptionTable;

/// One stop of the camera.
struct CameraWaypoint {
  Eigen::Vector3d position_in_map = Eigen::Vector3d::Zero();
  Eigen::Vector3d look_at_in_map = Eigen::Vector3d::UnitX();
};

/// A smooth way through waypoints: position, heading and pitch are monotone cubic curves through
/// the stops, which never overshoot; the camera never rolls. It starts and ends at rest.
///
/// Source: F. Fritsch, J. Butland, "A method for constructing local monotone piecewise cubic
/// interpolants", 1984 (the harmonic mean for legs of any length).
///
/// Time at a leg is what the slower of driving and turning needs, so that the sequence stays slow
/// enough to see objects wherever the robot turns.
class CameraPath {
 public:
  struct Options {
    double speed_m_per_s = 0.3;        ///< Of driving. Range: > 0.
    double turn_rate_rad_per_s = 0.4;  ///< Of turning the gaze. Range: > 0.
  };

  /// Errors: kInvalidArgument: fewer than two waypoints, a coordinate that is not finite, a gaze
  /// target within 1 cm of its camera or straight above or below it, options out of their range,
  /// named as fields of `path`.
  [[nodiscard]] static Result<CameraPath> create(const std::vector<CameraWaypoint>& waypoints,
                                                 const Options& options);

  [[nodiscard]] double duration_s() const noexcept { return knots_.back().time_s; }

  /// Boundary: times outside 0 .. duration_s() give the first or last pose.
  [[nodiscard]] MapFromCamera pose_at(double time_s) const;

 private:
  struct Knot {
    double time_s = 0.0;
    /// x, y, z, heading, pitch; headings continue without jumps of a full turn.
    Eigen::Matrix<double, 5, 1> state = Eigen::Matrix<double, 5, 1>::Zero();
    Eigen::Matrix<double, 5, 1> rate = Eigen::Matrix<double, 5, 1>::Zero();
  };
  explicit CameraPath(std::vector<Knot> knots) : knots_(std::move(knots)) {}

  std::vector<Knot> knots_;
};

[[nodiscard]] const OptionTable& option_table(const CameraPath::Options& options);

/// A camera at `position` that looks at `target`, its x axis level. Frame: optical (+z forward, +y
/// down). Requires: the target is not straight above or below.
[[nodiscard]] MapFromCamera look_at(const Eigen::Vector3d& position_in_map,
                                    const Eigen::Vector3d& target_in_map);

}  // namespace hypermap
