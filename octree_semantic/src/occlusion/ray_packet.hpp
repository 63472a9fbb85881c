// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Packets of occlusion rays through an Embree scene of bricks, one ray per vector lane.
///
/// Embree's tree is traversed once per packet; the kernel `intersect_box` tests a brick's box
/// against all rays; those that intersect it traverse its voxels one by one. The result of a ray
/// does not depend on the others.
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

/// User data of each geometry: Embree addresses its bricks by their numbers.
using OccupiedBricks = std::vector<OccupiedBrick>;

/// Called by Embree when rays reach a brick's bounds: marks those that hit an occupied voxel.
/// Requires: the rays come from a RayPacketTracer.
void test_occlusion(const RTCOccludedFunctionNArguments* arguments);

/// The widest native ray packet of Embree on this processor, 4, 8 or 16, not more than `max_lanes`;
/// 0 without packets of four. Requires: max_lanes >= 4.
[[nodiscard]] std::size_t widest_packet(RTCDevice device, std::size_t max_lanes);

/// Traces occlusion rays in packets. Rays with a common origin are sorted by direction, so that
/// packets are coherent.
class RayPacketTracer {
 public:
  static constexpr std::size_t kMaxRays = 64;

  /// `num_lanes`: of `widest_packet`.
  RayPacketTracer(RTCScene scene, double voxels_per_m, std::size_t num_lanes);

  /// A bit for each occluded ray. Requires: at most kMaxRays.
  [[nodiscard]] std::uint64_t hidden(std::span<const OcclusionRay> rays);

 private:
  struct QueuedRay {
    WalkedRay ray;
    std::size_t number = 0;  ///< Among the rays of the call.
  };
  /// Embree hands this on to the callback.
  struct Context {
    RTCIntersectContext embree{};  // first: it is what Embree knows
    const kernels::Kernels* kernels = nullptr;
    std::array<const WalkedRay*, kernels::kRayLanes> rays{};
    kernels::RayPacket packet;
  };
  friend void test_occlusion(const RTCOccludedFunctionNArguments* arguments);

  /// Keeps the rays that can be occluded.
  void prepare(std::span<const OcclusionRay> rays);
  /// Sorts `order_` by the direction of the rays.
  void order_by_direction();
  /// A bit for each occluded ray of [first, first + size) in the order, by its number.
  [[nodiscard]] std::uint64_t trace(std::size_t first, std::size_t size);
  /// A bit for each occluded one of the first `size` lanes.
  [[nodiscard]] std::uint32_t trace_packet(std::size_t size);
  template <class Rays, class Occluded>
  [[nodiscard]] std::uint32_t trace_packet_as(std::size_t size, const Occluded& occluded);

  Context context_;
  RTCScene scene_;
  double voxels_per_m_;
  std::size_t num_lanes_;
  std::size_t num_rays_ = 0;
  std::array<QueuedRay, kMaxRays> rays_;
  std::array<std::uint8_t, kMaxRays> order_{};
};

}  // namespace hypermap
