// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/registration/surface_model.hpp"

#include "hypermap/core/base/random_numbers.hpp"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace hypermap {
namespace {

constexpr int kKeyBits = 20;  // of a coordinate; three more bits are the direction
constexpr std::int64_t kKeyOffset = std::int64_t{1} << (kKeyBits - 1);
constexpr double kMinPoints = 12.0;
constexpr double kMaxWeight = 2000.0;  // then a cell forgets a fourth of its points
constexpr double kKeptShare = 0.75;
constexpr double kMaxFlatness = 1.0 / 9.0;  // thickness to extent: a third, squared
constexpr std::size_t kMinSlots = 1024;

using CellIndex = Eigen::Matrix<std::int64_t, 3, 1>;

bool is_in_reach(const Eigen::Vector3d& in_cells) {
  return in_cells.allFinite() &&
         in_cells.cwiseAbs().maxCoeff() < static_cast<double>(kKeyOffset - 2);
}

CellIndex floor_of(const Eigen::Vector3d& in_cells) {
  return in_cells.array().floor().cast<std::int64_t>();
}

/// The axis that the normal is nearest to, 0 .. 2, and 3 more when it looks down that axis.
std::uint64_t direction_of(const Eigen::Vector3d& normal) {
  Eigen::Index axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  return static_cast<std::uint64_t>(axis) + (normal[axis] < 0.0 ? 3U : 0U);
}

std::uint64_t key_of(const CellIndex& index, std::uint64_t direction) {
  std::uint64_t key = direction;
  for (const std::int64_t coordinate : index) {
    key = (key << kKeyBits) | static_cast<std::uint64_t>(coordinate + kKeyOffset);
  }
  return key;
}

}  // namespace

SurfaceGrid::SurfaceGrid(double cell_m, std::size_t max_cells)
    : cell_m_(cell_m), max_cells_(max_cells) {
  assert(cell_m > 0.0 && max_cells >= 2);
}

void SurfaceGrid::clear() noexcept {
  cells_.clear();
  std::fill(slots_.begin(), slots_.end(), 0U);
}

/// The slot of the key, or the free one where it would go. Requires: a free slot.
std::size_t SurfaceGrid::slot_of(std::uint64_t key) const noexcept {
  const std::size_t mask = slots_.size() - 1;
  std::size_t slot = static_cast<std::size_t>(mix_bits(key)) & mask;
  while (slots_[slot] != 0 && cells_[slots_[slot] - 1].key != key) slot = (slot + 1) & mask;
  return slot;
}

const SurfaceGrid::Cell* SurfaceGrid::find(std::uint64_t key) const noexcept {
  if (slots_.empty()) return nullptr;
  const std::uint32_t position = slots_[slot_of(key)];
  return position == 0 ? nullptr : &cells_[position - 1];
}

SurfaceGrid::Cell& SurfaceGrid::find_or_add(std::uint64_t key) {
  if (2 * (cells_.size() + 1) > slots_.size())
    rebuild_index(std::max(kMinSlots, 2 * slots_.size()));
  const std::size_t slot = slot_of(key);
  if (slots_[slot] == 0) {
    cells_.push_back({.key = key});
    slots_[slot] = static_cast<std::uint32_t>(cells_.size());
  }
  return cells_[slots_[slot] - 1];
}

void SurfaceGrid::rebuild_index(std::size_t num_slots) {
  slots_.assign(num_slots, 0U);
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    slots_[slot_of(cells_[i].key)] = static_cast<std::uint32_t>(i + 1);
  }
}

/// Whole frames go, so that what stays does not depend on the order of cells.
void SurfaceGrid::drop_oldest() {
  std::vector<std::uint64_t> frames;
  frames.reserve(cells_.size());
  for (const Cell& cell : cells_) frames.push_back(cell.newest_frame);
  const auto middle = frames.begin() + static_cast<std::ptrdiff_t>(frames.size() - max_cells_ / 2);
  std::nth_element(frames.begin(), middle, frames.end());
  std::erase_if(cells_, [oldest_kept = *middle](const Cell& cell) {
    return cell.newest_frame < oldest_kept;
  });
  rebuild_index(slots_.size());
}

