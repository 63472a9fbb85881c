// SPDX-License-Identifier: BSD-3-Clause
#include "ray_marking.hpp"

#include "cell_finder.hpp"

#include <array>
#include <cassert>
#include <cmath>
#include <limits>

namespace hypermap {
RayMarker::RayMarker(const WindowGeometry& window, double resolution_m, const PointF& sensor)
    : window_(&window),
      resolution_m_(resolution_m),
      voxels_per_m_(1.0 / resolution_m),
      sensor_(sensor),
      march_rays_(kernels::best_kernels().march_rays) {
  for (std::size_t i = 0; i < 3; ++i) {
    sensor_voxel_[i] = floor_to_int(voxels_per_m_ * static_cast<double>(sensor[i]));
    first_cell_ += window.summands(i)[sensor_voxel_[i] + kOriginKey - window.corner(i)];
  }
  constexpr auto kInBrick = static_cast<std::int64_t>(kBrickVolume - 1);
  from_sensor_.brick = first_cell_ & ~kInBrick;
  for (std::size_t i = 0; i < 3; ++i) {
    from_sensor_.place[i] = first_cell_ & (kernels::kAxisBits << i);
    from_sensor_.next[i] = std::numeric_limits<double>::max();
    from_sensor_.per_voxel[i] = std::numeric_limits<double>::max();
  }
}

std::uint32_t RayMarker::cell_of(const PointF& end) const {
  std::uint32_t cell = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const int voxel = floor_to_int(voxels_per_m_ * static_cast<double>(end[i]));
    cell += window_->summands(i)[voxel + kOriginKey - window_->corner(i)];
  }
  return cell;
}

kernels::MarchedRay RayMarker::ray_to(const PointF& end) const {
  const PointF way = difference(end, sensor_);
  const auto length_m = static_cast<float>(std::sqrt(static_cast<double>(squared_norm(way))));
  kernels::MarchedRay ray = from_sensor_;
  ray.limit = static_cast<double>(length_m);
  for (std::size_t i = 0; i < 3; ++i) {
    const float direction = way[i] / length_m;
    if (!(direction != 0.0F)) continue;
    const double sign = direction > 0.0F ? 1.0 : -1.0;
    const auto half_m = static_cast<float>(sign * resolution_m_ * 0.5);
    const double face_m =
        (static_cast<double>(sensor_voxel_[i]) + 0.5) * resolution_m_ + static_cast<double>(half_m);
    const auto along = static_cast<double>(direction);
    ray.next[i] = (face_m - static_cast<double>(sensor_[i])) / along;
    ray.per_voxel[i] = resolution_m_ / std::abs(along);
    // The lowest bit of the axis is added or taken; carries run over the bits of the others.
    const std::int64_t axis_bits = kernels::kAxisBits << i;
    const auto brick_cells = static_cast<std::int64_t>(kBrickVolume * window_->brick_stride(i));
    ray.step[i] = direction > 0.0F ? -axis_bits : -(std::int64_t{1} << i);
    ray.behind[i] = direction > 0.0F ? 0 : axis_bits;
    ray.brick_step[i] = direction > 0.0F ? brick_cells : -brick_cells;
  }
  return ray;
}

void RayMarker::mark(std::span<const PointF> ends, const BitMarker& passed) const {
  assert(ends.size() <= kMaxRays);
  std::array<kernels::MarchedRay, kMaxRays> rays;
  std::size_t num_rays = 0;
  for (const PointF& end : ends) {
    const std::uint32_t last_cell = cell_of(end);
    if (last_cell == first_cell_) continue;
    rays[num_rays] = ray_to(end);
    rays[num_rays++].last_cell = last_cell;
  }
  march_rays_(rays.data(), num_rays, {.words = passed.words(), .touched = passed.touched()});
}

}  // namespace hypermap
