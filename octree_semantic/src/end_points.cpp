// SPDX-License-Identifier: BSD-3-Clause
#include "end_points.hpp"

#include <cmath>
#include <limits>

namespace hypermap {
namespace {

/// Beyond, coordinates are no whole numbers of voxels any more.
constexpr double kMaxVoxels = 1e9;

/// Largest single-precision square whose root is not above the range.
float largest_square_within(double range_m) {
  auto square = static_cast<float>(range_m * range_m);
  while (std::sqrt(static_cast<double>(square)) > range_m) square = std::nextafter(square, 0.0F);
  for (float next = square; std::sqrt(static_cast<double>(next)) <= range_m;) {
    square = next;
    next = std::nextafter(next, std::numeric_limits<float>::infinity());
  }
  return square;
}

bool is_countable(const PointF& point, double resolution_m) {
  for (const float coordinate : point) {
    if (!(std::abs(static_cast<double>(coordinate)) < kMaxVoxels * resolution_m)) return false;
  }
  return true;
}

}  // namespace

RangeLimit::RangeLimit(double max_range_m) noexcept
    : range_m_(static_cast<float>(max_range_m)), max_squared_(largest_square_within(max_range_m)) {}

EndPoints::EndPoints(double resolution_m,
                     const PointF& sensor,
                     const IntegrationOptions& options,
                     MarkedWindow& hit,
                     MarkedWindow* far,
                     std::vector<PointF>& ray_ends)
    : resolution_m_(resolution_m),
      sensor_(sensor),
      exact_(options.mode == IntegrationMode::kExact),
      range_(options.max_range_m),
      outer_range_(options.max_range_m + (exact_ ? 0.0 : resolution_m)),
      hit_(&hit),
      far_(far),
      ray_ends_(&ray_ends) {}

void EndPoints::add(const PointChunk& chunk,
                    std::span<std::uint32_t> cells,
                    IntegrationReport& report) {
  // Copies, so that nothing is read again after each mark.
  const CellFinder finder(hit_->geometry, resolution_m_);
  const BitMarker hit = hit_->bits.marker();
  const RangeLimit range = range_;
  const RangeLimit outer_range = outer_range_;
  const PointF sensor = sensor_;
  std::size_t num_within = 0;
  std::size_t num_near = 0;
  std::uint32_t last_marked = kNoCell;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const PointF point{chunk.x[i], chunk.y[i], chunk.z[i]};
    const float squared = squared_norm(difference(point, sensor));
    cells[i] = kNoCell;
    if (!outer_range.contains(squared)) {
      add_beyond(point, report);
      continue;
    }
    const std::uint32_t cell = finder.find(point);
    if (cell == kNoCell) {
      ++report.num_outside_volume;
      continue;
    }
    cells[i] = cell;
    // Neighbouring pixels mostly end in one voxel: to mark it again would only wait for the memory.
    if (cell != last_marked) hit.mark(cell);
    last_marked = cell;
    ++num_near;
    num_within += range.contains(squared) ? 1U : 0U;
    if (exact_) ray_ends_->push_back(point);
  }
  report.num_hits += num_within;
  report.num_beyond_range += num_near - num_within;
}

void EndPoints::add_beyond(const PointF& point, IntegrationReport& report) {
  if (std::isnan(point[0])) return;  // not measured
  const PointF end = shortened(point);
  // A square that overflows leaves no direction.
  if (!std::isfinite(squared_norm(difference(point, sensor_))) ||
      !is_countable(end, resolution_m_) ||
      CellFinder(hit_->geometry, resolution_m_).find(end) == kNoCell) {
    ++report.num_outside_volume;
    return;
  }
  ++report.num_beyond_range;
  if (!exact_ && far_ != nullptr && is_countable(point, resolution_m_)) {
    const std::uint32_t cell = CellFinder(far_->geometry, resolution_m_).find(point);
    if (cell != kNoCell) {
      far_->bits.marker().mark(cell);
      return;
    }
  }
  ray_ends_->push_back(end);
}

void EndPoints::finish() {
  if (exact_) return;
  // A voxel counts by its centre, as in OctoMap: beyond the range it is not hit after all.
  hit_->bits.for_each_touched([this](std::size_t brick) {
    std::uint64_t* words = hit_->bits.words(brick);
    for_each_bit(words, [&](std::size_t cell) {
      const PointF centre = centre_of(hit_->geometry, brick, cell);
      const bool within = range_.contains(squared_norm(difference(centre, sensor_)));
      ray_ends_->push_back(within ? centre : shortened(centre));
      if (!within) words[cell / 64] &= ~(std::uint64_t{1} << (cell % 64));
    });
  });
  if (far_ == nullptr) return;
  far_->bits.for_each_touched([this](std::size_t brick) {
    for_each_bit(far_->bits.words(brick), [&](std::size_t cell) {
      ray_ends_->push_back(shortened(centre_of(far_->geometry, brick, cell)));
    });
    far_->bits.clear_brick(brick);
  });
}

PointF EndPoints::shortened(const PointF& point) const noexcept {
  PointF direction = difference(point, sensor_);
  const auto length = static_cast<float>(std::sqrt(static_cast<double>(squared_norm(direction))));
  for (std::size_t i = 0; i < 3; ++i) {
    direction[i] = sensor_[i] + direction[i] / length * range_.range_m();
  }
  return direction;
}

PointF EndPoints::centre_of(const WindowGeometry& window,
                            std::size_t brick,
                            std::size_t cell) const noexcept {
  const std::array<int, 3> corner = window.brick_corner(brick);
  PointF centre{};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto along = static_cast<int>(gather_bits(cell >> i));
    centre[i] = static_cast<float>((static_cast<double>(corner[i] + along - kOriginKey) + 0.5) *
                                   resolution_m_);
  }
  return centre;
}

}  // namespace hypermap
