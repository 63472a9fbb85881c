// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A small room and a quick simulation of it.
#pragma once

#include "hypermap/io/simulator/scene.hpp"
#include "hypermap/io/simulator/simulator.hpp"

namespace hypermap::test {

inline constexpr PinholeCamera kSmall{160, 120, 131.25, 131.25, 79.5, 59.5};

/// A table with a cup and a monitor, a chair, and a bin that no detector can name.
inline Scene room_scene() {
  Scene scene;
  scene.name = "room";
  scene.floor.outer = {{0, 0}, {5, 0}, {5, 4}, {0, 4}};
  scene.objects = {
      {.name = "desk", .class_name = "table", .shape = "table", .position_m = {3.5, 2.0}},
      {.name = "screen", .class_name = "tvmonitor", .shape = "monitor", .on = "desk"},
      {.name = "chair", .class_name = "chair", .shape = "chair", .position_m = {2.4, 1.2}},
      {.name = "bin", .class_name = "bin", .shape = "bin", .position_m = {4.5, 0.5}},
      {.name = "mug", .class_name = "cup", .shape = "cup", .position_m = {0.3, 3.8}}};
  scene.waypoints = {{{0.5, 1.0, 1.4}, {3.5, 2.0, 0.6}}, {{0.8, 3.0, 1.4}, {3.5, 1.8, 0.6}}};
  return scene;
}

inline SimulationOptions small_options() {
  SimulationOptions options;
  options.num_frames = 6;
  options.camera = kSmall;
  options.detector.min_visible_px = 20;
  return options;
}

}  // namespace hypermap::test
