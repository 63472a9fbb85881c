// SPDX-License-Identifier: BSD-3-Clause
#include "ray_marking.hpp"

#include "cell_finder.hpp"

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

/// Marks cells from the present one on, until `last_cell` or until the walk is longer than
/// `limit_m`: rounding may lead it past the last cell.
void walk(AxisWalk x,
          AxisWalk y,
          AxisWalk z,
          std::uint32_t last_cell,
          double limit_m,
          const BitMarker passed) {
  std::uint32_t cell = *x.summand + *y.summand + *z.summand;
  double nearest_m = 0.0;
  do {
    passed.mark(cell);
    if (x.next_m < y.next_m) {
      if (x.next_m < z.next_m) {
        x.advance();
      } else {
        z.advance();
      }
    } else if (y.next_m < z.next_m) {
      y.advance();
    } else {
      z.advance();
    }
    cell = *x.summand + *y.summand + *z.summand;
    nearest_m = std::min(std::min(x.next_m, y.next_m), z.next_m);
  } while (cell != last_cell && !(nearest_m > limit_m));
}

}  // namespace

RayMarker::RayMarker(const WindowGeometry& window, double resolution_m, const PointF& sensor)
    : window_(&window),
      resolution_m_(resolution_m),
      voxels_per_m_(1.0 / resolution_m),
      sensor_(sensor) {
  for (std::size_t i = 0; i < 3; ++i) {
    sensor_voxel_[i] = floor_to_int(voxels_per_m_ * static_cast<double>(sensor[i]));
    sensor_offset_[i] = sensor_voxel_[i] + kOriginKey - window.corner(i);
  }
}

void RayMarker::mark(const PointF& end, const BitMarker& passed) const {
  const PointF way = difference(end, sensor_);
  const auto length_m = static_cast<float>(std::sqrt(static_cast<double>(squared_norm(way))));
  std::array<AxisWalk, 3> axes;
  std::uint32_t first_cell = 0;
  std::uint32_t last_cell = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    AxisWalk& axis = axes[i];
    axis.summand = window_->summands(i) + sensor_offset_[i];
    first_cell += *axis.summand;
    const int end_voxel = floor_to_int(voxels_per_m_ * static_cast<double>(end[i]));
    last_cell += window_->summands(i)[end_voxel + kOriginKey - window_->corner(i)];
    const float direction = way[i] / length_m;
    if (!(direction != 0.0F)) continue;
    axis.step = direction > 0.0F ? 1 : -1;
    const auto half_m = static_cast<float>(static_cast<double>(axis.step) * resolution_m_ * 0.5);
    const double face_m =
        (static_cast<double>(sensor_voxel_[i]) + 0.5) * resolution_m_ + static_cast<double>(half_m);
    const auto along = static_cast<double>(direction);
    axis.next_m = (face_m - static_cast<double>(sensor_[i])) / along;
    axis.per_voxel_m = resolution_m_ / std::abs(along);
  }
  if (first_cell == last_cell) return;
  walk(axes[0], axes[1], axes[2], last_cell, static_cast<double>(length_m), passed);
}

}  // namespace hypermap
