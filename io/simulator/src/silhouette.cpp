// SPDX-License-Identifier: BSD-3-Clause
#include "silhouette.hpp"

#include "hypermap/core/segmentation/detection.hpp"

#include <algorithm>
#include <cmath>

namespace hypermap {
namespace {

constexpr double kSilhouetteMargin = 1.0;      // of the image's size, on each side
constexpr double kSilhouetteSamples = 4096.0;  // wanted number of grid points per object

/// The window of pixels around the object's silhouette, cut at twice the image's size.
/// An object that reaches behind the camera may fill all of it.
PixelBox silhouette_window(const LoneShape& shape, const RayGrid& rays) {
  const double margin_u = kSilhouetteMargin * rays.camera.width_px;
  const double margin_v = kSilhouetteMargin * rays.camera.height_px;
  const PixelBox limit{
      -margin_u, -margin_v, rays.camera.width_px + margin_u, rays.camera.height_px + margin_v};
  PixelBox window{limit.u_max_px, limit.v_max_px, limit.u_min_px, limit.v_min_px};
  for (const Eigen::Vector3f& vertex : shape.mesh.vertices) {
    const Eigen::Vector3d in_camera = rays.map_from_camera.transpose() *
                                      (shape.map_from_mesh * vertex.cast<double>() - rays.origin);
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

}  // namespace

double unhidden_share(const LoneShape& shape,
                      const InstanceImage& instances,
                      ObjectId id,
                      const RayGrid& rays) {
  const PixelBox window = silhouette_window(shape, rays);
  const double area = std::max(0.0, window.width_px()) * std::max(0.0, window.height_px());
  const int step = std::max(1, static_cast<int>(std::sqrt(area / kSilhouetteSamples)));
  const Eigen::Vector3f origin = shape.mesh_from_map * rays.origin.cast<float>();
  int all = 0;
  int visible = 0;
  const auto first_u = static_cast<int>(std::floor(window.u_min_px));
  for (int v = static_cast<int>(std::floor(window.v_min_px)); v <= window.v_max_px; v += step) {
    for (int u = first_u; u <= window.u_max_px; u += step * EmbreeScene::kPacket) {
      const auto hits =
          shape.alone.nearest(origin, turned_by(shape.mesh_from_map, rays.packet(u, step, v)));
      for (int i = 0; i < EmbreeScene::kPacket; ++i) {
        if (!hits[static_cast<std::size_t>(i)]) continue;
        ++all;
        const int pixel_u = u + i * step;
        if (instances.contains(pixel_u, v) && instances.at(pixel_u, v) == id) ++visible;
      }
    }
  }
  return all == 0 ? 0.0 : static_cast<double>(visible) / all;
}

}  // namespace hypermap
