// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/simulator/scene.hpp"

#include "hypermap/core/base/random_numbers.hpp"
#include "hypermap/io/simulator/furniture.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <utility>

namespace hypermap {
namespace {

constexpr std::uint64_t kJitterStream = 0x6a6974746572;  // which numbers: "jitter"
constexpr double kJitterShareOnOthers = 0.4;

using Objects = std::vector<PlacedObject>;

/// Where the object stands: a frame level with the floor, with the top of what bears it or with
/// the foot of what it stands beside.
Result<Eigen::Isometry3d> map_from_support(const SceneObject& object, const Objects& placed) {
  if (object.on.empty() && object.beside.empty()) return Eigen::Isometry3d::Identity();
  if (!object.on.empty() && !object.beside.empty())
    return fail(ErrorCode::kInvalidArgument, "must not be given together with `on`", "beside");
  const std::string field = object.on.empty() ? "beside" : "on";
  const std::string& name = object.on.empty() ? object.beside : object.on;
  const auto bearer = std::ranges::find(placed, name, &PlacedObject::name);
  if (bearer == placed.end())
    return fail(
        ErrorCode::kNotFound,
        "stands " + field + " " + printable(name) + ", which is no object before it in the list",
        field);
  if (object.on.empty()) return bearer->map_from_object;
  return bearer->map_from_object *
         Eigen::Translation3d(0.0, 0.0, bearer->box.max_in_map.z() - bearer->box.min_in_map.z());
}

/// The object's pose on its support, moved a little by the seed.
Eigen::Isometry3d support_from_object(const Scene& scene,
                                      const SceneObject& object,
                                      std::uint64_t seed,
                                      std::size_t index) {
  double share = object.on.empty() && object.beside.empty() ? 1.0 : kJitterShareOnOthers;
  if (!object.movable || seed == 0) share = 0.0;
  CounterRng random(seed, kJitterStream, index);
  const auto jitter = [&](double limit) { return share * random.uniform(-limit, limit); };
  const double x = object.position_m.x() + jitter(scene.position_jitter_m);
  const double y = object.position_m.y() + jitter(scene.position_jitter_m);
  const double yaw = object.yaw_rad + jitter(scene.yaw_jitter_rad);
  return Eigen::Translation3d(x, y, object.height_m) *
         Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ());
}

Result<PlacedObject> place(const Scene& scene,
                           std::size_t index,
                           const Objects& placed,
                           std::uint64_t seed) {
  const SceneObject& object = scene.objects[index];
  if (std::ranges::find(placed, object.name, &PlacedObject::name) != placed.end())
    return fail(ErrorCode::kInvalidArgument, "another object has this name", "name");
  HYPERMAP_ASSIGN_OR_RETURN(TriangleMesh mesh,
                            build_furniture({object.shape, object.size_m, object.colors}));
  HYPERMAP_ASSIGN_OR_RETURN(const Eigen::Isometry3d support, map_from_support(object, placed));
  PlacedObject result;
  result.id = ObjectId{static_cast<std::uint32_t>(index + 1)};
  result.name = object.name;
  result.class_name = object.class_name;
  result.map_from_object = support * support_from_object(scene, object, seed, index);
  result.mesh = transformed(std::move(mesh), result.map_from_object);
  result.box = bounds(result.mesh);
  HYPERMAP_ASSIGN_OR_RETURN(result.footprint, footprint(result.mesh));
  result.centroid_in_map << centroid(result.footprint), result.box.centre().z();
  return result;
}

void add_walls(MeshBuilder& mesh, const Ring& ring, double height_m) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Eigen::Vector2d& a = ring[i];
    const Eigen::Vector2d& b = ring[(i + 1) % ring.size()];
    mesh.sheet(std::array{Eigen::Vector3d(a.x(), a.y(), 0.0),
                          Eigen::Vector3d(b.x(), b.y(), 0.0),
                          Eigen::Vector3d(b.x(), b.y(), height_m),
                          Eigen::Vector3d(a.x(), a.y(), height_m)});
  }
}

/// Floor and ceiling reach over the bounding rectangle; what lies beyond the walls is not seen.
void add_level(MeshBuilder& mesh, const Rect& rect, double height_m) {
  mesh.sheet(std::array{Eigen::Vector3d(rect.min.x(), rect.min.y(), height_m),
                        Eigen::Vector3d(rect.max.x(), rect.min.y(), height_m),
                        Eigen::Vector3d(rect.max.x(), rect.max.y(), height_m),
                        Eigen::Vector3d(rect.min.x(), rect.max.y(), height_m)});
}

TriangleMesh build_room(const Scene& scene) {
  MeshBuilder mesh;
  const Rect rect = bounds(scene.floor);
  add_level(mesh.material(scene.floor_material), rect, 0.0);
  add_level(mesh.material(scene.ceiling_material), rect, scene.wall_height_m);
  mesh.material(scene.wall_material);
  add_walls(mesh, scene.floor.outer, scene.wall_height_m);
  for (const Ring& hole : scene.floor.holes) add_walls(mesh, hole, scene.wall_height_m);
  for (const SceneFixture& fixture : scene.fixtures)
    mesh.material(fixture.material).box(fixture.box.min_in_map, fixture.box.max_in_map);
  return mesh.build();
}

std::vector<Eigen::Vector3d> lights_of(const Scene& scene) {
  if (!scene.lights_in_map.empty()) return scene.lights_in_map;
  const Eigen::Vector2d middle = centroid(scene.floor);
  return {{middle.x(), middle.y(), scene.wall_height_m - 0.1}};
}

}  // namespace

Result<FurnishedScene> furnish(const Scene& scene, std::uint64_t seed) {
  FurnishedScene result;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    auto object = place(scene, i, result.objects, seed);
    if (!object) {
      object.error().entry = scene.objects[i].name;
      return tl::make_unexpected(std::move(object).error());
    }
    result.objects.push_back(*std::move(object));
  }
  result.room = build_room(scene);
  result.lights_in_map = lights_of(scene);
  return result;
}

}  // namespace hypermap
