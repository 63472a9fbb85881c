// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/registration/pose_smoother.hpp"

#include "registration/pose_difference.hpp"

#include <cassert>
#include <cmath>

namespace hypermap {
namespace {

/// Frames farther before one that waits count less than 2 % of it.
constexpr std::size_t kReachInWindows = 4;
/// Of Gauss-Newton: the first one begins at the frame's own difference, some sigmas away at most.
constexpr int kNumCorrections = 2;

std::size_t distance(std::size_t a, std::size_t b) {
  return a < b ? b - a : a - b;
}

}  // namespace

PoseSmoother::PoseSmoother(const PoseRefinementOptions& options) : options_(options) {}

void PoseSmoother::add(const MapFromCamera& given,
                       const PoseCorrection& correction,
                       const std::optional<RegisteredPose>& registered) {
  frames_.push_back({.given = given, .correction = correction, .registered = registered});
}

SmoothedPose PoseSmoother::take() {
  assert(num_waiting() > 0);
  SmoothedPose smoothed = pose_at(num_taken_);
  ++num_taken_;
  const std::size_t reach = kReachInWindows * static_cast<std::size_t>(options_.window_frames);
  if (num_taken_ > reach) {
    frames_.pop_front();
    --num_taken_;
  }
  return smoothed;
}

SmoothedPose PoseSmoother::pose_at(std::size_t position) const {
  const Frame& frame = frames_[position];
  SmoothedPose given{.map_from_camera = frame.given, .correction = frame.correction};
  // The first one of its surfaces lies at its given pose until others say more.
  const bool has_company =
      frame.correction.outcome == PoseOutcome::kRefined || position + 1 < frames_.size();
  if (!frame.registered || !has_company) return given;
  const MapFromCamera pose(map_from_model_at(position) * frame.registered->model_from_camera);
  const PoseCorrection correction = corrected(frame.correction, frame.given, pose);
  if (correction.translation_m > options_.max_translation_m ||
      correction.rotation_rad > options_.max_rotation_rad) {
    given.correction = {.outcome = PoseOutcome::kTooLarge};
    return given;
  }
  return {.map_from_camera = pose, .correction = correction};
}

Eigen::Isometry3d PoseSmoother::map_from_model_at(std::size_t position) const {
  const RegisteredPose& own = *frames_[position].registered;
  const double kept_share = 1.0 - 1.0 / options_.window_frames;
  Eigen::Isometry3d map_from_model =
      frames_[position].given.isometry() * own.model_from_camera.inverse();
  for (int iteration = 0; iteration < kNumCorrections; ++iteration) {
    PoseDifference sum;
    for (std::size_t i = 0; i < frames_.size(); ++i) {
      const Frame& frame = frames_[i];
      if (!frame.registered || frame.registered->model != own.model) continue;
      const double weight = std::pow(kept_share, static_cast<double>(distance(i, position)));
      const PoseDifference one = difference(
          frame.given.isometry(), map_from_model * frame.registered->model_from_camera, options_);
      sum.information += weight * one.information;
      sum.gradient += weight * one.gradient;
    }
    map_from_model = motion_of(sum) * map_from_model;
  }
  return map_from_model;
}

}  // namespace hypermap
