// SPDX-License-Identifier: BSD-3-Clause
#include "ray_marking.hpp"

#include "hypermap/octree_semantic/voxel_key.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hypermap {
namespace {

/// What one axis of a ray needs to go from face to face.
struct AxisWalk {
  const std::uint32_t* summand = nullptr;  // of the present voxel
  std::ptrdiff_t step = 0;
  double next_m = std::numeric_limits<double>::max();
  double per_voxel_m = std::numeric_limits<double>::max();

  void advance() noexcept {
    summand += step;
    next_m += per_voxel_m;
  }
};

}  // namespace

RayMarker::RayMarker(const WindowGeometry& window, double resolution_m, const PointF& sensor)
    : window_(&window),
      resolution_m_(resolution_m),
      voxels_per_m_(1.0 / resolution_m),
      sensor_(sensor) {
  for (std::size_t i = 0; i < 3; ++i) sensor_offset_[i] = offset(i, sensor[i]);
}

int RayMarker::offset(std::size_t axis, float coordinate_m) const noexcept {
  const double voxels = voxels_per_m_ * static_cast<double>(coordinate_m);
  const int truncated = static_cast<int>(voxels);
  return truncated - (voxels < truncated ? 1 : 0) + kOriginKey - window_->corner(axis);
}

void RayMarker::mark(const PointF& end, BitLayer& passed) const {
  std::array<AxisWalk, 3> axes;
  PointF direction{};
  for (std::size_t i = 0; i < 3; ++i) direction[i] = end[i] - sensor_[i];
  const float squared =
      direction[0] * direction[0] + direction[1] * direction[1] + direction[2] * direction[2];
  const auto length_m = static_cast<float>(std::sqrt(static_cast<double>(squared)));
  std::uint32_t last_cell = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    AxisWalk& axis = axes[i];
    axis.summand = window_->summands(i) + sensor_offset_[i];
    last_cell += window_->summands(i)[offset(i, end[i])];
    direction[i] /= length_m;
    if (!(direction[i] != 0.0F)) continue;
    axis.step = direction[i] > 0.0F ? 1 : -1;
    const int key = sensor_offset_[i] + window_->corner(i) - kOriginKey;
    const double half_m = static_cast<double>(
        static_cast<float>(static_cast<double>(axis.step) * resolution_m_ * 0.5));
    const double face_m = (static_cast<double>(key) + 0.5) * resolution_m_ + half_m;
    const auto along = static_cast<double>(direction[i]);
    axis.next_m = (face_m - static_cast<double>(sensor_[i])) / along;
    axis.per_voxel_m = resolution_m_ / std::abs(along);
  }
  auto& [x, y, z] = axes;
  std::uint32_t cell = *x.summand + *y.summand + *z.summand;
  if (cell == last_cell) return;
  const auto limit_m = static_cast<double>(length_m);
  double nearest_m = 0.0;
  do {
    passed.mark(cell);
    if (x.next_m < y.next_m) {
      (x.next_m < z.next_m ? x : z).advance();
    } else {
      (y.next_m < z.next_m ? y : z).advance();
    }
    cell = *x.summand + *y.summand + *z.summand;
    nearest_m = std::min(std::min(x.next_m, y.next_m), z.next_m);
    // Rounding may lead the walk past the last voxel; then the length ends it.
  } while (cell != last_cell && !(nearest_m > limit_m));
}

}  // namespace hypermap
