// SPDX-License-Identifier: BSD-3-Clause
// The only file of this folder that knows Embree (its API of version 3).
#include "hypermap/octree_semantic/occlusion_scene.hpp"

#include "brick_walk.hpp"

#include <embree3/rtcore.h>
#include <tbb/blocked_range.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <string>

namespace hypermap {
namespace {

/// Embree's boxes are single precision and its test is not exact at their faces: they are made
/// larger by this part of a voxel, and by this part of the coordinates.
constexpr double kInflateVoxels = 1e-3;
constexpr double kInflateRelative = 1e-6;
constexpr std::uint32_t kNoPrimitive = 0xFFFF'FFFF;

struct DeviceRelease {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct SceneRelease {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using Device = std::unique_ptr<std::remove_pointer_t<RTCDevice>, DeviceRelease>;
using EmbreeScene = std::unique_ptr<std::remove_pointer_t<RTCScene>, SceneRelease>;

/// Occupied bricks, and the length that their whole numbers stand for.
struct Primitives {
  std::vector<OccupiedBrick> bricks;
  double resolution_m = 1.0;
};

/// Called by Embree for each primitive when it builds its tree.
void give_bounds(const RTCBoundsFunctionArguments* arguments) {
  const auto& primitives = *static_cast<const Primitives*>(arguments->geometryUserPtr);
  const VoxelBounds bounds = bounds_of(primitives.bricks[arguments->primID]);
  RTCBounds& into = *arguments->bounds_o;
  const auto face = [&](int voxel, double outward) {
    const double exact = voxel * primitives.resolution_m;
    const double margin =
        kInflateVoxels * primitives.resolution_m + kInflateRelative * std::abs(exact);
    return static_cast<float>(exact + outward * margin);
  };
  // An empty brick has min > max, which Embree leaves out.
  into.lower_x = face(bounds.min[0], -1.0);
  into.lower_y = face(bounds.min[1], -1.0);
  into.lower_z = face(bounds.min[2], -1.0);
  into.upper_x = face(bounds.max[0], 1.0);
  into.upper_y = face(bounds.max[1], 1.0);
  into.upper_z = face(bounds.max[2], 1.0);
}

/// Called by Embree when a ray reaches a primitive's bounds: is a voxel hit within?
void test_occlusion(const RTCOccludedFunctionNArguments* arguments) {
  const auto& primitives = *static_cast<const Primitives*>(arguments->geometryUserPtr);
  const OccupiedBrick& brick = primitives.bricks[arguments->primID];
  for (unsigned i = 0; i < arguments->N; ++i) {
    if (arguments->valid[i] == 0) continue;
    RTCRayN* rays = arguments->ray;
    const WalkedRay ray{.origin = {RTCRayN_org_x(rays, arguments->N, i),
                                   RTCRayN_org_y(rays, arguments->N, i),
                                   RTCRayN_org_z(rays, arguments->N, i)},
                        .direction = {RTCRayN_dir_x(rays, arguments->N, i),
                                      RTCRayN_dir_y(rays, arguments->N, i),
                                      RTCRayN_dir_z(rays, arguments->N, i)},
                        .first = RTCRayN_tnear(rays, arguments->N, i),
                        .last = RTCRayN_tfar(rays, arguments->N, i)};
    if (meets_occupied(brick, primitives.resolution_m, ray)) {
      RTCRayN_tfar(rays, arguments->N, i) = -std::numeric_limits<float>::infinity();
    }
  }
}

Result<void> check(const Device& device) {
  const RTCError error = rtcGetDeviceError(device.get());
  if (error == RTC_ERROR_NONE) return {};
  const ErrorCode code =
      error == RTC_ERROR_OUT_OF_MEMORY ? ErrorCode::kOutOfMemory : ErrorCode::kUnavailable;
  return fail(code, "Embree reports error " + std::to_string(static_cast<int>(error)));
}

}  // namespace

struct OcclusionScene::Scene {
  Device device;
  EmbreeScene scene;
  RTCGeometry geometry = nullptr;  // owned by the scene
  Primitives primitives;
  std::vector<std::uint32_t> primitive_of_position;  // of the tree's bricks
  Revision revision = 0;

  void take(std::uint32_t position, BrickKey key, const Brick& brick);

