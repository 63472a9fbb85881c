// SPDX-License-Identifier: BSD-3-Clause
#include "brick_walk.hpp"

#include <bit>

namespace hypermap {
namespace {

/// Of a cube of 4 x 4 x 4 voxels in Morton order those whose coordinate on `axis` is `at`.
constexpr std::uint64_t layer(unsigned axis, unsigned at) noexcept {
  std::uint64_t bits = 0;
  for (unsigned cell = 0; cell < 64; ++cell) {
    const unsigned along = cell >> axis;
    if (((along & 1U) | (along >> 2U & 2U)) == at) bits |= std::uint64_t{1} << cell;
  }
  return bits;
}

constexpr std::array<std::array<std::uint64_t, 4>, 3> kLayers{
    {{layer(0, 0), layer(0, 1), layer(0, 2), layer(0, 3)},
     {layer(1, 0), layer(1, 1), layer(1, 2), layer(1, 3)},
     {layer(2, 0), layer(2, 1), layer(2, 2), layer(2, 3)}}};

/// A bit for each of the eight layers across `axis` in which something is occupied.
unsigned layers_of(const BrickBits& occupied, unsigned axis) noexcept {
  std::array<std::uint64_t, 2> halves{};
  for (unsigned word = 0; word < 8; ++word) halves[word >> axis & 1U] |= occupied.words[word];
  unsigned layers = 0;
  for (unsigned at = 0; at < kBrickEdge; ++at) {
    if ((halves[at >> 2U] & kLayers[axis][at & 3U]) != 0) layers |= 1U << at;
  }
  return layers;
}

}  // namespace

void fit_box(OccupiedBrick& brick) noexcept {
  for (unsigned axis = 0; axis < 3; ++axis) {
    const unsigned layers = layers_of(brick.occupied, axis);
    brick.box.low[axis] = static_cast<float>(layers == 0 ? kBrickEdge : std::countr_zero(layers));
    brick.box.high[axis] = static_cast<float>(std::bit_width(layers));
  }
}

}  // namespace hypermap
