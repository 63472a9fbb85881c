// SPDX-License-Identifier: BSD-3-Clause
#include "ray_packet.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

namespace hypermap {
namespace {

/// Farther from the map's origin a ray has no voxel's precision left. Unit: voxel.
constexpr double kFarthest = 1e9;

kernels::BoxFaces faces_of(const OccupiedBox& box) {
  kernels::BoxFaces faces;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    faces.low[axis] = box.corner[axis] + box.low[axis];
    faces.high[axis] = box.corner[axis] + box.high[axis];
  }
  return faces;
}

bool have_common_origin(std::span<const OcclusionRay> rays) {
  return std::all_of(rays.begin(), rays.end(), [&](const OcclusionRay& ray) {
    return ray.from.xyz == rays.front().from.xyz;
  });
}

/// Which of 4 x 4 x 4 cubes that span some directions, in Morton order.
class DirectionCubes {
 public:
  static constexpr std::size_t kNum = 64;

  void include(const std::array<float, 3>& direction) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low_[axis] = std::min(low_[axis], direction[axis]);
      high_[axis] = std::max(high_[axis], direction[axis]);
    }
  }
  /// Cubes, not boxes: directions that differ little along an axis need no parting there.
  void close() {
    constexpr float kLeast = 1e-6F;
    float extent = kLeast;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      extent = std::max(extent, high_[axis] - low_[axis]);
    }
    per_cube_ = 3.999F / extent;
  }
  [[nodiscard]] std::size_t cube(const std::array<float, 3>& direction) const {
    constexpr std::array<std::size_t, 4> kSpread{0, 1, 8, 9};
    std::size_t code = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto along = static_cast<int>((direction[axis] - low_[axis]) * per_cube_);
      code |= kSpread[static_cast<std::size_t>(along)] << axis;
    }
    return code;
  }

 private:
  std::array<float, 3> low_{1.0F, 1.0F, 1.0F};
  std::array<float, 3> high_{-1.0F, -1.0F, -1.0F};
  float per_cube_ = 0.0F;
};

}  // namespace

void test_occlusion(const RTCOccludedFunctionNArguments* arguments) {
  const auto& context = *reinterpret_cast<RayPacketTracer::Context*>(arguments->context);
  const auto& bricks = *static_cast<const OccupiedBricks*>(arguments->geometryUserPtr);
  const OccupiedBrick& brick = bricks[arguments->primID];
  // Embree hands on packets of native width as they came, lane by lane.
  assert(arguments->N == 4 || arguments->N == 8 || arguments->N == 16);
  __builtin_prefetch(&brick.occupied);
  std::uint32_t hits = context.kernels->intersect_box(
      context.packet, faces_of(brick.box), arguments->valid, arguments->N);
  for (; hits != 0; hits &= hits - 1) {
    const auto lane = static_cast<unsigned>(std::countr_zero(hits));
    if (!hits_occupied_voxel(brick, *context.rays[lane])) continue;
    RTCRayN_tfar(arguments->ray, arguments->N, lane) = -std::numeric_limits<float>::infinity();
  }
}

std::size_t widest_packet(RTCDevice device, std::size_t max_lanes) {
  const auto has = [&](RTCDeviceProperty native) {
    return rtcGetDeviceProperty(device, native) != 0;
  };
  if (max_lanes >= 16 && has(RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED)) return 16;
  if (max_lanes >= 8 && has(RTC_DEVICE_PROPERTY_NATIVE_RAY8_SUPPORTED)) return 8;
  return has(RTC_DEVICE_PROPERTY_NATIVE_RAY4_SUPPORTED) ? 4 : 0;
}

RayPacketTracer::RayPacketTracer(RTCScene scene, double voxels_per_m, std::size_t num_lanes)
    : scene_(scene), voxels_per_m_(voxels_per_m), num_lanes_(num_lanes) {
  rtcInitIntersectContext(&context_.embree);
  context_.kernels = &kernels::best_kernels();
}

std::uint64_t RayPacketTracer::hidden(std::span<const OcclusionRay> rays) {
  assert(rays.size() <= kMaxRays);
  prepare(rays);
  // With the coherent flag Embree bounds a packet as a whole before it tests each ray: for rays
  // from many places that costs a third, for those from one it gains a tenth, and their order as
  // much again.
  const bool together = have_common_origin(rays);
  context_.embree.flags =
      together ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  std::iota(order_.begin(), order_.end(), std::uint8_t{0});
  if (together && num_rays_ > num_lanes_) order_by_direction();
  std::uint64_t hidden = 0;
  for (std::size_t first = 0; first < num_rays_; first += num_lanes_) {
    hidden |= trace(first, std::min(num_lanes_, num_rays_ - first));
  }
  return hidden;
}

