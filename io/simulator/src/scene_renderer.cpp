// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/simulator/scene_renderer.hpp"

#include "embree_scene.hpp"
#include "ray_grid.hpp"
#include "scene/surface_color.hpp"
#include "silhouette.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr float kLampReachM = 7.0F;  // beyond it a lamp adds nothing
constexpr float kLampStrength = 0.75F;
constexpr float kShadowOffsetM = 2e-3F;
constexpr float kBrightest = 1.15F;

/// What a pixel shows, and how it is lit so far.
struct VisiblePoint {
  Vector3f in_map = Vector3f::Zero();
  Vector3f normal = Vector3f::UnitZ();  ///< Towards the camera.
  Vector3f color = Vector3f::Zero();
  float light = 0.0F;
  bool is_lit = false;  ///< False where nothing was hit, and on what shines by itself.
};
using SurfacePoints = std::array<VisiblePoint, EmbreeScene::kPacket>;

/// Light of a lamp that nothing is in the way of: a window over distance, and the angle.
float open_light(const Vector3f& lamp, const VisiblePoint& point) {
  const Vector3f to_lamp = lamp - point.in_map;
  const float distance = to_lamp.norm();
  if (!point.is_lit || distance >= kLampReachM) return 0.0F;
  const float nearness = 1.0F - distance * distance / (kLampReachM * kLampReachM);
  return kLampStrength * std::max(0.0F, point.normal.dot(to_lamp) / distance) * nearness * nearness;
}

/// What rays and lamps meet in one view.
struct Surroundings {
  const EmbreeScene& fixed;
  std::vector<PosedBody> bodies;

  [[nodiscard]] std::array<bool, EmbreeScene::kPacket> hidden(
      const Vector3f& lamp,
      const EmbreeScene::Packet& targets,
      const std::array<bool, EmbreeScene::kPacket>& wanted) const {
    auto result = fixed.hidden(lamp, targets, wanted);
    for (const PosedBody& body : bodies) {
      const auto by_body = body.shape->hidden(
          body.body_from_map * lamp, moved_by(body.body_from_map, targets), wanted);
      for (std::size_t i = 0; i < result.size(); ++i) result[i] = result[i] || by_body[i];
    }
    return result;
  }
};

/// Adds a lamp's light to the points that it reaches.
void add_lamp(const Surroundings& scene, const Vector3f& lamp, SurfacePoints& points) {
  std::array<float, EmbreeScene::kPacket> light{};
  std::array<bool, EmbreeScene::kPacket> reached{};
  EmbreeScene::Packet targets;
  for (std::size_t i = 0; i < points.size(); ++i) {
    light[i] = open_light(lamp, points[i]);
    reached[i] = light[i] > 0.0F;
    targets[i] = points[i].in_map + kShadowOffsetM * points[i].normal;
  }
  if (std::ranges::none_of(reached, std::identity{})) return;
  const auto hidden = scene.hidden(lamp, targets, reached);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!hidden[i]) points[i].light += light[i];
  }
}

Rgb8 to_rgb(const Vector3f& color) {
  const auto channel = [](float value) {
    return static_cast<std::uint8_t>(std::lround(255.0F * std::clamp(value, 0.0F, 1.0F)));
  };
  return {channel(color.x()), channel(color.y()), channel(color.z())};
}

}  // namespace

struct SceneRenderer::Impl {
  /// A mesh with what shading needs. Entry 0 is the room, entry i object i; bodies follow.
  struct Surface {
    TriangleMesh mesh;
    Eigen::Isometry3f shape_from_map = Eigen::Isometry3f::Identity();  ///< Not of bodies.
  };

  std::vector<Surface> surfaces;
  std::vector<Vector3f> lamps;
  EmbreeScene everything;          ///< Without the bodies.
  std::vector<EmbreeScene> alone;  ///< Each object and body by itself, by id - 1.
  std::size_t num_objects = 0;

  [[nodiscard]] Surroundings around(std::span<const Eigen::Isometry3d> map_from_bodies) const;
  void render_row(const Surroundings& scene, const RayGrid& rays, int v, RenderedView& view) const;
  /// Puts the bodies before what a packet of a row shows so far.
  void add_bodies(const Surroundings& scene,
                  const RayGrid& rays,
                  int first_u,
                  int v,
                  RenderedView& view,
                  SurfacePoints& points) const;
  /// Fills depth, incidence and instance of a pixel, and says what is there; none when something
  /// nearer is.
  [[nodiscard]] std::optional<VisiblePoint> measure(const RayGrid& rays,
                                                    int u,
                                                    int v,
                                                    const RayHit& hit,
                                                    const PosedBody* body,
                                                    RenderedView& view) const;
};

