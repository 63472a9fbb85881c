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

Unexpected refused(const char* what) {
  return fail(ErrorCode::kUnavailable, what, "embree");
}

}  // namespace

Result<EmbreeScene> EmbreeScene::create(std::span<const TriangleMesh* const> meshes) {
  const RTCDevice device = rtcNewDevice(nullptr);
  if (device == nullptr) return refused("gives no device");
  EmbreeScene result;
  // The scene holds its device, so that releasing the scene is enough.
  result.scene_ = std::shared_ptr<void>(
      rtcNewScene(device), [](void* scene) { rtcReleaseScene(static_cast<RTCScene>(scene)); });
  const RTCScene scene = scene_of(result.scene_);
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  bool complete = true;
  for (unsigned i = 0; i < meshes.size(); ++i) {
    if (meshes[i]->triangles.empty()) continue;
    complete = attach(device, scene, *meshes[i], i) && complete;
  }
  rtcCommitScene(scene);
  const bool failed = !complete || rtcGetDeviceError(device) != RTC_ERROR_NONE;
  rtcReleaseDevice(device);
  if (failed) return refused("cannot hold the scene's triangles");
  return result;
}

std::array<std::optional<RayHit>, EmbreeScene::kPacket> EmbreeScene::nearest(
    const Eigen::Vector3f& origin, const std::array<Eigen::Vector3f, kPacket>& directions) const {
  RTCRayHit8 packet{};
  alignas(32) std::array<int, kPacket> valid{};
  for (std::size_t i = 0; i < directions.size(); ++i) {
    valid[i] = -1;
    packet.ray.org_x[i] = origin.x();
    packet.ray.org_y[i] = origin.y();
    packet.ray.org_z[i] = origin.z();
    packet.ray.dir_x[i] = directions[i].x();
    packet.ray.dir_y[i] = directions[i].y();
    packet.ray.dir_z[i] = directions[i].z();
    packet.ray.tnear[i] = 1e-3F;
    packet.ray.tfar[i] = std::numeric_limits<float>::infinity();
    packet.ray.mask[i] = ~0U;
    packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect8(valid.data(), scene_of(scene_), &context, &packet);
  std::array<std::optional<RayHit>, kPacket> hits;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (packet.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID)
      hits[i] = RayHit{packet.hit.geomID[i], packet.hit.primID[i]};
  }
  return hits;
}

bool EmbreeScene::is_blocked(const Eigen::Vector3f& from, const Eigen::Vector3f& reach) const {
  RTCRay ray{};
  ray.org_x = from.x();
  ray.org_y = from.y();
  ray.org_z = from.z();
  ray.dir_x = reach.x();
  ray.dir_y = reach.y();
  ray.dir_z = reach.z();
  ray.tfar = 1.0F;
  ray.mask = ~0U;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(scene_of(scene_), &context, &ray);
  return ray.tfar < 0.0F;
}

}  // namespace hypermap
