// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// One number for all that was mapped, so that equal inputs can be recognised.
#pragma once

#include "hypermap/core/segmentation/rgbd_frame.hpp"
#include "hypermap/io/archive/provenance.hpp"

#include <string>

namespace hypermap {

/// Hash over stamp, pose, camera, depth and detections of each frame, in order. Colour is left out:
/// it reaches the map only through the detections.
class InputFingerprint {
 public:
  void add(const RgbdFrame& frame);
  [[nodiscard]] std::string text() const { return hash_.text(); }
  /// `recording_hash` of the first frame; empty before it.
  [[nodiscard]] const std::string& first_frame() const noexcept { return first_frame_; }

 private:
  InputHash hash_;
  std::string first_frame_;
};

/// Hash of what a frame has whatever is made of it, so that it is known again: stamp, camera and
/// depth, without pose and detections.
[[nodiscard]] std::string recording_hash(const RgbdFrame& frame);

}  // namespace hypermap