Surroundings SceneRenderer::Impl::around(std::span<const Eigen::Isometry3d> map_from_bodies) const {
  Surroundings result{everything, {}};
  for (std::size_t i = 0; i < map_from_bodies.size(); ++i)
    result.bodies.push_back(
        {&alone[num_objects + i], map_from_bodies[i], map_from_bodies[i].inverse().cast<float>()});
  return result;
}

std::optional<VisiblePoint> SceneRenderer::Impl::measure(const RayGrid& rays,
                                                         int u,
                                                         int v,
                                                         const RayHit& hit,
                                                         const PosedBody* body,
                                                         RenderedView& view) const {
  const Surface& surface = surfaces[hit.mesh];
  const auto in_map = [&](std::uint32_t vertex) -> Vector3d {
    const Vector3d point = surface.mesh.vertices[vertex].cast<double>();
    return body == nullptr ? point : body->map_from_body * point;
  };
  const auto& [a, b, c] = surface.mesh.triangles[hit.triangle];
  const Vector3d corner = in_map(a);
  const Vector3d normal = (in_map(b) - corner).cross(in_map(c) - corner).normalized();
  const Vector3d direction = rays.direction(u, v);
  const double slope = normal.dot(direction);
  const double depth = normal.dot(corner - rays.origin) / slope;
  if (!(depth > 0.0) || !std::isfinite(depth)) return std::nullopt;  // a triangle seen edge on
  const float known = view.depth_m.at(u, v);
  if (known > 0.0F && static_cast<double>(known) <= depth) return std::nullopt;
  view.depth_m.at(u, v) = static_cast<float>(depth);
  view.incidence_cos.at(u, v) = static_cast<float>(std::abs(slope) / direction.norm());
  view.instances.at(u, v) = ObjectId{hit.mesh};
  VisiblePoint point;
  point.in_map = (rays.origin + depth * direction).cast<float>();
  point.normal = (slope > 0.0 ? Vector3d(-normal) : normal).cast<float>();
  const SurfaceMaterial& material =
      surface.mesh.materials[surface.mesh.material_of_triangle[hit.triangle]];
  const Eigen::Isometry3f& shape_from_map =
      body == nullptr ? surface.shape_from_map : body->body_from_map;
  point.color = surface_color(
      material, shape_from_map * point.in_map, shape_from_map.linear() * point.normal);
  point.is_lit = !is_glowing(material);
  // Light from all around, thrown back by floor and ceiling.
  point.light = point.is_lit ? 0.4F + 0.12F * std::abs(point.normal.z()) : 1.0F;
  return point;
}

void SceneRenderer::Impl::add_bodies(const Surroundings& scene,
                                     const RayGrid& rays,
                                     int first_u,
                                     int v,
                                     RenderedView& view,
                                     SurfacePoints& points) const {
  const int inside = std::min(EmbreeScene::kPacket, rays.camera.width_px - first_u);
  for (std::size_t k = 0; k < scene.bodies.size(); ++k) {
    const PosedBody& body = scene.bodies[k];
    const auto hits =
        body.shape->nearest(body.body_from_map * rays.origin.cast<float>(),
                            turned_by(body.body_from_map, rays.packet(first_u, 1, v)));
    for (int i = 0; i < inside; ++i) {
      const auto& hit = hits[static_cast<std::size_t>(i)];
      if (!hit) continue;
      const RayHit of_body{static_cast<std::uint32_t>(num_objects + 1 + k), hit->triangle};
      if (const auto point = measure(rays, first_u + i, v, of_body, &body, view))
        points[static_cast<std::size_t>(i)] = *point;
    }
  }
}

void SceneRenderer::Impl::render_row(const Surroundings& scene,
                                     const RayGrid& rays,
                                     int v,
                                     RenderedView& view) const {
  const int width = rays.camera.width_px;
  for (int first = 0; first < width; first += EmbreeScene::kPacket) {
    const auto hits = everything.nearest(rays.origin.cast<float>(), rays.packet(first, 1, v));
    const auto inside = static_cast<std::size_t>(std::min(EmbreeScene::kPacket, width - first));
    SurfacePoints points;
    for (std::size_t i = 0; i < inside; ++i) {
      if (!hits[i]) continue;
      if (const auto point = measure(rays, first + static_cast<int>(i), v, *hits[i], nullptr, view))
        points[i] = *point;
    }
    add_bodies(scene, rays, first, v, view, points);
    for (const Vector3f& lamp : lamps) add_lamp(scene, lamp, points);
    for (std::size_t i = 0; i < inside; ++i)
      view.color.at(first + static_cast<int>(i), v) =
          to_rgb(points[i].color * std::min(points[i].light, kBrightest));
  }
}

