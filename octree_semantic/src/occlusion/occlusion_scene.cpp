// SPDX-License-Identifier: BSD-3-Clause
// This file and ray_packet are all of this folder that knows Embree (its API of version 3).
#include "hypermap/octree_semantic/occlusion/occlusion_scene.hpp"

#include "brick_walk.hpp"
#include "octree/brick_access.hpp"
#include "ray_packet.hpp"

#include <embree3/rtcore.h>
#include <tbb/blocked_range.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <string>
#include <unordered_map>
#include <utility>

namespace hypermap {
namespace {

/// Embree's test of a box is not exact at its faces: boxes are made larger by this part of a voxel,
/// and by this part of the coordinates.
constexpr float kInflateVoxels = 1e-3F;
constexpr float kInflateRelative = 1e-6F;
constexpr std::uint32_t kNowhere = 0xFFFF'FFFF;

struct DeviceRelease {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct SceneRelease {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using Device = std::unique_ptr<std::remove_pointer_t<RTCDevice>, DeviceRelease>;
using EmbreeScene = std::unique_ptr<std::remove_pointer_t<RTCScene>, SceneRelease>;

/// Bricks that lie together are one geometry: what changes in one is built again without the
/// others. Unit of the edge: bricks, as a power of two.
constexpr unsigned kRegionEdgeLog2 = 3;

/// The occupied bricks of one region.
struct Region {
  OccupiedBricks bricks;
  RTCGeometry geometry = nullptr;  // owned by the scene
  bool is_changed = false;
};

/// Called by Embree for each primitive when it builds its tree.
void write_bounds(const RTCBoundsFunctionArguments* arguments) {
  const auto& bricks = *static_cast<const OccupiedBricks*>(arguments->geometryUserPtr);
  const OccupiedBox& box = bricks[arguments->primID].box;
  RTCBounds& into = *arguments->bounds_o;
  const auto face = [&](std::size_t axis, float from_corner, float outward) {
    const float exact = box.corner[axis] + from_corner;
    return exact + outward * (kInflateVoxels + kInflateRelative * std::abs(exact));
  };
  // A box of nothing has low > high, which Embree leaves out.
  into.lower_x = face(0, box.low[0], -1.0F);
  into.lower_y = face(1, box.low[1], -1.0F);
  into.lower_z = face(2, box.low[2], -1.0F);
  into.upper_x = face(0, box.high[0], 1.0F);
  into.upper_y = face(1, box.high[1], 1.0F);
  into.upper_z = face(2, box.high[2], 1.0F);
}

/// Morton code of the region of a brick.
std::uint64_t region_of(BrickKey key) {
  return key.code >> (3 * kRegionEdgeLog2);
}

/// More than the machine has would only make TBB complain.
int num_threads_of(int asked_for) {
  return std::clamp(asked_for, 1, std::max(1, tbb::info::default_concurrency()));
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
  /// Where a brick of the tree is kept.
  struct Place {
    std::uint32_t region = kNowhere;
    std::uint32_t brick = 0;
  };

  std::size_t max_lanes = 0;
  Device device;
  EmbreeScene scene;  // null after a failure: nothing occludes
  std::size_t num_lanes = 0;
  std::vector<std::unique_ptr<Region>> regions;
  std::unordered_map<std::uint64_t, std::uint32_t> region_by_code;
  std::vector<std::uint32_t> changed_regions;
  std::vector<Place> place_of_position;  // of the tree's bricks
  std::size_t num_bricks = 0;
  double voxels_per_m = 1.0;
  Revision revision = 0;

  /// Makes device and empty scene. Errors: as OcclusionScene::create.
  Result<void> start();
  /// Takes what changed since `revision`. Returns how many bricks. Throws std::bad_alloc.
  Result<std::size_t> take_changes(const BrickTable& bricks, int num_threads);
  void take(std::uint32_t position, BrickKey key, const Brick& brick);
  /// The region of a brick, made when it is the first one there.
  std::uint32_t region_for(BrickKey key);
  void note_change(std::uint32_t region);
  void commit(int num_threads);
  /// What is left after a failure: no scene, to be started and filled anew.
  void forget() noexcept;
  /// Leaks scene and device after a failed build: releasing them would end the program
  /// (Embree 3.13).
  void leak_after_failure() noexcept {
    static_cast<void>(scene.release());
    static_cast<void>(device.release());
  }
};

Result<void> OcclusionScene::Scene::start() {
  device.reset(rtcNewDevice("set_affinity=0"));
  if (!device) {
    return fail(ErrorCode::kUnavailable,
                "Embree cannot start, error " + std::to_string(rtcGetDeviceError(nullptr)));
  }
  num_lanes = widest_packet(device.get(), max_lanes);
  if (num_lanes == 0) {
    return fail(ErrorCode::kUnavailable, "this Embree follows no rays together");
  }
  scene.reset(rtcNewScene(device.get()));
  // A tree over the regions, each of which has its own: the others are not built again with one.
  rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_DYNAMIC);
  rtcSetSceneBuildQuality(scene.get(), RTC_BUILD_QUALITY_LOW);
  rtcCommitScene(scene.get());
  auto built = check(device);
  if (!built) leak_after_failure();
  return built;
}

void OcclusionScene::Scene::forget() noexcept {
  scene.reset();
  device.reset();
  regions.clear();
  region_by_code.clear();
  changed_regions.clear();
  place_of_position.clear();
  num_bricks = 0;
  revision = 0;
}

std::uint32_t OcclusionScene::Scene::region_for(BrickKey key) {
  const std::uint64_t code = region_of(key);
  const auto found = region_by_code.find(code);
  if (found != region_by_code.end()) return found->second;
  auto region = std::make_unique<Region>();
  RTCGeometry geometry = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_MEDIUM);
  rtcSetGeometryUserData(geometry, &region->bricks);
  rtcSetGeometryBoundsFunction(geometry, write_bounds, nullptr);
  rtcSetGeometryOccludedFunction(geometry, test_occlusion);
  rtcAttachGeometry(scene.get(), geometry);
  rtcReleaseGeometry(geometry);
  region->geometry = geometry;
  regions.push_back(std::move(region));
  const auto number = static_cast<std::uint32_t>(regions.size() - 1);
  region_by_code.emplace(code, number);
  return number;
}

void OcclusionScene::Scene::note_change(std::uint32_t region) {
  if (regions[region]->is_changed) return;
  changed_regions.push_back(region);
  regions[region]->is_changed = true;
}

void OcclusionScene::Scene::take(std::uint32_t position, BrickKey key, const Brick& brick) {
  Place& place = place_of_position[position];
  if (place.region == kNowhere) {
    if (!brick.occupied.any()) return;
    const std::uint32_t number = region_for(key);
    std::vector<OccupiedBrick>& bricks = regions[number]->bricks;
    const VoxelKey corner = key.corner();
    const auto from_origin = [](std::uint16_t at) { return static_cast<float>(at - kOriginKey); };
    bricks.emplace_back().box.corner = {
        from_origin(corner.x), from_origin(corner.y), from_origin(corner.z)};
    place = {number, static_cast<std::uint32_t>(bricks.size() - 1)};
    ++num_bricks;
  }
  note_change(place.region);
  OccupiedBrick& mine = regions[place.region]->bricks[place.brick];
  mine.occupied = brick.occupied;
  fit_box(mine);
}

/// Builds the changed regions, and the tree over all of them.
void OcclusionScene::Scene::commit(int num_threads) {
  for (const std::uint32_t number : changed_regions) {
    Region& region = *regions[number];
    rtcSetGeometryUserPrimitiveCount(region.geometry, static_cast<unsigned>(region.bricks.size()));
    rtcCommitGeometry(region.geometry);
    region.is_changed = false;
  }
  changed_regions.clear();
  // Embree builds on the threads of the arena that it is called in.
  tbb::task_arena arena(num_threads_of(num_threads));
  arena.execute([this] { rtcCommitScene(scene.get()); });
}

Result<std::size_t> OcclusionScene::Scene::take_changes(const BrickTable& bricks, int num_threads) {
  const std::vector<std::uint32_t> changed = bricks.changed_since(revision);
  if (changed.empty()) return std::size_t{0};
  place_of_position.resize(bricks.size());
  for (std::size_t i = 0; i < changed.size(); ++i) {
    // The bricks lie far apart in memory.
    constexpr std::size_t kAhead = 16;
    const std::size_t ahead = std::min(i + kAhead, changed.size() - 1);
    __builtin_prefetch(&bricks.brick(changed[ahead]).occupied);
    take(changed[i], bricks.key(changed[i]), bricks.brick(changed[i]));
  }
  revision = bricks.revision();
  commit(num_threads);
  if (auto built = check(device); !built) {
    leak_after_failure();
    return Unexpected(std::move(built).error());
  }
  return changed.size();
}

OcclusionScene::OcclusionScene(std::unique_ptr<Scene> scene) : scene_(std::move(scene)) {}
OcclusionScene::OcclusionScene(OcclusionScene&&) noexcept = default;
OcclusionScene& OcclusionScene::operator=(OcclusionScene&&) noexcept = default;
OcclusionScene::~OcclusionScene() = default;

Result<OcclusionScene> OcclusionScene::create(std::size_t max_lanes) {
  auto made = std::make_unique<Scene>();
  made->max_lanes = max_lanes;
  HYPERMAP_TRY(made->start());
  return OcclusionScene(std::move(made));
}

Result<std::size_t> OcclusionScene::update(const SemanticOctree& tree, int num_threads) {
  try {
    if (!scene_->scene) HYPERMAP_TRY(scene_->start());
    scene_->voxels_per_m = 1.0 / tree.resolution_m();
    auto taken = scene_->take_changes(BrickAccess::bricks(tree), num_threads);
    if (!taken) scene_->forget();
    return taken;
  } catch (const std::bad_alloc&) {
    scene_->forget();
    return fail(ErrorCode::kOutOfMemory, "no memory for the occlusion scene");
  }
}

bool OcclusionScene::occluded(const OcclusionRay& ray) const {
  if (!scene_->scene) return false;
  RayPacketTracer tracer(scene_->scene.get(), scene_->voxels_per_m, scene_->num_lanes);
  return tracer.hidden({&ray, 1}) != 0;
}

std::vector<std::uint8_t> OcclusionScene::occluded(std::span<const OcclusionRay> rays,
                                                   int num_threads) const {
  std::vector<std::uint8_t> results(rays.size());
  if (!scene_->scene) return results;
  const auto trace = [&](std::size_t first, std::size_t last) {
    RayPacketTracer tracer(scene_->scene.get(), scene_->voxels_per_m, scene_->num_lanes);
    for (std::size_t i = first; i < last; i += RayPacketTracer::kMaxRays) {
      const std::size_t size = std::min(RayPacketTracer::kMaxRays, last - i);
      const std::uint64_t hidden = tracer.hidden(rays.subspan(i, size));
      for (std::size_t k = 0; k < size; ++k) results[i + k] = hidden >> k & 1U;
    }
  };
  constexpr std::size_t kChunk = 1024;
  if (num_threads <= 1 || rays.size() <= kChunk) {
    trace(0, rays.size());
    return results;
  }
  tbb::task_arena arena(num_threads_of(num_threads));
  arena.execute([&] {
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, rays.size(), kChunk),
        [&](const tbb::blocked_range<std::size_t>& range) { trace(range.begin(), range.end()); });
  });
  return results;
}

std::size_t OcclusionScene::num_bricks() const noexcept {
  return scene_->num_bricks;
}

}  // namespace hypermap
