// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Lines of sight that go through an Embree scene of bricks together, each in a lane of a vector.
///
/// Embree's tree is walked once for all of them; the kernel `meet_box` tests a brick's box for all
/// of them; the few that meet it walk its voxels one by one. What one line is answered does not
/// depend on the others.
#pragma once

#include "brick_walk.hpp"
#include "hypermap/octree_semantic/occlusion/occlusion_scene.hpp"
#include "kernels/kernels.hpp"

#include <embree3/rtcore.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hypermap {

/// User data of each geometry: Embree asks for its bricks by their numbers.
using OccupiedBricks = std::vector<OccupiedBrick>;

/// Called by Embree when lines reach a brick's bounds: which of them meet an occupied voxel?
/// Requires: the lines come from a LineFollower.
void test_occlusion(const RTCOccludedFunctionNArguments* arguments);

/// The most lines that Embree follows together on this processor, 4, 8 or 16, not more than
/// `max_lanes`; 0 when it can follow no four. Requires: max_lanes >= 4.
[[nodiscard]] std::size_t widest_packet(RTCDevice device, std::size_t max_lanes);

/// Follows lines, some at a time. Those that start in one place it puts in an order in which
/// neighbours go the same way.
class LineFollower {
 public:
  static constexpr std::size_t kMaxLines = 64;

  /// `num_lanes`: of `widest_packet`.
  LineFollower(RTCScene scene, double voxels_per_m, std::size_t num_lanes);

  /// A bit for each hidden line. Requires: at most kMaxLines.
  [[nodiscard]] std::uint64_t hidden(std::span<const SightLine> lines);

 private:
  struct Line {
    WalkedRay ray;
    std::size_t number = 0;  ///< Among the lines that were asked about.
  };
  /// Embree hands this on to the callback.
  struct Context {
    RTCIntersectContext embree{};  // first: it is what Embree knows
    const kernels::Kernels* kernels = nullptr;
    std::array<const WalkedRay*, kernels::kSightLanes> rays{};
    kernels::SightPacket lines;
  };
  friend void test_occlusion(const RTCOccludedFunctionNArguments* arguments);

  /// Keeps the lines that something may hide.
  void prepare(std::span<const SightLine> lines);
  /// Sorts `order_` by the direction of the lines.
  void order_by_direction();
  /// A bit for each hidden one of the lines [first, first + size) of the order, by its number.
  [[nodiscard]] std::uint64_t follow(std::size_t first, std::size_t size);
  /// A bit for each hidden one of the first `size` lanes.
  [[nodiscard]] std::uint32_t send(std::size_t size);
  template <class Rays, class Occluded>
  [[nodiscard]] std::uint32_t send_as(std::size_t size, const Occluded& occluded);

  Context context_;
  RTCScene scene_;
  double voxels_per_m_;
  std::size_t num_lanes_;
  std::size_t num_lines_ = 0;
  std::array<Line, kMaxLines> lines_;
  std::array<std::uint8_t, kMaxLines> order_{};
};

}  // namespace hypermap
