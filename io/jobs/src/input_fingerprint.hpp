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

 private:
  InputHash hash_;
};

}  // namespace hypermap
