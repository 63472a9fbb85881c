// SPDX-License-Identifier: BSD-3-Clause
#include "ray_marking.hpp"

#include "cell_finder.hpp"
#include "ray_steps.hpp"

#include <array>
#include <cassert>

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
  const RaySteps steps = ray_steps(sensor_, sensor_voxel_, end, resolution_m_);
  kernels::MarchedRay ray = from_sensor_;
  ray.limit = steps.limit;
  for (std::size_t i = 0; i < 3; ++i) {
    ray.next[i] = steps.next[i];
    ray.per_voxel[i] = steps.per_voxel[i];
    if (steps.sign[i] == 0) continue;
    // The lowest bit of the axis is added or taken; carries run over the bits of the others.
    const std::int64_t axis_bits = kernels::kAxisBits << i;
    const auto brick_cells = static_cast<std::int64_t>(kBrickVolume * window_->brick_stride(i));
    ray.step[i] = steps.sign[i] > 0 ? -axis_bits : -(std::int64_t{1} << i);
    ray.behind[i] = steps.sign[i] > 0 ? 0 : axis_bits;
    ray.brick_step[i] = steps.sign[i] > 0 ? brick_cells : -brick_cells;
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
