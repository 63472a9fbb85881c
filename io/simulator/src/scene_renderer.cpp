// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/simulator/scene_renderer.hpp"

#include "embree_scene.hpp"
#include "hypermap/core/segmentation/detection.hpp"
#include "scene/surface_color.hpp"

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
constexpr double kSilhouetteMargin = 1.0;      // of the image's size, on each side
constexpr double kSilhouetteSamples = 4096.0;  // wanted number of grid points per object

/// The rays of a view: direction (u, v) reaches 1 m of depth at parameter 1.
struct RayGrid {
  Vector3d origin;
  Eigen::Matrix3d map_from_camera;
  PinholeCamera camera;

  RayGrid(const PinholeCamera& pinhole, const MapFromCamera& pose)
      : origin(pose.isometry().translation()),
        map_from_camera(pose.isometry().linear()),
        camera(pinhole) {}

  [[nodiscard]] Vector3d direction(double u, double v) const {
    return map_from_camera * camera.unproject(u, v, 1.0).xyz;
  }

  /// Rays through pixels (u, v), (u + step, v), ...
  [[nodiscard]] EmbreeScene::Packet packet(int u, int step, int v) const {
    EmbreeScene::Packet directions;
    for (int i = 0; i < EmbreeScene::kPacket; ++i)
      directions[static_cast<std::size_t>(i)] = direction(u + i * step, v).cast<float>();
    return directions;
  }
};

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

/// Adds a lamp's light to the points that it reaches.
void add_lamp(const EmbreeScene& scene, const Vector3f& lamp, SurfacePoints& points) {
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
  /// A mesh with what shading needs. Entry 0 is the room, entry i object i.
  struct Surface {
    TriangleMesh mesh;
    Eigen::Isometry3f shape_from_map = Eigen::Isometry3f::Identity();
  };

  std::vector<Surface> surfaces;
  std::vector<Vector3f> lamps;
  EmbreeScene everything;
  std::vector<EmbreeScene> alone;  ///< Each object by itself, by id - 1.

  void render_row(const RayGrid& rays, int v, RenderedView& view) const;
  /// Fills depth, incidence and instance of a pixel, and says what is there.
  [[nodiscard]] VisiblePoint measure(
      const RayGrid& rays, int u, int v, const RayHit& hit, RenderedView& view) const;
};

VisiblePoint SceneRenderer::Impl::measure(
    const RayGrid& rays, int u, int v, const RayHit& hit, RenderedView& view) const {
  const Surface& surface = surfaces[hit.mesh];
  const auto& [a, b, c] = surface.mesh.triangles[hit.triangle];
  const Vector3d corner = surface.mesh.vertices[a].cast<double>();
  const Vector3d normal = (surface.mesh.vertices[b].cast<double>() - corner)
                              .cross(surface.mesh.vertices[c].cast<double>() - corner)
                              .normalized();
  const Vector3d direction = rays.direction(u, v);
  const double slope = normal.dot(direction);
  const double depth = normal.dot(corner - rays.origin) / slope;
  if (!(depth > 0.0) || !std::isfinite(depth)) return {};  // grazed a triangle seen edge on
  view.depth_m.at(u, v) = static_cast<float>(depth);
  view.incidence_cos.at(u, v) = static_cast<float>(std::abs(slope) / direction.norm());
  view.instances.at(u, v) = ObjectId{hit.mesh};
  VisiblePoint point;
  point.in_map = (rays.origin + depth * direction).cast<float>();
  point.normal = (slope > 0.0 ? Vector3d(-normal) : normal).cast<float>();
  const SurfaceMaterial& material =
      surface.mesh.materials[surface.mesh.material_of_triangle[hit.triangle]];
  point.color = surface_color(material,
                              surface.shape_from_map * point.in_map,
                              surface.shape_from_map.linear() * point.normal);
  point.is_lit = !is_glowing(material);
  // Light from all around, thrown back by floor and ceiling.
  point.light = point.is_lit ? 0.4F + 0.12F * std::abs(point.normal.z()) : 1.0F;
  return point;
}

void SceneRenderer::Impl::render_row(const RayGrid& rays, int v, RenderedView& view) const {
  const int width = rays.camera.width_px;
  for (int first = 0; first < width; first += EmbreeScene::kPacket) {
    const auto hits = everything.nearest(rays.origin.cast<float>(), rays.packet(first, 1, v));
    const auto inside = static_cast<std::size_t>(std::min(EmbreeScene::kPacket, width - first));
    SurfacePoints points;
    for (std::size_t i = 0; i < inside; ++i) {
      if (hits[i]) points[i] = measure(rays, first + static_cast<int>(i), v, *hits[i], view);
    }
    for (const Vector3f& lamp : lamps) add_lamp(everything, lamp, points);
    for (std::size_t i = 0; i < inside; ++i)
      view.color.at(first + static_cast<int>(i), v) =
          to_rgb(points[i].color * std::min(points[i].light, kBrightest));
  }
}