void RayPacketTracer::prepare(std::span<const OcclusionRay> rays) {
  num_rays_ = 0;
  for (std::size_t number = 0; number < rays.size(); ++number) {
    const OcclusionRay& ray = rays[number];
    const Eigen::Vector3d way = ray.to.xyz - ray.from.xyz;
    const double length_m = way.norm();
    const Eigen::Vector3d origin = ray.from.xyz * voxels_per_m_;
    const bool is_near = origin.cwiseAbs().maxCoeff() < kFarthest;
    // False for NaN, which makes the length NaN too.
    if (!(length_m > ray.margin_m) || !std::isfinite(length_m) || !is_near) continue;
    QueuedRay& into = rays_[num_rays_++];
    into.number = number;
    const Eigen::Vector3d direction = way * (1.0 / length_m);
    for (int i = 0; i < 3; ++i) {
      const auto axis = static_cast<std::size_t>(i);
      into.ray.origin[axis] = static_cast<float>(origin[i]);
      into.ray.direction[axis] = static_cast<float>(direction[i]);
      into.ray.inverse[axis] = inverse_of(into.ray.direction[axis]);
    }
    into.ray.end = static_cast<float>((length_m - ray.margin_m) * voxels_per_m_);
  }
}

void RayPacketTracer::order_by_direction() {
  const std::span<const QueuedRay> rays = std::span(rays_).first(num_rays_);
  DirectionCubes cubes;
  for (const QueuedRay& ray : rays) cubes.include(ray.ray.direction);
  cubes.close();
  std::array<std::uint8_t, kMaxRays> cube_of{};
  std::array<std::uint8_t, DirectionCubes::kNum + 1> begin{};
  for (std::size_t i = 0; i < rays.size(); ++i) {
    cube_of[i] = static_cast<std::uint8_t>(cubes.cube(rays[i].ray.direction));
    ++begin[cube_of[i] + std::size_t{1}];
  }
  std::partial_sum(begin.begin(), begin.end(), begin.begin(), [](std::uint8_t a, std::uint8_t b) {
    return static_cast<std::uint8_t>(a + b);
  });
  for (std::size_t i = 0; i < rays.size(); ++i) {
    order_[begin[cube_of[i]]++] = static_cast<std::uint8_t>(i);
  }
}

std::uint64_t RayPacketTracer::trace(std::size_t first, std::size_t size) {
  kernels::RayPacket& packet = context_.packet;
  for (std::size_t lane = 0; lane < size; ++lane) {
    const WalkedRay& ray = rays_[order_[first + lane]].ray;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      packet.origin[axis][lane] = ray.origin[axis];
      packet.direction[axis][lane] = ray.direction[axis];
      packet.inverse[axis][lane] = ray.inverse[axis];
    }
    packet.end[lane] = ray.end;
    context_.rays[lane] = &ray;
  }
  std::uint64_t hidden = 0;
  for (std::uint32_t rest = trace_packet(size); rest != 0; rest &= rest - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(rest));
    hidden |= std::uint64_t{1} << rays_[order_[first + lane]].number;
  }
  return hidden;
}

std::uint32_t RayPacketTracer::trace_packet(std::size_t size) {
  switch (num_lanes_) {
    case 16:
      return trace_packet_as<RTCRay16>(size, rtcOccluded16);
    case 8:
      return trace_packet_as<RTCRay8>(size, rtcOccluded8);
    default:
      return trace_packet_as<RTCRay4>(size, rtcOccluded4);
  }
}

template <class Rays, class Occluded>
std::uint32_t RayPacketTracer::trace_packet_as(std::size_t size, const Occluded& occluded) {
  constexpr std::size_t kLanes = sizeof(Rays::tfar) / sizeof(float);
  const kernels::RayPacket& packet = context_.packet;
  Rays rays{};
  std::copy_n(packet.origin[0], kLanes, rays.org_x);
  std::copy_n(packet.origin[1], kLanes, rays.org_y);
  std::copy_n(packet.origin[2], kLanes, rays.org_z);
  std::copy_n(packet.direction[0], kLanes, rays.dir_x);
  std::copy_n(packet.direction[1], kLanes, rays.dir_y);
  std::copy_n(packet.direction[2], kLanes, rays.dir_z);
  std::copy_n(packet.end, kLanes, rays.tfar);
  std::fill_n(rays.mask, kLanes, 0xFFFF'FFFFU);
  alignas(64) std::array<int, kLanes> valid{};
  std::fill_n(valid.begin(), size, -1);
  occluded(valid.data(), scene_, &context_.embree, &rays);
  std::uint32_t hidden = 0;
  for (std::size_t i = 0; i < size; ++i) hidden |= rays.tfar[i] < 0.0F ? 1U << i : 0U;
  return hidden;
}

}  // namespace hypermap
