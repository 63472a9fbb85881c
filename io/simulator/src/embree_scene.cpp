// SPDX-License-Identifier: BSD-3-Clause
#include "embree_scene.hpp"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cstddef>
#include <limits>

namespace hypermap {
namespace {

RTCScene scene_of(const std::shared_ptr<void>& handle) {
  return static_cast<RTCScene>(handle.get());
}

bool attach(RTCDevice device, RTCScene scene, const TriangleMesh& mesh, unsigned position) {
  const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry,
                                                               RTC_BUFFER_TYPE_VERTEX,
                                                               0,
                                                               RTC_FORMAT_FLOAT3,
                                                               3 * sizeof(float),
                                                               mesh.vertices.size()));
  auto* triangles = static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry,
                                                                   RTC_BUFFER_TYPE_INDEX,
                                                                   0,
                                                                   RTC_FORMAT_UINT3,
                                                                   3 * sizeof(unsigned),
                                                                   mesh.triangles.size()));
  const bool allocated = vertices != nullptr && triangles != nullptr;
  if (allocated) {
    for (const Eigen::Vector3f& vertex : mesh.vertices)
      vertices = std::copy_n(vertex.data(), 3, vertices);
    for (const auto& triangle : mesh.triangles)
      triangles = std::copy(triangle.begin(), triangle.end(), triangles);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene, geometry, position);
  }
  rtcReleaseGeometry(geometry);
  return allocated;
}

void set_ray(RTCRay8& rays,
             std::size_t i,
             const Eigen::Vector3f& origin,
             const Eigen::Vector3f& direction,
             float farthest) {
  rays.org_x[i] = origin.x();
  rays.org_y[i] = origin.y();
  rays.org_z[i] = origin.z();
  rays.dir_x[i] = direction.x();
  rays.dir_y[i] = direction.y();
  rays.dir_z[i] = direction.z();
  rays.tnear[i] = 1e-3F;
  rays.tfar[i] = farthest;
  rays.mask[i] = ~0U;
}

RTCIntersectContext coherent_context() {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  return context;
}

Unexpected no_memory_for_triangles() {
  return fail(ErrorCode::kOutOfMemory, "no memory for the scene's triangles", "embree");
}

Unexpected refused(const char* what) {
  return fail(ErrorCode::kUnavailable, what, "embree");
}

}  // namespace

Result<EmbreeScene> EmbreeScene::create(std::span<const TriangleMesh* const> meshes) {
  const RTCDevice device = rtcNewDevice(nullptr);
  if (device == nullptr) return refused("gives no device");
  const RTCScene scene = rtcNewScene(device);
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  bool complete = true;
  for (unsigned i = 0; i < meshes.size(); ++i) {
    if (meshes[i]->triangles.empty()) continue;
    complete = attach(device, scene, *meshes[i], i) && complete;
  }
  rtcCommitScene(scene);
  const RTCError error = rtcGetDeviceError(device);
  if (!complete || error != RTC_ERROR_NONE) {
    // Kept for ever: releasing a scene whose build failed ends the program (Embree 3.13).
    if (error == RTC_ERROR_OUT_OF_MEMORY) return no_memory_for_triangles();
    return refused("cannot hold the scene's triangles");
  }
  EmbreeScene result;
  // The device outlives its scene, which does not keep it (Embree 3.13).
  result.scene_ = std::shared_ptr<void>(scene, [device](void* owned) {
    rtcReleaseScene(static_cast<RTCScene>(owned));
    rtcReleaseDevice(device);
  });
  return result;
}

std::array<std::optional<RayHit>, EmbreeScene::kPacket> EmbreeScene::nearest(
    const Eigen::Vector3f& origin, const Packet& directions) const {
  RTCRayHit8 packet{};
  alignas(32) std::array<int, kPacket> valid{};
  for (std::size_t i = 0; i < directions.size(); ++i) {
    valid[i] = -1;
    set_ray(packet.ray, i, origin, directions[i], std::numeric_limits<float>::infinity());
    packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
  RTCIntersectContext context = coherent_context();
  rtcIntersect8(valid.data(), scene_of(scene_), &context, &packet);
  std::array<std::optional<RayHit>, kPacket> hits;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (packet.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID)
      hits[i] = RayHit{packet.hit.geomID[i], packet.hit.primID[i]};
  }
  return hits;
}

std::array<bool, EmbreeScene::kPacket> EmbreeScene::hidden(
    const Eigen::Vector3f& origin,
    const Packet& targets,
    const std::array<bool, kPacket>& wanted) const {
  constexpr float kBeforeTarget = 0.999F;
  RTCRay8 rays{};
  alignas(32) std::array<int, kPacket> valid{};
  for (std::size_t i = 0; i < targets.size(); ++i) {
    valid[i] = wanted[i] ? -1 : 0;
    set_ray(rays, i, origin, targets[i] - origin, kBeforeTarget);
  }
  RTCIntersectContext context = coherent_context();
  rtcOccluded8(valid.data(), scene_of(scene_), &context, &rays);
  std::array<bool, kPacket> result{};
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = wanted[i] && rays.tfar[i] < 0.0F;
  return result;
}

}  // namespace hypermap