SceneRenderer::SceneRenderer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
SceneRenderer::SceneRenderer(SceneRenderer&&) noexcept = default;
SceneRenderer& SceneRenderer::operator=(SceneRenderer&&) noexcept = default;
SceneRenderer::~SceneRenderer() = default;

Result<SceneRenderer> SceneRenderer::create(const FurnishedScene& scene,
                                            std::span<const TriangleMesh> bodies) {
  auto impl = std::make_unique<Impl>();
  impl->surfaces.push_back({scene.room, Eigen::Isometry3f::Identity()});
  for (const PlacedObject& object : scene.objects)
    impl->surfaces.push_back({object.mesh, object.map_from_object.inverse().cast<float>()});
  for (const Vector3d& lamp : scene.lights_in_map) impl->lamps.push_back(lamp.cast<float>());
  std::vector<const TriangleMesh*> meshes;
  for (const Impl::Surface& surface : impl->surfaces) meshes.push_back(&surface.mesh);
  HYPERMAP_ASSIGN_OR_RETURN(impl->everything, EmbreeScene::create(meshes));
  for (const PlacedObject& object : scene.objects) {
    HYPERMAP_ASSIGN_OR_RETURN(EmbreeScene alone, EmbreeScene::create(std::array{&object.mesh}));
    impl->alone.push_back(std::move(alone));
  }
  impl->num_objects = scene.objects.size();
  for (const TriangleMesh& body : bodies) {
    HYPERMAP_ASSIGN_OR_RETURN(EmbreeScene alone, EmbreeScene::create(std::array{&body}));
    impl->alone.push_back(std::move(alone));
    impl->surfaces.push_back({body, Eigen::Isometry3f::Identity()});
  }
  return SceneRenderer(std::move(impl));
}

RenderedView SceneRenderer::render(const PinholeCamera& camera,
                                   const MapFromCamera& map_from_camera,
                                   std::span<const Eigen::Isometry3d> map_from_bodies) const {
  RenderedView view{DepthImage(camera.width_px, camera.height_px),
                    Image<float>(camera.width_px, camera.height_px),
                    InstanceImage(camera.width_px, camera.height_px),
                    ColorImage(camera.width_px, camera.height_px)};
  const RayGrid rays(camera, map_from_camera);
  const Surroundings scene = impl_->around(map_from_bodies);
  const auto render_rows = [&](const tbb::blocked_range<int>& rows) {
    for (int v = rows.begin(); v < rows.end(); ++v) impl_->render_row(scene, rays, v, view);
  };
  // A thread that waits for rows must not begin another frame: that would pile up images.
  tbb::this_task_arena::isolate(
      [&] { tbb::parallel_for(tbb::blocked_range<int>(0, camera.height_px, 8), render_rows); });
  return view;
}

std::vector<double> SceneRenderer::unhidden_shares(
    const RenderedView& view,
    std::span<const ObjectId> objects,
    const PinholeCamera& camera,
    const MapFromCamera& map_from_camera,
    std::span<const Eigen::Isometry3d> map_from_bodies) const {
  const RayGrid rays(camera, map_from_camera);
  const Surroundings scene = impl_->around(map_from_bodies);
  std::vector<double> shares;
  shares.reserve(objects.size());
  for (const ObjectId id : objects) {
    const TriangleMesh& mesh = impl_->surfaces[id.value].mesh;
    const EmbreeScene& alone = impl_->alone[id.value - 1];
    LoneShape shape{mesh, alone, Eigen::Isometry3d::Identity(), Eigen::Isometry3f::Identity()};
    if (id.value > impl_->num_objects) {
      const PosedBody& body = scene.bodies[id.value - impl_->num_objects - 1];
      shape.map_from_mesh = body.map_from_body;
      shape.mesh_from_map = body.body_from_map;
    }
    shares.push_back(unhidden_share(shape, view.instances, id, rays));
  }
  return shares;
}

}  // namespace hypermap
