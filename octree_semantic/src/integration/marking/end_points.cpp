// SPDX-License-Identifier: BSD-3-Clause
#include "end_points.hpp"

#include "cell_finder.hpp"
#include "hypermap/octree_semantic/octree/voxel_key.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace hypermap {
namespace {

static_assert(kernels::kNoVoxel == kNoCell);

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

kernels::CellGrid cell_grid(const WindowGeometry& window,
                            double resolution_m,
                            const PointF& sensor) {
  kernels::CellGrid grid;
  grid.voxels_per_m = 1.0 / resolution_m;
  for (std::size_t i = 0; i < 3; ++i) {
    const int corner = window.corner(i);
    grid.corner[i] = static_cast<double>(corner - kOriginKey);
    grid.first[i] = std::max(0, -corner);
    grid.end[i] = std::min(window.edge(i), kKeysPerAxis - corner);
    grid.sensor[i] = sensor[i];
  }
  grid.stride[0] = static_cast<std::int32_t>(window.brick_stride(0));
  grid.stride[1] = static_cast<std::int32_t>(window.brick_stride(1));
  return grid;
}

/// Whether part of a window lies outside the volume of the map.
bool leaves_volume(const kernels::CellGrid& grid, const WindowGeometry& window) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (grid.first[i] > 0 || grid.end[i] < window.edge(i)) return true;
  }
  return false;
}

/// Calls `visit(i)` for each set bit, ascending.
template <class Visitor>
void for_each_set(std::span<const std::uint64_t> words, Visitor&& visit) {
  for (std::size_t word = 0; word < words.size(); ++word) {
    for (std::uint64_t rest = words[word]; rest != 0; rest &= rest - 1) {
      visit(word * 64 + static_cast<std::size_t>(std::countr_zero(rest)));
    }
  }
}

std::size_t count_set(std::span<const std::uint64_t> words) {
  std::size_t count = 0;
  for (const std::uint64_t word : words) count += static_cast<std::size_t>(std::popcount(word));
  return count;
}

PointF centre_of(const WindowGeometry& window,
                 std::size_t brick,
                 std::size_t cell,
                 double resolution_m) {
  const std::array<int, 3> corner = window.brick_corner(brick);
  PointF centre{};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto along = static_cast<int>(gather_bits(cell >> i));
    centre[i] = static_cast<float>((static_cast<double>(corner[i] + along - kOriginKey) + 0.5) *
                                   resolution_m);
  }
  return centre;
}

}  // namespace

RangeLimit::RangeLimit(double max_range_m) noexcept
    : range_m_(static_cast<float>(max_range_m)), max_squared_(largest_square_within(max_range_m)) {}

EndPoints::EndPoints(double resolution_m,
                     const PointF& sensor,
                     const IntegrationOptions& options,
                     const WindowGeometry& window,
                     const WindowGeometry* far_window)
    : resolution_m_(resolution_m),
      sensor_(sensor),
      mode_(options.mode),
      range_(options.max_range_m),
      window_(&window),
      far_window_(far_window),
      grid_(cell_grid(window, resolution_m, sensor)),
      ends_may_leave_volume_(leaves_volume(grid_, window)) {
  // Discretize: somewhat farther points end in voxels whose centre may lie within the range.
  const bool by_voxel = mode_ == IntegrationMode::kDiscretize;
  const RangeLimit outer(options.max_range_m + (by_voxel ? resolution_m : 0.0));
  grid_.max_squared = range_.max_squared();
  grid_.outer_max_squared = outer.max_squared();
  if (far_window == nullptr) return;
  far_grid_ = cell_grid(*far_window, resolution_m, sensor);
  far_grid_.max_squared = std::numeric_limits<float>::max();
  far_grid_.outer_max_squared = far_grid_.max_squared;
}

void EndSink::fit_chunk() {
  const std::size_t num_words = chunk.padded_size() / kernels::kBlock;
  cells.resize(chunk.padded_size());
  starts.resize(num_words);
  far_bits.resize(num_words);
  lost_bits.resize(num_words);
}

void EndPoints::reserve(EndSink& sink, const MeasuredPoints& points) const {
  sink.chunk.resize(points.points_per_chunk());
  sink.fit_chunk();
  if (mode_ != IntegrationMode::kProjective) sink.ray_ends.reserve(points.size());
  if (mode_ == IntegrationMode::kDiscretize) sink.far_cells.reserve(sink.cells.size());
  if (mode_ == IntegrationMode::kProjective && ends_may_leave_volume_)
    sink.dropped.reserve(points.size());
}

