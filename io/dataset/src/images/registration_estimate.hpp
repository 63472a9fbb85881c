// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Whether depth is registered to colour, and if not, where the colour camera is: by the images.
///
/// Where depth steps from one thing to what is behind it, colour mostly changes too. A recording
/// of two cameras side by side (the Kinect's of 7-Scenes) whose depth was taken for registered
/// has the box of a cup, found in colour, lie beside the cup in depth.
#pragma once

#include "hypermap/core/base/image.hpp"
#include "hypermap/core/geometry/camera.hpp"

#include <Eigen/Geometry>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace hypermap {

/// The camera that took the colour images, and how well steps in depth lie on its edges.
struct RegistrationEstimate {
  PinholeCamera color_camera;
  Eigen::Isometry3d color_from_depth = Eigen::Isometry3d::Identity();
  double agreement = 0.0;        ///< Mean edge of colour at steps in depth. Unit: deviation of all.
  double agreement_as_is = 0.0;  ///< The same where depth and colour are pixel by pixel the same.
};

/// Collects edges frame by frame, then looks for the colour camera that makes them agree.
///
/// Scope: the colour camera looks the same way as the depth camera, a little beside it, and its
/// images have the same size; no distortion.
class RegistrationEstimator {
 public:
  explicit RegistrationEstimator(const PinholeCamera& depth_camera) : camera_(depth_camera) {}

  /// Images of another size than the camera's are left out. Cost: O(pixels).
  void add(const DepthImage& depth_m, const ColorImage& color);

  /// None when depth is registered: nothing else agrees clearly better, or there are too few steps
  /// to tell. The same result for the same frames. Cost: some ten million look-ups.
  [[nodiscard]] std::optional<RegistrationEstimate> estimate() const;

 private:
  /// The last pixel of what is nearer at a step in depth.
  struct Step {
    std::uint32_t frame = 0;
    float u_px = 0.0F;  ///< From the camera's centre.
    float v_px = 0.0F;
    float depth_m = 0.0F;
  };
  /// Where a colour camera would see a step: u' = cx + right + scale * u + beside / z.
  struct Shift {
    double scale = 1.0;        ///< Focal length by that of depth.
    double right_px = 0.0;     ///< Of its centre.
    double down_px = 0.0;      ///< Of its centre.
    double beside_px_m = 0.0;  ///< Distance between the cameras times focal length.
  };

  /// `shift` and `factor` times `move`.
  [[nodiscard]] static Shift plus(const Shift& shift, const Shift& move, double factor);
  [[nodiscard]] double agreement(const std::vector<Step>& steps, const Shift& shift) const;
  [[nodiscard]] Shift coarse_shift(const std::vector<Step>& steps) const;
  [[nodiscard]] Shift refined_shift(const std::vector<Step>& steps, Shift shift) const;
  void find_steps(const DepthImage& depth_m, int du, int dv);

  PinholeCamera camera_;
  std::vector<std::vector<float>> edges_;  ///< Per frame and pixel, in deviations from the mean.
  std::vector<Step> steps_;
};

}  // namespace hypermap
