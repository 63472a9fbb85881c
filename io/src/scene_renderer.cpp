// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/scene_renderer.hpp"

#include "embree_scene.hpp"
#include "hypermap/core/detection.hpp"
#include "surface_color.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
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
constexpr double kSilhouetteMargin = 1.0;      // of the picture's size, on each side
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
};

/// How lamps light a point: window over distance, angle, shadow.
float lamp_light(const EmbreeScene& scene,
                 const Vector3f& lamp,
                 const Vector3f& point,
                 const Vector3f& normal) {
  const Vector3f to_lamp = lamp - point;
  const float distance = to_lamp.norm();
  if (distance >= kLampReachM) return 0.0F;
  const float angle = normal.dot(to_lamp) / distance;
  if (angle <= 0.0F) return 0.0F;
  const Vector3f start = point + kShadowOffsetM * normal;
  if (scene.is_blocked(start, lamp - start)) return 0.0F;
  const float nearness = 1.0F - distance * distance / (kLampReachM * kLampReachM);
  return kLampStrength * angle * nearness * nearness;
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

  void shade_row(const RayGrid& rays, int v, RenderedView& view) const;
  void shade_pixel(const RayGrid& rays, int u, int v, const RayHit& hit, RenderedView& view) const;
  [[nodiscard]] Vector3f lit(const Surface& surface,
                             const SurfaceMaterial& material,
                             const Vector3f& point,
                             const Vector3f& normal) const;
};

Vector3f SceneRenderer::Impl::lit(const Surface& surface,
                                  const SurfaceMaterial& material,
                                  const Vector3f& point,
                                  const Vector3f& normal) const {
  const Vector3f color = surface_color(
      material, surface.shape_from_map * point, surface.shape_from_map.linear() * normal);
  if (is_glowing(material)) return color;
  float light =
      0.4F + 0.12F * std::abs(normal.z());  // light from all around, reflected by floor and ceiling
  for (const Vector3f& lamp : lamps) light += lamp_light(everything, lamp, point, normal);
  return color * std::min(light, 1.15F);
}

void SceneRenderer::Impl::shade_pixel(
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
  if (!(depth > 0.0) || !std::isfinite(depth)) return;  // grazed a triangle seen edge on
  view.depth_m.at(u, v) = static_cast<float>(depth);
  view.incidence_cos.at(u, v) = static_cast<float>(std::abs(slope) / direction.norm());
  view.instances.at(u, v) = ObjectId{hit.mesh};
  const Vector3d facing = slope > 0.0 ? Vector3d(-normal) : normal;
  const SurfaceMaterial& material =
      surface.mesh.materials[surface.mesh.material_of_triangle[hit.triangle]];
  const Vector3d point = rays.origin + depth * direction;
  view.color.at(u, v) = to_rgb(lit(surface, material, point.cast<float>(), facing.cast<float>()));
}

void SceneRenderer::Impl::shade_row(const RayGrid& rays, int v, RenderedView& view) const {
  std::array<Vector3f, EmbreeScene::kPacket> directions;
  const int width = rays.camera.width_px;
  for (int first = 0; first < width; first += EmbreeScene::kPacket) {
    for (int i = 0; i < EmbreeScene::kPacket; ++i)
      directions[static_cast<std::size_t>(i)] = rays.direction(first + i, v).cast<float>();
    const auto hits = everything.nearest(rays.origin.cast<float>(), directions);
    for (int i = 0; i < std::min(EmbreeScene::kPacket, width - first); ++i) {
      const auto& hit = hits[static_cast<std::size_t>(i)];
      if (hit) shade_pixel(rays, first + i, v, *hit, view);
    }
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
  tbb::parallel_for(tbb::blocked_range<int>(0, camera.height_px, 8),
                    [&](const tbb::blocked_range<int>& rows) {
                      for (int v = rows.begin(); v < rows.end(); ++v)
                        impl_->shade_row(rays, v, view);
                    });
  return view;
}

namespace {

/// The window of pixels around the object's silhouette, cut at twice the picture's size.
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
  std::array<Vector3f, EmbreeScene::kPacket> directions;
  const auto first_u = static_cast<int>(std::floor(window.u_min_px));
  for (int v = static_cast<int>(std::floor(window.v_min_px)); v <= window.v_max_px; v += step) {
    for (int u = first_u; u <= window.u_max_px; u += step * EmbreeScene::kPacket) {
      for (int i = 0; i < EmbreeScene::kPacket; ++i)
        directions[static_cast<std::size_t>(i)] = rays.direction(u + i * step, v).cast<float>();
      const auto hits = alone.nearest(rays.origin.cast<float>(), directions);
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
