// SPDX-License-Identifier: BSD-3-Clause
#include "places/column_surface.hpp"

#include "geometry/floor_of.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <tuple>

namespace hypermap {
namespace {

bool is_before(const Column& a, const Column& b) {
  return std::tuple(a.x, a.y) < std::tuple(b.x, b.y);
}

Column column_at(const Eigen::Vector3d& point, double edge_m) {
  return {.x = static_cast<std::int32_t>(floor_of(point.x() / edge_m)),
          .y = static_cast<std::int32_t>(floor_of(point.y() / edge_m)),
          .bottom_m = point.z(),
          .top_m = point.z()};
}

}  // namespace

ColumnSurface::ColumnSurface(std::span<const Eigen::Vector3d> points_in_map, double edge_m)
    : edge_m_(edge_m) {
  std::vector<Column> single;
  single.reserve(points_in_map.size());
  for (const Eigen::Vector3d& point : points_in_map) single.push_back(column_at(point, edge_m));
  std::sort(single.begin(), single.end(), is_before);
  for (const Column& one : single) {
    if (columns_.empty() || is_before(columns_.back(), one)) {
      columns_.push_back(one);
      continue;
    }
    columns_.back().bottom_m = std::min(columns_.back().bottom_m, one.bottom_m);
    columns_.back().top_m = std::max(columns_.back().top_m, one.top_m);
  }
}

const Column* ColumnSurface::find(std::int32_t x, std::int32_t y) const {
  const Column wanted{.x = x, .y = y};
  const auto found = std::lower_bound(columns_.begin(), columns_.end(), wanted, is_before);
  return found != columns_.end() && found->x == x && found->y == y ? &*found : nullptr;
}

std::vector<Column> ColumnSurface::within(const Polygon& polygon, double rim_m) const {
  const Rect rect = bounds(polygon);
  const auto first_x = static_cast<std::int32_t>(floor_of((rect.min.x() - rim_m) / edge_m_));
  const auto first = std::lower_bound(
      columns_.begin(), columns_.end(), first_x, [](const Column& column, std::int32_t x) {
        return column.x < x;
      });
  std::vector<Column> found;
  for (auto at = first; at != columns_.end(); ++at) {
    const Eigen::Vector2d middle((at->x + 0.5) * edge_m_, (at->y + 0.5) * edge_m_);
    if (middle.x() > rect.max.x() + rim_m) break;
    if (middle.y() < rect.min.y() - rim_m || middle.y() > rect.max.y() + rim_m) continue;
    if (distance_m(polygon, middle) <= rim_m) found.push_back(*at);
  }
  return found;
}

double ColumnSurface::height_reached_by(double share) const {
  std::vector<double> tops;
  tops.reserve(columns_.size());
  for (const Column& column : columns_) tops.push_back(column.top_m);
  std::sort(tops.begin(), tops.end(), std::greater<>());
  const double wanted = std::ceil(share * static_cast<double>(tops.size()));
  return tops[std::min(tops.size(), static_cast<std::size_t>(std::max(1.0, wanted))) - 1];
}

double lower_median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace hypermap
