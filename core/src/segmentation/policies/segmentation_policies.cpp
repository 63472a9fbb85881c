// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation_policies.hpp"

#include <algorithm>

namespace hypermap {
namespace {

PixelRect rect_of(const RgbdFrame& frame, const Detection& detection) {
  if (!detection.mask) {
    return pixels_in(detection.box_px, frame.camera.width_px, frame.camera.height_px);
  }
  return {
      .u_begin = 0, .v_begin = 0, .u_end = frame.camera.width_px, .v_end = frame.camera.height_px};
}

}  // namespace

PixelCloud crop(const RgbdFrame& frame, const Detection& detection) {
  PixelCloud cloud;
  const PixelRect rect = rect_of(frame, detection);
  for (int v = rect.v_begin; v < rect.v_end; ++v) {
    for (int u = rect.u_begin; u < rect.u_end; ++u) {
      const std::size_t pixel = frame.depth_m.index(u, v);
      const float depth_m = frame.depth_m.pixels()[pixel];
      if (!is_measured(depth_m)) continue;
      if (detection.mask && detection.mask->pixels()[pixel] == 0) continue;
      cloud.pixels.push_back(static_cast<std::uint32_t>(pixel));
      cloud.points_in_camera.emplace_back(
          frame.camera.unproject(u, v, static_cast<double>(depth_m)).xyz.cast<float>());
    }
  }
  return cloud;
}

PixelCloud within_range(const PixelCloud& cloud, const GeometricSegmentationOptions& options) {
  const double max_range_m = options.max_range_m.value_or(kDefaultMaxRangeM);
  std::vector<std::uint32_t> kept;
  for (std::size_t i = 0; i < cloud.pixels.size(); ++i) {
    const double depth_m = static_cast<double>(cloud.points_in_camera[i].z());
    if (depth_m < options.min_range_m || depth_m > max_range_m) continue;
    kept.push_back(static_cast<std::uint32_t>(i));
  }
  return subset(cloud, kept);
}

PixelCloud subset(const PixelCloud& cloud, const std::vector<std::uint32_t>& kept) {
  PixelCloud out;
  out.pixels.reserve(kept.size());
  out.points_in_camera.reserve(kept.size());
  for (const std::uint32_t i : kept) {
    out.pixels.push_back(cloud.pixels[i]);
    out.points_in_camera.push_back(cloud.points_in_camera[i]);
  }
  return out;
}

Segment describe(const RgbdFrame& frame,
                 std::vector<std::uint32_t> pixels,
                 std::span<const Eigen::Vector3f> points_in_camera,
                 const GeometricSegmentationOptions& options) {
  Segment segment;
  segment.pixel_indices = std::move(pixels);
  const Eigen::Isometry3d& map_from_camera = frame.map_from_camera.isometry();
  double closest_m = points_in_camera.front().cast<double>().norm();
  double farthest_m = closest_m;
  segment.points_in_map.reserve(points_in_camera.size());
  for (const Eigen::Vector3f& point : points_in_camera) {
    const Eigen::Vector3d exact = point.cast<double>();
    segment.points_in_map.emplace_back((map_from_camera * exact).cast<float>());
    closest_m = std::min(closest_m, exact.norm());
    farthest_m = std::max(farthest_m, exact.norm());
  }
  segment.box = bounding_box(segment.points_in_map);
  segment.centroid_in_map = segment.box.centre();
  segment.distance_m = (segment.centroid_in_map - frame.map_from_camera.origin().xyz).norm();
  segment.box_confidence = box_confidence(farthest_m - closest_m,
                                          options.depth_slack_m,
                                          options.min_range_m,
                                          options.max_range_m.value_or(kDefaultMaxRangeM));
  return segment;
}

Unexpected nothing_left(const std::string& step) {
  return fail(ErrorCode::kNotFound, "no point was left after the step " + step, "segmentation");
}

}  // namespace hypermap
