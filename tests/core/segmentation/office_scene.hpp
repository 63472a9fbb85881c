// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A desk and what stands on it, as a camera sees them.
#pragma once

#include "hypermap/core/segmentation/detection.hpp"
#include "support/box_scene.hpp"

namespace hypermap::test {

enum OfficeObject {
  kFloor = 100,
  kWall,
  kTable = 1,
  kScreen,
  kKeyboard,
  kMouse,
  kCup,
  kChair,
  kCupboard
};

/// A desk at a wall with what stands on it, a chair before it, a cupboard beside it.
inline BoxScene office() {
  BoxScene scene;
  scene.add(kFloor, {-4, -4, -0.1}, {4, 4, 0}).add(kWall, {2.5, -4, 0}, {2.6, 4, 3});
  scene.add(kTable, {1.6, -1, 0.72}, {2.4, 1, 0.75}).add(kTable, {1.6, -1, 0}, {1.65, -0.95, 0.72});
  scene.add(kScreen, {2.15, -0.3, 0.85}, {2.2, 0.2, 1.18});
  scene.add(kScreen, {2.16, -0.08, 0.75}, {2.2, -0.02, 0.86});
  scene.add(kKeyboard, {1.75, -0.28, 0.75}, {1.9, 0.17, 0.78});
  scene.add(kMouse, {1.78, 0.25, 0.75}, {1.88, 0.31, 0.79});
  scene.add(kCup, {1.9, -0.6, 0.75}, {1.98, -0.52, 0.85});
  scene.add(kChair, {0.98, -0.72, 0.42}, {1.42, -0.28, 0.48});
  scene.add(kChair, {0.98, -0.7, 0.55}, {1.03, -0.3, 0.95});
  scene.add(kChair, {1.0, -0.53, 0.46}, {1.03, -0.47, 0.6});
  scene.add(kChair, {1.0, -0.53, 0}, {1.03, -0.47, 0.43});
  scene.add(kCupboard, {2.0, 1.3, 0}, {2.5, 2.1, 1.8});
  return scene;
}

inline SceneView office_view(unsigned seed) {
  return office().view(look_at({0.3, 0.9, 1.4}, {2.0, 0.1, 0.7}), seed);
}

inline Detection detection_of(const SceneView& view, int label) {
  Detection detection;
  detection.box_px = tight_box(view.truth, label).value();
  return detection;
}

}  // namespace hypermap::test
