// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/viewer_offscreen/rendering/sky_light.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>

namespace hypermap {
namespace {

constexpr int kNumDirections = 12;
constexpr float kReachM = 1.0F;
constexpr float kSmallestCellM = 0.04F;  // of the plan: bounds the steps to take
constexpr float kMaxColumns = 16'777'216.0F;

int cell_of(float place, float origin, float cell_m) {
  return static_cast<int>(std::floor((place - origin) / cell_m));
}

}  // namespace

SkyLight::SkyLight(std::span<const OccupiedVoxel> voxels) {
  if (voxels.empty()) return;
  measure_plan(voxels);
  plan_directions();
  top_m_.assign(static_cast<std::size_t>(cols_) * static_cast<std::size_t>(rows_),
                std::numeric_limits<float>::lowest());
  for (const OccupiedVoxel& voxel : voxels) {
    const Eigen::Vector3f& centre = voxel.centre_in_map;
    const int col = cell_of(centre.x(), origin_.x(), cell_m_);
    const int row = cell_of(centre.y(), origin_.y(), cell_m_);
    if (col < 0 || row < 0 || col >= cols_ || row >= rows_) continue;
    float& top = top_m_[static_cast<std::size_t>(row) * static_cast<std::size_t>(cols_) +
                        static_cast<std::size_t>(col)];
    top = std::max(top, centre.z() + 0.5F * voxel.edge_m);
  }
}

void SkyLight::measure_plan(std::span<const OccupiedVoxel> voxels) {
  Eigen::Vector2f low = voxels.front().centre_in_map.head<2>();
  Eigen::Vector2f high = low;
  for (const OccupiedVoxel& voxel : voxels) {
    low = low.cwiseMin(voxel.centre_in_map.head<2>());
    high = high.cwiseMax(voxel.centre_in_map.head<2>());
  }
  cell_m_ = std::max(finest_edge_m(voxels), kSmallestCellM);
  const Eigen::Vector2f size = high - low;
  const auto columns = [&] { return (size / cell_m_).array() + 2.0F; };
  while (columns().prod() > kMaxColumns) cell_m_ *= 2.0F;
  origin_ = low.array() - 0.5F * cell_m_;
  cols_ = cell_of(high.x(), origin_.x(), cell_m_) + 1;
  rows_ = cell_of(high.y(), origin_.y(), cell_m_) + 1;
}

void SkyLight::plan_directions() {
  const int num_steps = static_cast<int>(std::ceil(kReachM / cell_m_));
  for (int i = 0; i < kNumDirections; ++i) {
    const double angle = 2.0 * std::numbers::pi * (i + 0.5) / kNumDirections;
    Direction direction{Eigen::Vector2d(std::cos(angle), std::sin(angle)).cast<float>(), {}};
    for (int k = 1; k <= num_steps; ++k) {
      const float distance_m = static_cast<float>(k) * cell_m_;
      direction.steps.push_back({static_cast<int>(std::lround(k * std::cos(angle))),
                                 static_cast<int>(std::lround(k * std::sin(angle))),
                                 std::max(0.0F, 1.0F - distance_m / kReachM) / distance_m});
    }
    directions_.push_back(std::move(direction));
  }
}

float SkyLight::top_of(int col, int row) const {
  if (col < 0 || row < 0 || col >= cols_ || row >= rows_) {
    return std::numeric_limits<float>::lowest();
  }
  return top_m_[static_cast<std::size_t>(row) * static_cast<std::size_t>(cols_) +
                static_cast<std::size_t>(col)];
}

float SkyLight::at(const Eigen::Vector3f& point_in_map, FaceDirection face) const {
  if (top_m_.empty()) return 1.0F;
  const int col = cell_of(point_in_map.x(), origin_.x(), cell_m_);
  const int row = cell_of(point_in_map.y(), origin_.y(), cell_m_);
  const Eigen::Vector2f normal = normal_of(face).head<2>();
  float light = 0.0F;
  float num_directions = 0.0F;
  for (const Direction& direction : directions_) {
    if (direction.towards.dot(normal) < 0.0F) continue;
    float steepest = 0.0F;  // tangent of the horizon
    for (const Step& step : direction.steps) {
      const float rise = top_of(col + step.col, row + step.row) - point_in_map.z();
      steepest = std::max(steepest, rise * step.per_rise);
    }
    // Over a horizon at angle h, of a surface that looks up: cos^2 h = 1 / (1 + tan^2 h).
    light += 1.0F / (1.0F + steepest * steepest);
    num_directions += 1.0F;
  }
  return light / num_directions;
}

}  // namespace hypermap
