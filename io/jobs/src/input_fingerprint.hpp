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
///
/// The text after n frames is the hash of the text after n - 1 frames and of frame n: nothing else
/// is needed to go on from it.
class InputFingerprint {
 public:
  InputFingerprint() : text_(InputHash().text()) {}
  /// Of the frames that had `text` and `first_frame` when they had been added.
  InputFingerprint(std::string text, std::string first_frame);

  /// Returns the frame's own `frame_hash`.
  std::string add(const RgbdFrame& frame);
  [[nodiscard]] const std::string& text() const noexcept { return text_; }
  /// `recording_hash` of the first frame; empty before it.
  [[nodiscard]] const std::string& first_frame() const noexcept { return first_frame_; }

 private:
  std::string text_;
  std::string first_frame_;
};

/// Hash of what a frame has whatever is made of it, so that it is known again: stamp, camera and
/// depth, without pose and detections.
[[nodiscard]] std::string recording_hash(const RgbdFrame& frame);
/// Hash of all that a frame brings to the map: stamp, camera, pose, depth and detections.
[[nodiscard]] std::string frame_hash(const RgbdFrame& frame);

}  // namespace hypermap
