// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A box to be in and cupboards in it, as small depth images (160 x 120) with the cupboards that
/// they show as detections: cheap enough to paint ten thousand of them.
#pragma once

#include "hypermap/core/geometry/box.hpp"
#include "hypermap/octree_semantic/mapper/semantic_mapper.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace hypermap::test {

inline constexpr std::uint32_t kNumCupboardClasses = 8;

struct Cupboard {
  Box box;
  ClassId class_id;
};

struct World {
  Box walls;
  double view_range_m = 6.0;  ///< Cupboards that are farther away are not detected.
  std::vector<Cupboard> cupboards;
};

/// The cupboard of a number, which says its class. `x`, `y`: its lowest corner, metres.
[[nodiscard]] Cupboard cupboard(std::uint32_t number,
                                double x,
                                double y,
                                const Eigen::Vector3d& size_m);

/// What the camera sees of the world. Cost: pixels times the cupboards in range.
[[nodiscard]] RgbdFrame paint(const World& world, const MapFromCamera& pose, std::size_t index);

}  // namespace hypermap::test
