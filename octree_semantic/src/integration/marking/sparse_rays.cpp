// SPDX-License-Identifier: BSD-3-Clause
#include "sparse_rays.hpp"

#include "cell_finder.hpp"

#include <algorithm>
#include <cstddef>

namespace hypermap {
namespace {

constexpr int kGridColumns = 9;
constexpr int kGridRows = 7;
/// Tiles with at most so many measured pixels of 64 are sparse.
constexpr int kSparse = 16;

/// Casts rays through chosen pixels.
class PixelRays {
 public:
  PixelRays(const DepthPoints& points,
            const DepthPyramid& pyramid,
            const EndPoints& ends,
            std::vector<PointF>& ray_ends)
      : camera_(points.frame().camera),
        map_from_camera_(points.frame().map_from_camera),
        pyramid_(&pyramid),
        ends_(&ends),
        ray_ends_(&ray_ends) {}

  [[nodiscard]] std::size_t index(int u, int v) const {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(camera_.width_px) +
           static_cast<std::size_t>(u);
  }
  [[nodiscard]] bool is_measured(int u, int v) const {
    return pyramid_->clean()[index(u, v)] > 0.0F;
  }
  /// Requires: measured there.
  void cast(int u, int v) {
    const auto depth_m = static_cast<double>(pyramid_->clean()[index(u, v)]);
    const Eigen::Vector3f point =
        (map_from_camera_ * camera_.unproject(u, v, depth_m)).xyz.cast<float>();
    ray_ends_->push_back(ends_->ray_end({point.x(), point.y(), point.z()}));
  }

 private:
  PinholeCamera camera_;
  MapFromCamera map_from_camera_;
  const DepthPyramid* pyramid_;
  const EndPoints* ends_;
  std::vector<PointF>* ray_ends_;
};

void cast_grid(const PinholeCamera& camera, PixelRays& rays) {
  const int columns = std::min(kGridColumns, camera.width_px);
  const int rows = std::min(kGridRows, camera.height_px);
  for (int row = 0; row < rows; ++row) {
    const int v = rows == 1 ? 0 : row * (camera.height_px - 1) / (rows - 1);
    for (int column = 0; column < columns; ++column) {
      const int u = columns == 1 ? 0 : column * (camera.width_px - 1) / (columns - 1);
      if (rays.is_measured(u, v)) rays.cast(u, v);
    }
  }
}

void cast_tile(const PinholeCamera& camera,
               int first_u,
               int first_v,
               std::span<const std::uint32_t> cells,
               PixelRays& rays) {
  std::uint32_t last_cell = kNoCell;
  for (int v = first_v; v < std::min(first_v + DepthPyramid::kTile, camera.height_px); ++v) {
    for (int u = first_u; u < std::min(first_u + DepthPyramid::kTile, camera.width_px); ++u) {
      if (!rays.is_measured(u, v)) continue;
      const std::uint32_t cell = cells[rays.index(u, v)];
      if (cell == kNoCell || cell != last_cell) rays.cast(u, v);
      last_cell = cell;
    }
  }
}

}  // namespace

void add_sparse_rays(const DepthPoints& points,
                     const DepthPyramid& pyramid,
                     const EndPoints& ends,
                     std::span<const std::uint32_t> cells,
                     std::vector<PointF>& ray_ends) {
  const PinholeCamera& camera = points.frame().camera;
  PixelRays rays(points, pyramid, ends, ray_ends);
  cast_grid(camera, rays);
  const int width = pyramid.tiles_per_row();
  for (std::size_t tile = 0; tile < pyramid.num_measured().size(); ++tile) {
    const int num_measured = pyramid.num_measured()[tile];
    if (num_measured == 0 || num_measured > kSparse) continue;
    const int number = static_cast<int>(tile);
    cast_tile(camera,
              number % width * DepthPyramid::kTile,
              number / width * DepthPyramid::kTile,
              cells,
              rays);
  }
}

}  // namespace hypermap
