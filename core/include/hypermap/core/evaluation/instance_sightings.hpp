// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// In how many frames of a sequence a detector named each listed thing rightly.
///
/// Source: docs/EVALUATION.md, "Listed things".
#pragma once

#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/core/evaluation/listed_instances.hpp"
#include "hypermap/core/segmentation/rgbd_frame.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace hypermap {

/// Pixels of a thing in a detection from which on that names it.
inline constexpr std::size_t kMinNamedPixels = 200;
/// How far beyond the listed box measured points are still the thing's.
inline constexpr double kInstanceMarginM = 0.05;

/// Counts frames. A detection names the thing of its best class that has most of the measured
/// pixels in its box (of equals the first listed), when those are `kMinNamedPixels` or more.
class InstanceSightings {
 public:
  explicit InstanceSightings(const ListedInstances& listed);

  /// Requires: a valid frame, its pose in the input's world (no map_from_input was set); the
  /// classes of its detections are in `classes`.
  /// Cost: pixels in boxes times listed things of their class.
  void add(const RgbdFrame& frame, const ClassRegistry& classes);

  /// Of each thing, in the order of the list.
  [[nodiscard]] const std::vector<std::size_t>& frames_named() const noexcept {
    return frames_named_;
  }

 private:
  struct Volume {
    std::vector<std::string> class_names = {};
    Eigen::Isometry3d instance_from_input = Eigen::Isometry3d::Identity();
    Eigen::Vector3d half_size_m = Eigen::Vector3d::Zero();
  };

  [[nodiscard]] std::size_t num_pixels(const Volume& volume,
                                       const PixelBox& box,
                                       const RgbdFrame& frame) const;

  std::vector<Volume> volumes_;
  std::vector<std::size_t> frames_named_;
};

}  // namespace hypermap
