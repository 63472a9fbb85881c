// SPDX-License-Identifier: BSD-3-Clause
#include "look_schedule.hpp"

#include <algorithm>
#include <cmath>

namespace hypermap {
namespace {

/// The angle of the rotation between two poses, from the trace of its matrix.
double angle_rad(const MapFromCamera& a, const MapFromCamera& b) {
  const double trace = (a.isometry().linear().transpose() * b.isometry().linear()).trace();
  return std::acos(std::clamp((trace - 1.0) / 2.0, -1.0, 1.0));
}

}  // namespace

bool LookSchedule::take(std::size_t position, const MapFromCamera& pose) {
  if (!needs_poses()) return position % options_.every == 0;
  const bool is_due = last_position_ && position - *last_position_ >= options_.max_gap_frames;
  const bool is_view = !is_known(pose);
  if (!is_due && !is_view) return false;
  if (is_view) views_.push_back(pose);
  last_position_ = position;
  return true;
}

bool LookSchedule::is_known(const MapFromCamera& pose) const {
  return std::ranges::any_of(views_, [&](const MapFromCamera& view) {
    const double distance_m = (view.origin().xyz - pose.origin().xyz).norm();
    return distance_m <= options_.min_distance_m && angle_rad(view, pose) <= options_.min_angle_rad;
  });
}

}  // namespace hypermap
