// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Rooms made of upright boxes, and what a depth camera sees of them, pixel by pixel.
#pragma once

#include "hypermap/core/geometry/box.hpp"
#include "hypermap/core/segmentation/depth_cloud.hpp"
#include "hypermap/core/segmentation/rgbd_frame.hpp"
#include "hypermap/core/segmentation/segmentation_trace.hpp"
#include "support/camera_pose.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <set>
#include <span>
#include <vector>

namespace hypermap::test {

/// A Kinect: 640 x 480, 525 pixels of focal length.
inline PinholeCamera kinect_camera() {
  return {.width_px = 640,
          .height_px = 480,
          .fx_px = 525,
          .fy_px = 525,
          .cx_px = 319.5,
          .cy_px = 239.5};
}

/// The same field of view in a quarter of the pixels, for tests of many frames.
inline PinholeCamera half_kinect_camera() {
  return {.width_px = 320,
          .height_px = 240,
          .fx_px = 262.5,
          .fy_px = 262.5,
          .cx_px = 159.5,
          .cy_px = 119.5};
}

/// The same view in a quarter of the pixels.
inline PinholeCamera quarter_kinect_camera() {
  return {.width_px = 160,
          .height_px = 120,
          .fx_px = 131.25,
          .fy_px = 131.25,
          .cx_px = 79.5,
          .cy_px = 59.5};
}

/// What a camera sees, and which solid each pixel shows (0: none).
struct SceneView {
  RgbdFrame frame;
  LabelImage truth;
};

/// Solids with labels from 1; several boxes may share a label.
class BoxScene {
 public:
  explicit BoxScene(const PinholeCamera& camera = kinect_camera()) : camera_(camera) {}

  BoxScene& add(int label, const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
    solids_.push_back({label, {low, high}});
    return *this;
  }

  /// Noise of a structured-light sensor, in whole millimetres, when `noise_seed` is given.
  [[nodiscard]] SceneView view(const MapFromCamera& map_from_camera,
                               std::optional<unsigned> noise_seed = {}) const {
    SceneView view;
    RgbdFrame& frame = view.frame;
    frame.camera = camera_;
    frame.map_from_camera = map_from_camera;
    frame.depth_m = DepthImage(frame.camera.width_px, frame.camera.height_px);
    view.truth = LabelImage(frame.camera.width_px, frame.camera.height_px, 0);
    std::mt19937 random(noise_seed.value_or(0));
    std::normal_distribution<double> normal;
    for (int v = 0; v < frame.camera.height_px; ++v) {
      for (int u = 0; u < frame.camera.width_px; ++u) {
        const auto [depth_m, label] = first_hit(frame, u, v);
        if (label == 0) continue;
        view.truth.at(u, v) = label;
        const double noise_m = noise_seed ? axial_noise_m(depth_m) * normal(random) : 0.0;
        const double rounded =
            noise_seed ? std::round(1000.0 * (depth_m + noise_m)) / 1000.0 : depth_m;
        frame.depth_m.at(u, v) = static_cast<float>(rounded);
      }
    }
    return view;
  }

  /// The box of all solids with that label.
  [[nodiscard]] Box box_of(int label) const {
    std::vector<Eigen::Vector3f> corners;
    for (const Solid& solid : solids_) {
      if (solid.label != label) continue;
      for (const Eigen::Vector3d& corner : solid.box.corners()) {
        corners.push_back(corner.cast<float>());
      }
    }
    return bounding_box(corners);
  }

 private:
  struct Solid {
    int label;
    Box box;
  };
  struct Hit {
    double depth_m = std::numeric_limits<double>::infinity();
    int label = 0;
  };

  [[nodiscard]] Hit first_hit(const RgbdFrame& frame, int u, int v) const {
    const Eigen::Isometry3d& pose = frame.map_from_camera.isometry();
    const Eigen::Vector3d origin = pose.translation();
    const Eigen::Vector3d ray = pose.linear() * frame.camera.unproject(u, v, 1.0).xyz;
    Hit hit;
    for (const Solid& solid : solids_) {
      const Eigen::Array3d near_face = (solid.box.min_in_map - origin).array() / ray.array();
      const Eigen::Array3d far_face = (solid.box.max_in_map - origin).array() / ray.array();
      const double enter = near_face.min(far_face).maxCoeff();
      const double leave = near_face.max(far_face).minCoeff();
      if (enter > leave || enter <= 0.0 || enter >= hit.depth_m) continue;
      hit = {enter, solid.label};
    }
    return hit;
  }

  PinholeCamera camera_;
  std::vector<Solid> solids_;
};

/// The tight box around the pixels with that label; none when there is none.
inline std::optional<PixelBox> tight_box(const LabelImage& truth, int label) {
  std::optional<PixelBox> box;
  for (int v = 0; v < truth.height_px(); ++v) {
    for (int u = 0; u < truth.width_px(); ++u) {
      if (truth.at(u, v) != label) continue;
      const PixelBox pixel{u + 0.0, v + 0.0, u + 1.0, v + 1.0};
      if (!box) box = pixel;
      box = PixelBox{std::min(box->u_min_px, pixel.u_min_px),
                     std::min(box->v_min_px, pixel.v_min_px),
                     std::max(box->u_max_px, pixel.u_max_px),
                     std::max(box->v_max_px, pixel.v_max_px)};
    }
  }
  return box;
}

/// Intersection over union of the pixels found and those with that label.
inline double pixel_overlap(std::span<const std::uint32_t> found,
                            const LabelImage& truth,
                            int label) {
  const auto count = std::count(truth.pixels().begin(), truth.pixels().end(), label);
  const auto common = std::count_if(found.begin(), found.end(), [&](std::uint32_t pixel) {
    return truth.pixels()[pixel] == label;
  });
  const auto all = static_cast<std::int64_t>(found.size()) + count - common;
  return all > 0 ? static_cast<double>(common) / static_cast<double>(all) : 0.0;
}

}  // namespace hypermap::test
