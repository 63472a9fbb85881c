// SPDX-License-Identifier: BSD-3-Clause
#include "end_points.hpp"

#include "hypermap/octree_semantic/voxel_key.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hypermap {
namespace {

/// Where float coordinates become integers safely: far outside the volume, so that they are
/// refused.
constexpr double kFarOutside = 1e9;

/// Offsets of coordinates from the window's corner. Without branches, so that it is vectorised.
void to_offsets(const std::vector<float>& coordinates_m,
                double voxels_per_m,
                int corner,
                std::vector<int>& offsets) {
  const std::size_t size = coordinates_m.size();
  offsets.resize(size);
  for (std::size_t i = 0; i < size; ++i) {
    const double voxels = voxels_per_m * static_cast<double>(coordinates_m[i]);
    const double safe = voxels > -kFarOutside ? std::min(voxels, kFarOutside) : -kFarOutside;
    const int truncated = static_cast<int>(safe);
    offsets[i] = truncated - (safe < truncated ? 1 : 0) + kOriginKey - corner;
  }
}

/// Largest square whose root is not above the range.
double largest_square_within(double range_m) {
  double square = range_m * range_m;
  while (std::sqrt(square) > range_m) square = std::nextafter(square, 0.0);
  for (double next = square; std::sqrt(next) <= range_m;) {
    square = next;
    next = std::nextafter(next, std::numeric_limits<double>::infinity());
  }
  return square;
}

}  // namespace

RangeLimit::RangeLimit(double max_range_m) noexcept
    : range_m_(static_cast<float>(max_range_m)), max_squared_(largest_square_within(max_range_m)) {}

EndPoints::EndPoints(const WindowGeometry& window,
                     double resolution_m,
                     const PointF& sensor,
                     const IntegrationOptions& options,
                     BitLayer& hit,
                     BitLayer& left,
                     std::vector<PointF>& ray_ends)
    : window_(&window),
      resolution_m_(resolution_m),
      voxels_per_m_(1.0 / resolution_m),
      sensor_(sensor),
      mode_(options.mode),
      range_(options.max_range_m),
      outer_range_(options.max_range_m +
                   (options.mode == IntegrationMode::kDiscretize ? resolution_m : 0.0)),
      hit_(&hit),
      left_(&left),
      ray_ends_(&ray_ends) {
  for (std::size_t i = 0; i < 3; ++i) {
    first_inside_[i] = std::max(0, -window.corner(i));
    const int end = std::min(window.edge(i), kKeysPerAxis - window.corner(i));
    num_inside_[i] = static_cast<std::uint32_t>(std::max(0, end - first_inside_[i]));
  }
}

std::uint32_t EndPoints::cell_at(int x, int y, int z) const noexcept {
  const auto inside = [this](std::size_t axis, int offset) {
    return static_cast<std::uint32_t>(offset - first_inside_[axis]) < num_inside_[axis];
  };
  return inside(0, x) && inside(1, y) && inside(2, z) ? window_->cell(x, y, z) : kNoCell;
}

std::uint32_t EndPoints::cell_of(const PointF& point) const noexcept {
  std::array<int, 3> offset{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double voxels = voxels_per_m_ * static_cast<double>(point[i]);
    if (!(std::abs(voxels) < kFarOutside)) return kNoCell;
    offset[i] = static_cast<int>(std::floor(voxels)) + kOriginKey - window_->corner(i);
  }
  return cell_at(offset[0], offset[1], offset[2]);
}

PointF EndPoints::centre_of(std::size_t brick, std::size_t cell) const noexcept {
  const std::array<int, 3> corner = window_->brick_corner(brick);
  PointF centre{};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto along = static_cast<int>(gather_bits(cell >> i));
    centre[i] = static_cast<float>((static_cast<double>(corner[i] + along - kOriginKey) + 0.5) *
                                   resolution_m_);
  }
  return centre;
}

PointF EndPoints::shortened(const PointF& point) const noexcept {
  PointF direction = difference(point, sensor_);
  const auto length = static_cast<float>(std::sqrt(static_cast<double>(squared_norm(direction))));
  for (std::size_t i = 0; i < 3; ++i) {
    direction[i] = sensor_[i] + direction[i] / length * range_.range_m();
  }
  return direction;
}

void EndPoints::add_beyond(const PointF& point, IntegrationReport& report) {
  const PointF end = shortened(point);
  const std::uint32_t cell = cell_of(end);
  if (cell == kNoCell) {
    ++report.num_outside_volume;
    return;
  }
  ++report.num_beyond_range;
  if (mode_ == IntegrationMode::kExact) {
    ray_ends_->push_back(end);
  } else {
    left_->mark(cell);
  }
}

void EndPoints::add(const PointChunk& chunk,
                    std::span<std::uint32_t> cells,
                    IntegrationReport& report) {
  to_offsets(chunk.x, voxels_per_m_, window_->corner(0), offsets_[0]);
  to_offsets(chunk.y, voxels_per_m_, window_->corner(1), offsets_[1]);
  to_offsets(chunk.z, voxels_per_m_, window_->corner(2), offsets_[2]);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    cells[i] = kNoCell;
    const PointF point{chunk.x[i], chunk.y[i], chunk.z[i]};
    const float squared = squared_norm(difference(point, sensor_));
    if (std::isnan(point[0])) continue;  // not measured
    if (!outer_range_.contains(squared)) {
      add_beyond(point, report);
      continue;
    }
    const std::uint32_t cell = cell_at(offsets_[0][i], offsets_[1][i], offsets_[2][i]);
    if (cell == kNoCell) {
      ++report.num_outside_volume;
      continue;
    }
    cells[i] = cell;
    hit_->mark(cell);
    ++(range_.contains(squared) ? report.num_hits : report.num_beyond_range);
    if (mode_ == IntegrationMode::kExact) ray_ends_->push_back(point);
  }
}

void EndPoints::finish() {
  if (mode_ == IntegrationMode::kExact) return;
  // A voxel counts by its centre, as in OctoMap: beyond the range it is not hit after all.
  hit_->for_each_touched([this](std::size_t brick) {
    for_each_bit(hit_->words(brick), [&](std::size_t cell) {
      const PointF centre = centre_of(brick, cell);
      const bool within = range_.contains(squared_norm(difference(centre, sensor_)));
      ray_ends_->push_back(within ? centre : shortened(centre));
      if (!within) hit_->words(brick)[cell / 64] &= ~(std::uint64_t{1} << (cell % 64));
    });
  });
  left_->for_each_touched([this](std::size_t brick) {
    for_each_bit(left_->words(brick),
                 [&](std::size_t cell) { ray_ends_->push_back(centre_of(brick, cell)); });
    left_->clear_brick(brick);
  });
}

}  // namespace hypermap
