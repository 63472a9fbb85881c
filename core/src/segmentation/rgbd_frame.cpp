// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/segmentation/rgbd_frame.hpp"

#include "frame_index.hpp"
#include "hypermap/core/base/number_text.hpp"

#include <cmath>
#include <limits>
#include <string>

namespace hypermap {
namespace {

constexpr double kMaxRotationError = 1e-3;

std::string size_text(int width_px, int height_px) {
  return std::to_string(width_px) + "x" + std::to_string(height_px);
}

template <class Pixel>
Result<void> check_size(const Image<Pixel>& image,
                        const PinholeCamera& camera,
                        const std::string& field) {
  if (image.width_px() == camera.width_px && image.height_px() == camera.height_px) return {};
  return fail(ErrorCode::kInvalidArgument,
              "must have the camera's size " + size_text(camera.width_px, camera.height_px) +
                  ", is " + size_text(image.width_px(), image.height_px()),
              field);
}

Result<void> check_pose(const MapFromCamera& map_from_camera) {
  const Eigen::Matrix4d& matrix = map_from_camera.isometry().matrix();
  if (!matrix.allFinite()) {
    return fail(ErrorCode::kInvalidArgument, "must be finite", "map_from_camera");
  }
  const Eigen::Matrix3d rotation = matrix.topLeftCorner<3, 3>();
  const double error = rotation_error(rotation);
  if (error > kMaxRotationError) {
    return fail(ErrorCode::kInvalidArgument,
                "must be a rotation within 0.001, is off by " + number_text(error),
                "map_from_camera");
  }
  if (rotation.determinant() < 0.0) {
    return fail(ErrorCode::kInvalidArgument, "must be a rotation, is a mirror", "map_from_camera");
  }
  return {};
}

Result<void> check_detection(const RgbdFrame& frame, const Detection& detection) {
  if (detection.mask) HYPERMAP_TRY(check_size(*detection.mask, frame.camera, "mask"));
  return validate(detection);
}

Result<void> check_detections(const RgbdFrame& frame) {
  for (std::size_t i = 0; i < frame.detections.size(); ++i) {
    auto checked = check_detection(frame, frame.detections[i]);
    if (checked) continue;
    Error& error = checked.error();
    error.field = "detections[" + std::to_string(i) + "]." + error.field;
    return checked;
  }
  return {};
}

}  // namespace

Result<void> check_frame_index(std::uint64_t index) {
  constexpr auto kMaxIndex = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
  if (index <= kMaxIndex) return {};
  return fail(ErrorCode::kInvalidArgument,
              "must be at most " + std::to_string(kMaxIndex) + ", is " + std::to_string(index),
              "index");
}

Result<void> validate(const RgbdFrame& frame) {
  HYPERMAP_TRY(check_frame_index(frame.index));
  HYPERMAP_TRY(validate(frame.camera));
  HYPERMAP_TRY(check_size(frame.depth_m, frame.camera, "depth_m"));
  if (!frame.color.empty()) HYPERMAP_TRY(check_size(frame.color, frame.camera, "color"));
  HYPERMAP_TRY(check_detections(frame));
  if (frame.floor_height_m && !std::isfinite(*frame.floor_height_m))
    return fail(ErrorCode::kInvalidArgument, "must be finite", "floor_height_m");
  return check_pose(frame.map_from_camera);
}

}  // namespace hypermap
