// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Things that are moved, taken away and brought between two passes of a camera.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/simulator/scene.hpp"
#include "hypermap/io/simulator/simulator.hpp"

#include <Eigen/Core>

#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

namespace hypermap {

/// A scene before and after its changes.
struct ChangedScene {
  FurnishedScene at_end;  ///< Ids 1 .. n in the scene's order, without what was removed.
  /// What there is to see, in all passes but the last and in the last one: the ids of `at_end`,
  /// then those of what was removed or stands in its old place. What is not there has an empty
  /// mesh. Without changes both are the same as `at_end`.
  FurnishedScene first_passes;
  FurnishedScene last_pass;
  std::vector<SceneChange> changes;  ///< In the order of the scene.
};

/// Chooses what changes as `SceneChangeOptions` says, and places for what is moved: on the floor,
/// 10 cm or more from walls and things of before and after, 30 cm or more from the camera's way.
///
/// `can_change` says of a class whether its things are chosen among.
/// Errors: kInvalidArgument naming the count that the scene cannot give.
[[nodiscard]] Result<ChangedScene> change_scene(
    const Scene& scene,
    FurnishedScene furnished,
    std::span<const Eigen::Vector3d> camera_way_in_map,
    const SceneChangeOptions& options,
    std::uint64_t seed,
    const std::function<bool(std::string_view)>& can_change);

}  // namespace hypermap
