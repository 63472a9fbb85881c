// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How the frames of a hypermap's layers lie to each other in the plane.
///
/// Source: [hypermap] 3.3.5 (transforms between the layer frames).
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/base/value_tree.hpp"

#include <Eigen/Geometry>

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap {

/// Pose of the child frame in the parent frame. Unit: metre, radian.
struct FrameTransform {
  std::string frame_id;        ///< Parent.
  std::string child_frame_id;  ///< Child.
  double x_m = 0.0;
  double y_m = 0.0;
  double yaw_rad = 0.0;
  ValueTree extra = {};  ///< Unknown keys of the configuration, as a map; null when there are none.

  [[nodiscard]] Eigen::Isometry2d parent_from_child() const;
  friend bool operator==(const FrameTransform&, const FrameTransform&) = default;
};

/// A forest of frames, in the order in which the transforms were added.
class FrameTree {
 public:
  /// Errors: kInvalidArgument when a name is empty, both names are the same, a number is not finite
  /// or a translation beyond 1e6 m, or the two frames are connected already (a loop, a second
  /// parent).
  [[nodiscard]] Result<void> add(FrameTransform transform);

  [[nodiscard]] std::span<const FrameTransform> transforms() const noexcept { return transforms_; }

  /// Takes coordinates in `from` to coordinates in `to`, along any path, up or down.
  /// Errors: kNotFound when nothing connects them. Boundary: a frame is connected to itself, also
  /// one that no transform mentions.
  [[nodiscard]] Result<Eigen::Isometry2d> to_from(std::string_view to, std::string_view from) const;

  friend bool operator==(const FrameTree&, const FrameTree&) = default;

 private:
  std::vector<FrameTransform> transforms_;
};

}  // namespace hypermap