  /// After a failed build: releasing the scene would then end the program (Embree 3.13).
  void keep_for_ever() {
    static_cast<void>(scene.release());
    static_cast<void>(device.release());
  }
};

void OcclusionScene::Scene::take(std::uint32_t position, BrickKey key, const Brick& brick) {
  std::uint32_t& primitive = primitive_of_position[position];
  if (primitive == kNoPrimitive) {
    if (!brick.occupied.any()) return;
    primitive = static_cast<std::uint32_t>(primitives.bricks.size());
    const VoxelKey corner = key.corner();
    primitives.bricks.push_back(
        {.corner = {corner.x - kOriginKey, corner.y - kOriginKey, corner.z - kOriginKey},
         .occupied = {}});
  }
  primitives.bricks[primitive].occupied = brick.occupied.words;
}

OcclusionScene::OcclusionScene(std::unique_ptr<Scene> scene) : scene_(std::move(scene)) {}
OcclusionScene::OcclusionScene(OcclusionScene&&) noexcept = default;
OcclusionScene& OcclusionScene::operator=(OcclusionScene&&) noexcept = default;
OcclusionScene::~OcclusionScene() = default;

Result<OcclusionScene> OcclusionScene::create() {
  auto made = std::make_unique<Scene>();
  made->device.reset(rtcNewDevice("set_affinity=0"));
  if (!made->device) {
    return fail(ErrorCode::kUnavailable,
                "Embree cannot start, error " + std::to_string(rtcGetDeviceError(nullptr)));
  }
  made->scene.reset(rtcNewScene(made->device.get()));
  rtcSetSceneFlags(made->scene.get(), RTC_SCENE_FLAG_DYNAMIC);
  // The build by Morton codes: some milliseconds for a million voxels.
  rtcSetSceneBuildQuality(made->scene.get(), RTC_BUILD_QUALITY_LOW);
  RTCGeometry geometry = rtcNewGeometry(made->device.get(), RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_LOW);
  rtcSetGeometryUserData(geometry, &made->primitives);
  rtcSetGeometryBoundsFunction(geometry, give_bounds, nullptr);
  rtcSetGeometryOccludedFunction(geometry, test_occlusion);
  rtcSetGeometryUserPrimitiveCount(geometry, 0);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(made->scene.get(), geometry);
  rtcReleaseGeometry(geometry);
  made->geometry = geometry;
  rtcCommitScene(made->scene.get());
  if (auto built = check(made->device); !built) {
    made->keep_for_ever();
    return Unexpected(std::move(built).error());
  }
  return OcclusionScene(std::move(made));
}

Result<std::size_t> OcclusionScene::update(const SemanticOctree& tree) {
  const BrickTable& bricks = tree.bricks();
  try {
    const std::vector<std::uint32_t> changed = bricks.changed_since(scene_->revision);
    if (changed.empty()) return std::size_t{0};
    scene_->primitives.resolution_m = tree.resolution_m();
    scene_->primitive_of_position.resize(bricks.size(), kNoPrimitive);
    for (const std::uint32_t position : changed) {
      scene_->take(position, bricks.key(position), bricks.brick(position));
    }
    scene_->revision = bricks.revision();
    rtcSetGeometryUserPrimitiveCount(scene_->geometry,
                                     static_cast<unsigned>(scene_->primitives.bricks.size()));
    rtcCommitGeometry(scene_->geometry);
    rtcCommitScene(scene_->scene.get());
    if (auto built = check(scene_->device); !built) {
      scene_->keep_for_ever();
      return Unexpected(std::move(built).error());
    }
    return changed.size();
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::kOutOfMemory, "no memory for the occlusion scene");
  }
}

bool OcclusionScene::occluded(const PointInMap& from, const PointInMap& to, double margin_m) const {
  const Eigen::Vector3d way = to.xyz - from.xyz;
  const double length_m = way.norm();
  if (!(length_m > margin_m) || !std::isfinite(length_m) || !from.xyz.allFinite()) return false;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRay ray{};
  ray.org_x = static_cast<float>(from.xyz.x());
  ray.org_y = static_cast<float>(from.xyz.y());
  ray.org_z = static_cast<float>(from.xyz.z());
  ray.dir_x = static_cast<float>(way.x() / length_m);
  ray.dir_y = static_cast<float>(way.y() / length_m);
  ray.dir_z = static_cast<float>(way.z() / length_m);
  ray.tnear = 0.0F;
  ray.tfar = static_cast<float>(length_m - margin_m);
  ray.mask = 0xFFFF'FFFF;
  rtcOccluded1(scene_->scene.get(), &context, &ray);
  return ray.tfar < 0.0F;
}

std::vector<std::uint8_t> OcclusionScene::occluded(std::span<const SightLine> lines,
                                                   double margin_m,
                                                   int num_threads) const {
  std::vector<std::uint8_t> answers(lines.size());
  const auto answer = [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      answers[i] = occluded(lines[i].from, lines[i].to, margin_m) ? 1 : 0;
    }
  };
  constexpr std::size_t kChunk = 1024;
  if (num_threads <= 1 || lines.size() <= kChunk) {
    answer(0, lines.size());
    return answers;
  }
  tbb::task_arena arena(std::min(num_threads, tbb::info::default_concurrency()));
  arena.execute([&] {
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, lines.size(), kChunk),
        [&](const tbb::blocked_range<std::size_t>& range) { answer(range.begin(), range.end()); });
  });
  return answers;
}

std::size_t OcclusionScene::num_bricks() const noexcept {
  return scene_->primitives.bricks.size();
}

}  // namespace hypermap