SceneRenderer::SceneRenderer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
SceneRenderer::SceneRenderer(SceneRenderer&&) noexcept = default;
SceneRenderer& SceneRenderer::operator=(SceneRenderer&&) noexcept = default;
SceneRenderer::~SceneRenderer() = default;

Result<SceneRenderer> SceneRenderer::create(const FurnishedScene& scene) {
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
  return SceneRenderer(std::move(impl));
}

RenderedView SceneRenderer::render(const PinholeCamera& camera,
                                   const MapFromCamera& map_from_camera) const {
  RenderedView view{DepthImage(camera.width_px, camera.height_px),
                    Image<float>(camera.width_px, camera.height_px),
                    InstanceImage(camera.width_px, camera.height_px),
                    ColorImage(camera.width_px, camera.height_px)};
  const RayGrid rays(camera, map_from_camera);
  const auto render_rows = [&](const tbb::blocked_range<int>& rows) {
    for (int v = rows.begin(); v < rows.end(); ++v) impl_->render_row(rays, v, view);
  };
  // A thread that waits for rows must not begin another frame: that would pile up images.
  tbb::this_task_arena::isolate(
      [&] { tbb::parallel_for(tbb::blocked_range<int>(0, camera.height_px, 8), render_rows); });
  return view;
}

namespace {

/// The window of pixels around the object's silhouette, cut at twice the image's size.
/// An object that reaches behind the camera may fill all of it.
PixelBox silhouette_window(const TriangleMesh& mesh, const RayGrid& rays) {
  const double margin_u = kSilhouetteMargin * rays.camera.width_px;
  const double margin_v = kSilhouetteMargin * rays.camera.height_px;
  const PixelBox limit{
      -margin_u, -margin_v, rays.camera.width_px + margin_u, rays.camera.height_px + margin_v};
  PixelBox window{limit.u_max_px, limit.v_max_px, limit.u_min_px, limit.v_min_px};
  for (const Vector3f& vertex : mesh.vertices) {
    const Vector3d in_camera =
        rays.map_from_camera.transpose() * (vertex.cast<double>() - rays.origin);
    const auto pixel = rays.camera.project({in_camera});
    if (!pixel || in_camera.z() < 0.05) return limit;
    window.u_min_px = std::min(window.u_min_px, pixel->u_px);
    window.v_min_px = std::min(window.v_min_px, pixel->v_px);
    window.u_max_px = std::max(window.u_max_px, pixel->u_px);
    window.v_max_px = std::max(window.v_max_px, pixel->v_px);
  }
  return {std::max(window.u_min_px, limit.u_min_px),
          std::max(window.v_min_px, limit.v_min_px),
          std::min(window.u_max_px, limit.u_max_px),
          std::min(window.v_max_px, limit.v_max_px)};
}

/// Visible over all grid points of one object's silhouette.
double unhidden_share(const EmbreeScene& alone,
                      const RenderedView& view,
                      ObjectId id,
                      const PixelBox& window,
                      const RayGrid& rays) {
  const double area = std::max(0.0, window.width_px()) * std::max(0.0, window.height_px());
  const int step = std::max(1, static_cast<int>(std::sqrt(area / kSilhouetteSamples)));
  int all = 0;
  int visible = 0;
  const auto first_u = static_cast<int>(std::floor(window.u_min_px));
  for (int v = static_cast<int>(std::floor(window.v_min_px)); v <= window.v_max_px; v += step) {
    for (int u = first_u; u <= window.u_max_px; u += step * EmbreeScene::kPacket) {
      const auto hits = alone.nearest(rays.origin.cast<float>(), rays.packet(u, step, v));
      for (int i = 0; i < EmbreeScene::kPacket; ++i) {
        if (!hits[static_cast<std::size_t>(i)]) continue;
        ++all;
        const int pixel_u = u + i * step;
        if (view.instances.contains(pixel_u, v) && view.instances.at(pixel_u, v) == id) ++visible;
      }
    }
  }
  return all == 0 ? 0.0 : static_cast<double>(visible) / all;
}

}  // namespace

std::vector<double> SceneRenderer::unhidden_shares(const RenderedView& view,
                                                   std::span<const ObjectId> objects,
                                                   const PinholeCamera& camera,
                                                   const MapFromCamera& map_from_camera) const {
  const RayGrid rays(camera, map_from_camera);
  std::vector<double> shares;
  for (const ObjectId id : objects) {
    const PixelBox window = silhouette_window(impl_->surfaces[id.value].mesh, rays);
    shares.push_back(unhidden_share(impl_->alone[id.value - 1], view, id, window, rays));
  }
  return shares;
}

}  // namespace hypermap
