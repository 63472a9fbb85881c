// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Frames with labelled pixels for tests and benchmarks of the octree.
#pragma once

#include "hypermap/core/segmentation/rgbd_frame.hpp"
#include "hypermap/octree_semantic/integration/frame_integrator.hpp"

#include <cstddef>
#include <vector>

namespace hypermap::test {

struct LabelledFrame {
  RgbdFrame frame;
  std::vector<PixelLabels> labels;
};

/// A full class vector of `num_classes` that gives `id` the probability p and the rest an even
/// share.
[[nodiscard]] std::vector<ClassEvidence> class_vector(ClassId id, double p, int num_classes);

/// A furnished room of 8 x 6 x 2.7 m seen along a loop, rendered without a renderer: depth rounded
/// to millimetres, with noise that grows with the square of the distance (deterministic), and a
/// labelled object for each piece of furniture. Eight classes; objects are numbered from 1.
[[nodiscard]] std::vector<LabelledFrame> room_frames(int num_frames, int width_px);

/// Every `stride`-th frame of 7-Scenes RedKitchen, at most `max_frames`, each box of the recorded
/// detections labelled with a vector of 80 classes. Empty when the data is not there.
[[nodiscard]] std::vector<LabelledFrame> kitchen_frames(std::size_t stride, std::size_t max_frames);

/// The measured points of a frame in the order of their pixels, as OctoMap would get them.
[[nodiscard]] std::vector<Eigen::Vector3f> measured_points(const RgbdFrame& frame);

}  // namespace hypermap::test
