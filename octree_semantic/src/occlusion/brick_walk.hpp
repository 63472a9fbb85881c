// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Whether a ray hits an occupied voxel of one brick. Unit: voxels, from the origin of the map.
#pragma once

#include "octree/brick.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace hypermap {

/// The smallest box around a brick's occupied voxels, and where the brick lies.
struct OccupiedBox {
  std::array<float, 3> corner{};  ///< Of the brick.
  std::array<float, 3> low{};     ///< From the corner, 0 .. 7.
  std::array<float, 3> high{};    ///< From the corner, 1 .. 8; low > high when nothing is occupied.
};

/// What a ray needs to know of a brick: two cache lines that are fetched together.
struct alignas(128) OccupiedBrick {
  OccupiedBox box;
  BrickBits occupied;
};

/// Fits the box to the occupied voxels.
void fit_box(OccupiedBrick& brick) noexcept;

/// A ray as every brick on its way needs it.
struct WalkedRay {
  std::array<float, 3> origin{};
  std::array<float, 3> direction{};  ///< Of length 1.
  std::array<float, 3> inverse{};    ///< 1 / direction, see `inverse_of`.
  float end = 0.0F;                  ///< How far it goes.
};

/// For a direction along the other axes: so large that no face of this axis is reached, and finite,
/// so that no product with it is NaN.
[[nodiscard]] inline float inverse_of(float direction) noexcept {
  constexpr float kNever = 1e30F;
  return std::abs(direction) > 1.0F / kNever ? 1.0F / direction : kNever;
}

/// The part of a ray in a box: nothing when first > last.
struct RayPart {
  std::array<float, 3> origin{};  ///< From the brick's corner.
  float first = 0.0F;
  float last = 0.0F;
};

[[nodiscard]] inline RayPart part_in(const OccupiedBox& box, const WalkedRay& ray) noexcept {
  RayPart part{.origin = {}, .first = 0.0F, .last = ray.end};
  for (std::size_t i = 0; i < 3; ++i) {
    part.origin[i] = ray.origin[i] - box.corner[i];
    const float to_low = (box.low[i] - part.origin[i]) * ray.inverse[i];
    const float to_high = (box.high[i] - part.origin[i]) * ray.inverse[i];
    part.first = std::max(part.first, std::min(to_low, to_high));
    part.last = std::min(part.last, std::max(to_low, to_high));
  }
  return part;
}

/// Walks from voxel to voxel, in Morton order without decoding it: a step on one axis adds to every
/// third bit and does not carry into the others. No step leads out of the box, because the way to
/// its last face is the same product as `part.last`.
///
/// Source: J. Amanatides and A. Woo, "A fast voxel traversal algorithm", Eurographics 1987.
/// Boundary: within a thousandth of a voxel and a millionth of the coordinates from an edge, either
/// answer. Requires: something is occupied.
[[nodiscard]] inline bool hits_occupied_voxel(const OccupiedBrick& brick,
                                              const WalkedRay& ray) noexcept {
  constexpr std::array<unsigned, kBrickEdge> kSpread{0, 1, 8, 9, 64, 65, 72, 73};
  constexpr unsigned kAxisBits = 0b001'001'001;
  const RayPart part = part_in(brick.box, ray);
  if (part.first > part.last) return false;
  std::array<unsigned, 3> voxel{};
  unsigned cell = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const float entry = part.origin[i] + ray.direction[i] * part.first;
    const float inside = std::min(std::max(entry, brick.box.low[i]), brick.box.high[i] - 1.0F);
    voxel[i] = static_cast<unsigned>(static_cast<int>(inside));
    cell |= kSpread[voxel[i]] << i;
  }
  if (brick.occupied.test(cell)) return true;  // most rays end here

  std::array<float, 3> face{};
  std::array<float, 3> next{};
  for (std::size_t i = 0; i < 3; ++i) {
    face[i] = static_cast<float>(voxel[i] + (ray.inverse[i] > 0.0F ? 1U : 0U));
    next[i] = (face[i] - part.origin[i]) * ray.inverse[i];
  }
  const auto step = [&](std::size_t i) {
    const unsigned axis = kAxisBits << i;
    const bool forward = ray.inverse[i] > 0.0F;
    const unsigned change = forward ? 0U - axis : 0U - (1U << i);
    cell = (cell & ~axis) | (((cell & axis) + change) & axis);
    face[i] += forward ? 1.0F : -1.0F;
    next[i] = (face[i] - part.origin[i]) * ray.inverse[i];
  };
  for (;;) {
    const std::size_t nearer = next[0] < next[1] ? 0 : 1;
    if (!(std::min(next[nearer], next[2]) < part.last)) return false;
    if (next[2] <= next[nearer]) {
      step(2);
    } else if (nearer == 0) {
      step(0);
    } else {
      step(1);
    }
    if (brick.occupied.test(cell)) return true;
  }
}

}  // namespace hypermap