void SurfaceGrid::add(std::span<const OrientedPoint> points) {
  ++num_frames_;
  for (const OrientedPoint& point : points) {
    const Eigen::Vector3d in_cells = point.place_m / cell_m_;
    if (!is_in_reach(in_cells) || !point.normal.allFinite()) continue;
    const CellIndex index = floor_of(in_cells);
    Cell& cell = find_or_add(key_of(index, direction_of(point.normal)));
    if (cell.weight >= kMaxWeight) {
      cell.weight *= kKeptShare;
      cell.sum_m *= kKeptShare;
      cell.products_m2 *= kKeptShare;
    }
    const Eigen::Vector3d inside_m =
        point.place_m - (index.cast<double>().array() + 0.5).matrix() * cell_m_;
    cell.newest_frame = num_frames_;
    cell.weight += 1.0;
    cell.sum_m += inside_m;
    cell.products_m2 += inside_m * inside_m.transpose();
  }
  if (cells_.size() > max_cells_) drop_oldest();
}

std::optional<SurfacePlane> SurfaceGrid::plane_at(const OrientedPoint& point,
                                                  double max_stddev_m) const {
  const Eigen::Vector3d in_cells = point.place_m / cell_m_;
  if (!is_in_reach(in_cells)) return std::nullopt;
  const std::uint64_t direction = direction_of(point.normal);
  // The corner that eight cells share, the nearest to the place.
  const CellIndex corner = floor_of(in_cells.array() + 0.5);
  double weight = 0.0;
  Eigen::Vector3d sum_m = Eigen::Vector3d::Zero();
  Eigen::Matrix3d products_m2 = Eigen::Matrix3d::Zero();
  for (int i = 0; i < 8; ++i) {
    const CellIndex below(i & 1, (i >> 1) & 1, (i >> 2) & 1);
    const Cell* cell = find(key_of(corner - below, direction));
    if (cell == nullptr) continue;
    const Eigen::Vector3d shift_m = (0.5 - below.cast<double>().array()).matrix() * cell_m_;
    weight += cell->weight;
    sum_m += cell->sum_m + cell->weight * shift_m;
    products_m2 += cell->products_m2 + shift_m * cell->sum_m.transpose() +
                   cell->sum_m * shift_m.transpose() + cell->weight * shift_m * shift_m.transpose();
  }
  if (weight < kMinPoints) return std::nullopt;
  const Eigen::Vector3d mean_m = sum_m / weight;
  const Eigen::Matrix3d covariance_m2 = products_m2 / weight - mean_m * mean_m.transpose();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(covariance_m2);
  const double thickness_m2 = std::max(solver.eigenvalues()[0], 0.0);
  if (thickness_m2 > kMaxFlatness * solver.eigenvalues()[1]) return std::nullopt;
  if (thickness_m2 > max_stddev_m * max_stddev_m) return std::nullopt;
  const Eigen::Vector3d normal = solver.eigenvectors().col(0);
  return SurfacePlane{.point_m = mean_m + corner.cast<double>() * cell_m_,
                      .normal = normal,
                      .stddev_m = std::sqrt(thickness_m2)};
}

void SurfaceModel::add(std::span<const OrientedPoint> points) {
  fine_.add(points);
  coarse_.add(points);
}

std::optional<SurfacePlane> SurfaceModel::plane_at(const OrientedPoint& point,
                                                   double max_stddev_m) const {
  const auto fine = fine_.plane_at(point, max_stddev_m);
  return fine ? fine : coarse_.plane_at(point, max_stddev_m);
}

void SurfaceModel::clear() noexcept {
  fine_.clear();
  coarse_.clear();
}

}  // namespace hypermap
