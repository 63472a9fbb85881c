// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/evaluation/instance_sightings.hpp"

#include "hypermap/core/segmentation/detection.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace hypermap {
namespace {

/// The first pixel whose centre lies at or beyond an edge of a box; pixel u covers [u, u + 1).
int first_pixel(double edge_px, int num_pixels) {
  return static_cast<int>(
      std::clamp(std::ceil(edge_px - 0.5), 0.0, static_cast<double>(num_pixels)));
}

}  // namespace

InstanceSightings::InstanceSightings(const ListedInstances& listed)
    : frames_named_(listed.instances.size(), 0) {
  volumes_.reserve(listed.instances.size());
  for (const ListedInstance& instance : listed.instances) {
    Volume volume{
        .instance_from_input =
            input_from_instance(instance, listed.up_in_input).isometry().inverse(),
        .half_size_m = 0.5 * instance.size_m + Eigen::Vector3d::Constant(kInstanceMarginM)};
    volume.class_names.reserve(instance.class_names.size());
    for (const std::string& name : instance.class_names)
      volume.class_names.push_back(canonical_class_name(name));
    volumes_.push_back(std::move(volume));
  }
}

std::size_t InstanceSightings::num_pixels(const Volume& volume,
                                          const PixelBox& box,
                                          const RgbdFrame& frame) const {
  const Eigen::Isometry3d instance_from_camera =
      volume.instance_from_input * frame.map_from_camera.isometry();
  const int u_end = first_pixel(box.u_max_px, frame.depth_m.width_px());
  const int v_end = first_pixel(box.v_max_px, frame.depth_m.height_px());
  std::size_t n = 0;
  for (int v = first_pixel(box.v_min_px, v_end); v < v_end; ++v) {
    for (int u = first_pixel(box.u_min_px, u_end); u < u_end; ++u) {
      const auto depth_m = static_cast<double>(frame.depth_m.at(u, v));
      if (!(depth_m > 0.0) || !std::isfinite(depth_m)) continue;
      const Eigen::Vector3d point =
          instance_from_camera * frame.camera.unproject(u, v, depth_m).xyz;
      if ((point.cwiseAbs().array() <= volume.half_size_m.array()).all()) ++n;
    }
  }
  return n;
}

void InstanceSightings::add(const RgbdFrame& frame, const ClassRegistry& classes) {
  std::vector<bool> is_named(volumes_.size(), false);
  for (const Detection& detection : frame.detections) {
    const auto best = best_class(detection.class_scores);
    if (!best) continue;
    const std::string name = canonical_class_name(classes.name(best->id));
    std::optional<std::size_t> most;
    std::size_t most_pixels = kMinNamedPixels - 1;
    for (std::size_t t = 0; t < volumes_.size(); ++t) {
      const auto& names = volumes_[t].class_names;
      if (std::find(names.begin(), names.end(), name) == names.end()) continue;
      const std::size_t pixels = num_pixels(volumes_[t], detection.box_px, frame);
      if (pixels <= most_pixels) continue;
      most = t;
      most_pixels = pixels;
    }
    if (most) is_named[*most] = true;
  }
  for (std::size_t t = 0; t < volumes_.size(); ++t) frames_named_[t] += is_named[t] ? 1U : 0U;
}

}  // namespace hypermap
