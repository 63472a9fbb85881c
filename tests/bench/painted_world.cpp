// SPDX-License-Identifier: BSD-3-Clause
#include "bench/painted_world.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace hypermap::test {
namespace {

const PinholeCamera kCamera{160, 120, 131.0, 131.0, 79.5, 59.5};

/// What one ray meets.
struct Hit {
  double depth_m;
  int cupboard;  ///< -1: a wall.
};

class Painter {
 public:
  Painter(const World& world, const MapFromCamera& pose) : walls_(world.walls) {
    origin_ = pose.origin().xyz;
    for (const Cupboard& c : world.cupboards) {
      const bool near = (c.box.centre() - origin_).norm() < world.view_range_m + 1.0;
      if (near) near_.push_back(&c);
    }
  }

  [[nodiscard]] Hit look(const Eigen::Vector3d& ray) const {
    Hit hit{span(walls_, ray)[1], -1};
    for (std::size_t i = 0; i < near_.size(); ++i) {
      const auto [enter, leave] = span(near_[i]->box, ray);
      if (enter > 0.0 && enter <= leave && enter < hit.depth_m) hit = {enter, static_cast<int>(i)};
    }
    return hit;
  }
  [[nodiscard]] const std::vector<const Cupboard*>& near() const { return near_; }

 private:
  [[nodiscard]] std::array<double, 2> span(const Box& box, const Eigen::Vector3d& ray) const {
    const Eigen::Array3d a = (box.min_in_map - origin_).array() / ray.array();
    const Eigen::Array3d b = (box.max_in_map - origin_).array() / ray.array();
    return {a.min(b).maxCoeff(), a.max(b).minCoeff()};
  }

  Box walls_;
  Eigen::Vector3d origin_;
  std::vector<const Cupboard*> near_;
};

std::vector<ClassEvidence> class_vector(ClassId id) {
  std::vector<ClassEvidence> scores;
  for (std::uint32_t i = 0; i < kNumCupboardClasses; ++i) {
    scores.push_back({ClassId{i}, Probability(ClassId{i} == id ? 0.72 : 0.04)});
  }
  return scores;
}

}  // namespace

Cupboard cupboard(std::uint32_t number, double x, double y, const Eigen::Vector3d& size_m) {
  const Eigen::Vector3d low(x, y, 0.0);
  return {{low, low + size_m}, ClassId{number % kNumCupboardClasses}};
}

RgbdFrame paint(const World& world, const MapFromCamera& pose, std::size_t index) {
  RgbdFrame frame;
  frame.index = index;
  frame.camera = kCamera;
  frame.map_from_camera = pose;
  frame.depth_m = DepthImage(kCamera.width_px, kCamera.height_px);
  const Painter painter(world, pose);
  std::vector<PixelBox> boxes(painter.near().size(), PixelBox{1e9, 1e9, 0, 0});
  std::vector<int> num_pixels(boxes.size(), 0);
  const Eigen::Matrix3d rotation = pose.isometry().linear();
  for (int v = 0; v < kCamera.height_px; ++v) {
    for (int u = 0; u < kCamera.width_px; ++u) {
      const Hit hit = painter.look(rotation * kCamera.unproject(u, v, 1.0).xyz);
      // Millimetres, with a ripple in the place of noise.
      const double ripple_m =
          0.001 * static_cast<double>((static_cast<std::size_t>(u * 7 + v * 13) + index * 31) % 5);
      frame.depth_m.at(u, v) =
          static_cast<float>(std::round(1e3 * (hit.depth_m + ripple_m)) * 1e-3);
      if (hit.cupboard < 0 || hit.depth_m > world.view_range_m) continue;
      PixelBox& box = boxes[static_cast<std::size_t>(hit.cupboard)];
      box = {std::min(box.u_min_px, u + 0.0),
             std::min(box.v_min_px, v + 0.0),
             std::max(box.u_max_px, u + 1.0),
             std::max(box.v_max_px, v + 1.0)};
      ++num_pixels[static_cast<std::size_t>(hit.cupboard)];
    }
  }
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (num_pixels[i] < 100) continue;
    frame.detections.push_back({.box_px = boxes[i],
                                .class_scores = class_vector(painter.near()[i]->class_id),
                                .score = Probability(0.72),
                                .detector = {},
                                .mask = {}});
  }
  return frame;
}

}  // namespace hypermap::test