void EndPoints::add(EndSink& sink, std::span<std::uint32_t> cells) const {
  sink.fit_chunk();
  const kernels::CellCounts counts = kernels::best_kernels().find_cells(
      grid_,
      sink.chunk.row(),
      sink.cells.size(),
      sink.cells.data(),
      {sink.starts.data(), sink.far_bits.data(), sink.lost_bits.data()});
  std::copy_n(sink.cells.begin(), cells.size(), cells.begin());
  sink.report.num_hits += counts.num_within_range;
  sink.report.num_beyond_range += counts.num_with_cell - counts.num_within_range;
  mark(sink);
  if (mode_ == IntegrationMode::kExact) add_rays(sink);
  add_far(sink);
  drop(sink);
}

void EndPoints::mark(EndSink& sink) const {
  const BitMarker hit = sink.hit.marker();
  const std::uint32_t* cells = sink.cells.data();
  // Neighbouring pixels mostly end in one voxel: to mark it again would only wait for the memory.
  for_each_set(sink.starts, [&](std::size_t i) { hit.mark(cells[i]); });
}

void EndPoints::add_rays(EndSink& sink) const {
  for (std::size_t i = 0; i < sink.chunk.size; ++i) {
    if (sink.cells[i] != kNoCell) sink.ray_ends.push_back(sink.chunk.point(i));
  }
}

void EndPoints::add_far(EndSink& sink) const {
  const std::size_t num_far = count_set(sink.far_bits);
  if (num_far == 0) return;
  if (ends_may_leave_volume_) {
    const CellFinder finder(*window_, resolution_m_);
    for_each_set(sink.far_bits, [&](std::size_t i) {
      if (finder.find(shortened(sink.chunk.point(i))) != kNoCell) return;
      const std::uint64_t bit = std::uint64_t{1} << (i % 64);
      sink.far_bits[i / 64] &= ~bit;
      sink.lost_bits[i / 64] |= bit;
    });
  }
  sink.report.num_beyond_range += count_set(sink.far_bits);
  if (mode_ == IntegrationMode::kProjective) return;
  if (far_window_ == nullptr) {
    for_each_set(sink.far_bits,
                 [&](std::size_t i) { sink.ray_ends.push_back(shortened(sink.chunk.point(i))); });
    return;
  }
  sink.far_cells.resize(sink.cells.size());
  static_cast<void>(kernels::best_kernels().find_cells(
      far_grid_,
      sink.chunk.row(),
      sink.cells.size(),
      sink.far_cells.data(),
      // Only the cells are of interest.
      {sink.starts.data(), sink.starts.data(), sink.starts.data()}));
  const BitMarker far = sink.far.marker();
  std::uint32_t last_marked = kNoCell;
  for_each_set(sink.far_bits, [&](std::size_t i) {
    const std::uint32_t cell = sink.far_cells[i];
    if (cell == kNoCell) {
      sink.ray_ends.push_back(shortened(sink.chunk.point(i)));
    } else if (cell != last_marked) {
      far.mark(cell);
      last_marked = cell;
    }
  });
}

void EndPoints::drop(EndSink& sink) const {
  for_each_set(sink.lost_bits, [&](std::size_t i) {
    ++sink.report.num_outside_volume;
    if (mode_ == IntegrationMode::kProjective) {
      sink.dropped.push_back(static_cast<std::uint32_t>(sink.chunk.first + i));
    }
  });
}

void EndPoints::cast_from_voxels(EndSink& sink) const {
  // A voxel counts by its centre, as in OctoMap: beyond the range it is not hit after all.
  sink.hit.for_each_touched([&](std::size_t brick) {
    std::uint64_t* words = sink.hit.words(brick);
    for_each_bit(words, [&](std::size_t cell) {
      const PointF centre = centre_of(*window_, brick, cell, resolution_m_);
      const bool within = range_.contains(squared_norm(difference(centre, sensor_)));
      sink.ray_ends.push_back(within ? centre : shortened(centre));
      if (!within) words[cell / 64] &= ~(std::uint64_t{1} << (cell % 64));
    });
  });
  if (far_window_ == nullptr) return;
  sink.far.for_each_touched([&](std::size_t brick) {
    for_each_bit(sink.far.words(brick), [&](std::size_t cell) {
      sink.ray_ends.push_back(shortened(centre_of(*far_window_, brick, cell, resolution_m_)));
    });
    sink.far.clear_brick(brick);
  });
}

PointF EndPoints::ray_end(const PointF& point) const noexcept {
  const bool within = range_.contains(squared_norm(difference(point, sensor_)));
  return within ? point : shortened(point);
}

PointF EndPoints::shortened(const PointF& point) const noexcept {
  return point_at_range(sensor_, point, range_.range_m());
}

PointF point_at_range(const PointF& sensor, const PointF& point, float range_m) {
  PointF direction = difference(point, sensor);
  const auto length = static_cast<float>(std::sqrt(static_cast<double>(squared_norm(direction))));
  for (std::size_t i = 0; i < 3; ++i) {
    direction[i] = sensor[i] + direction[i] / length * range_m;
  }
  return direction;
}

}  // namespace hypermap
