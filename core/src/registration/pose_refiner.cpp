// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/registration/pose_refiner.hpp"

#include "hypermap/core/segmentation/depth_cloud.hpp"
#include "registration/pose_difference.hpp"
#include "registration/pose_estimate.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

namespace hypermap {
namespace {

/// Surfaces are made of so many more pixels, each way, as are registered.
constexpr int kDensity = 2;
/// Normals are of pixels that lie this part of the image apart, each way: 12 of 640.
constexpr int kReachPerWidth = 50;
/// So many frames in a row whose surfaces lie elsewhere: the surfaces are outdated.
constexpr int kMaxDisagreeing = 10;

int grid_step_px(const RgbdFrame& frame, double num_points) {
  const double area_px2 = static_cast<double>(frame.depth_m.size());
  return std::max(1, static_cast<int>(std::sqrt(area_px2 / num_points)));
}

/// The point that the pixel measures; none beyond the image or the range.
std::optional<Eigen::Vector3d> point_at(const RgbdFrame& frame, int u, int v, double max_depth_m) {
  if (!frame.depth_m.contains(u, v)) return std::nullopt;
  const float z_m = frame.depth_m.at(u, v);
  if (!is_measured(z_m) || static_cast<double>(z_m) > max_depth_m) return std::nullopt;
  return frame.camera.unproject(u, v, static_cast<double>(z_m)).xyz;
}

/// The pixel's surface, by the pixels `reach_px` beside it; none where they lie on none.
std::optional<OrientedPoint> surface_at(
    const RgbdFrame& frame, int u, int v, int reach_px, double max_depth_m) {
  const auto place_m = point_at(frame, u, v, max_depth_m);
  const auto left = point_at(frame, u - reach_px, v, max_depth_m);
  const auto right = point_at(frame, u + reach_px, v, max_depth_m);
  const auto above = point_at(frame, u, v - reach_px, max_depth_m);
  const auto below = point_at(frame, u, v + reach_px, max_depth_m);
  if (!place_m || !left || !right || !above || !below) return std::nullopt;
  // x to the right, y down: the product looks at the camera.
  const Eigen::Vector3d normal = (*below - *above).cross(*right - *left);
  if (!(normal.norm() > 0.0)) return std::nullopt;
  return OrientedPoint{.place_m = *place_m, .normal = normal.normalized()};
}

/// Measured pixels of a regular grid, in rows of the image.
std::vector<OrientedPoint> sample(const RgbdFrame& frame,
                                  const MaskImage& left_out,
                                  int step_px,
                                  double max_depth_m) {
  std::vector<OrientedPoint> points;
  const DepthImage& depth_m = frame.depth_m;
  const int reach_px = std::max(1, depth_m.width_px() / kReachPerWidth);
  points.reserve(depth_m.size() / static_cast<std::size_t>(step_px * step_px) + 1);
  for (int v = step_px / 2; v < depth_m.height_px(); v += step_px) {
    for (int u = step_px / 2; u < depth_m.width_px(); u += step_px) {
      if (!left_out.empty() && left_out.at(u, v) != 0) continue;
      const auto point = surface_at(frame, u, v, reach_px, max_depth_m);
      if (point) points.push_back(*point);
    }
  }
  return points;
}

bool says_surfaces_lie_elsewhere(PoseOutcome outcome) {
  return outcome == PoseOutcome::kTooLarge;
}

}  // namespace

PoseRefiner::PoseRefiner(const PoseRefinementOptions& options)
    : options_(options), surfaces_(options.cell_m, static_cast<std::size_t>(options.max_cells)) {}

RefinedPose PoseRefiner::refine(const RgbdFrame& frame, const MaskImage& left_out) const {
  assert(options_.rule != PoseRefinementRule::kNone);
  const int step_px = grid_step_px(frame, options_.num_points);
  const auto points = sample(frame, left_out, step_px, options_.max_depth_m);
  const Eigen::Isometry3d given = map_from_model_.inverse() * frame.map_from_camera.isometry();
  const PoseEstimate estimate = estimate_pose(points, given, surfaces_, options_);
  RefinedPose refined{.map_from_camera = frame.map_from_camera,
                      .correction = estimate.correction,
                      .model_from_camera = estimate.model_from_camera,
                      .points_in_camera = sample(
                          frame, left_out, std::max(1, step_px / kDensity), options_.max_depth_m)};
  if (estimate.correction.outcome != PoseOutcome::kRefined) return refined;
  refined.map_from_camera = MapFromCamera(map_from_model_ * estimate.model_from_camera);
  refined.correction =
      corrected(estimate.correction, frame.map_from_camera, refined.map_from_camera);
  return refined;
}

std::optional<RegisteredPose> PoseRefiner::add(const RgbdFrame& frame, const RefinedPose& refined) {
  Eigen::Isometry3d model_from_camera = refined.model_from_camera;
  if (says_surfaces_lie_elsewhere(refined.correction.outcome)) {
    if (++num_disagreeing_ < kMaxDisagreeing) return std::nullopt;
    surfaces_.clear();
    information_.setZero();
    map_from_model_.setIdentity();
    ++model_;
    model_from_camera = frame.map_from_camera.isometry();
  }
  num_disagreeing_ = 0;
  // It would blur them.
  if (refined.correction.outcome == PoseOutcome::kAmbiguous) return std::nullopt;
  const bool is_first = information_.isZero(0.0) && !refined.points_in_camera.empty();
  const bool is_registered = is_first || refined.correction.outcome == PoseOutcome::kRefined;
  if (is_registered) follow_given(frame.map_from_camera, model_from_camera);
  std::vector<OrientedPoint> points = refined.points_in_camera;
  for (OrientedPoint& point : points) {
    point.place_m = model_from_camera * point.place_m;
    point.normal = model_from_camera.linear() * point.normal;
  }
  surfaces_.add(points);
  if (!is_registered) return std::nullopt;
  return RegisteredPose{.model_from_camera = model_from_camera, .model = model_};
}

/// Moves the model in the map by the frame's share in the mean of all differences: a Kalman filter.
void PoseRefiner::follow_given(const MapFromCamera& given,
                               const Eigen::Isometry3d& model_from_camera) {
  PoseDifference newest =
      difference(given.isometry(), map_from_model_ * model_from_camera, options_);
  information_ *= 1.0 - 1.0 / options_.window_frames;
  information_ += newest.information;
  newest.information = information_;
  map_from_model_ = motion_of(newest) * map_from_model_;
}

}  // namespace hypermap
