// SPDX-License-Identifier: BSD-3-Clause
#include "column_evidence.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>

namespace hypermap {
namespace {

/// A column that was known to less than this share of its height can hide something.
constexpr double kMinHiddenShare = 0.2;
/// As many as bits of a word.
constexpr int kMaxLevels = 64;
/// Edges are that far, in columns, on the other side of a column's edge by rounding at most.
constexpr double kSlackColumns = 1e-6;
/// Leaves are on an octree's lattice: one that is no larger than a tile lies in one tile.
constexpr double kTileColumns = 64.0;

double height_within(const LeafSample& leaf, const Box& box) {
  const double low = std::max(leaf.centre_in_map.z() - leaf.edge_m / 2, box.min_in_map.z());
  const double high = std::min(leaf.centre_in_map.z() + leaf.edge_m / 2, box.max_in_map.z());
  return std::max(high - low, 0.0);
}

/// Boundary: the edge itself where the box is not finite.
double level_edge_m(const Box& box, double edge_m) {
  const double height_m = box.extent().z();
  double level_m = edge_m;
  // Unaligned, a box reaches into one more level than its height fills.
  while (std::isfinite(height_m) && height_m > (kMaxLevels - 1) * level_m) level_m *= 2.0;
  return level_m;
}

/// Which objects' boxes reach into each tile of the plan.
class ObjectTiles {
 public:
  ObjectTiles(std::span<const Object* const> objects,
              std::span<const ObjectColumns> columns,
              double tile_m)
      : tile_m_(tile_m) {
    for (std::size_t i = 0; i < objects.size(); ++i) {
      if (columns[i].empty()) continue;
      all_.push_back(i);
      const Tile low = tile_at(objects[i]->box.min_in_map);
      const Tile high = tile_at(objects[i]->box.max_in_map);
      for (std::int64_t x = low[0]; x <= high[0]; ++x) {
        for (std::int64_t y = low[1]; y <= high[1]; ++y) tiles_[{x, y}].push_back(i);
      }
    }
  }

  /// Positions of all objects whose boxes reach to the leaf, and of others.
  [[nodiscard]] std::span<const std::size_t> near(const LeafSample& leaf) const {
    if (leaf.edge_m > tile_m_) return all_;
    const auto found = tiles_.find(tile_at(leaf.centre_in_map));
    return found == tiles_.end() ? std::span<const std::size_t>() : found->second;
  }

 private:
  using Tile = std::array<std::int64_t, 2>;
  [[nodiscard]] Tile tile_at(const Eigen::Vector3d& point) const {
    return {static_cast<std::int64_t>(std::floor(point.x() / tile_m_)),
            static_cast<std::int64_t>(std::floor(point.y() / tile_m_))};
  }

  double tile_m_;
  std::vector<std::size_t> all_;
  std::map<Tile, std::vector<std::size_t>> tiles_;
};

}  // namespace

ObjectColumns::ObjectColumns(const Object& object, double edge_m, std::size_t max_columns)
    : id_(object.id),
      box_(object.box),
      edge_m_(edge_m),
      level_edge_m_(level_edge_m(object.box, edge_m)) {
  const Eigen::Array3d edges_m(edge_m, edge_m, level_edge_m_);
  const Eigen::Vector3d first = (box_.min_in_map.array() / edges_m).floor();
  Eigen::Vector3d end = (box_.max_in_map.array() / edges_m).ceil();
  // A sliver of a level is none: half of it at least is of the box.
  end.z() = std::floor(box_.max_in_map.z() / level_edge_m_ + 0.5);
  const Eigen::Vector3d size = (end - first).cwiseMax(1.0);
  if (!(size.head<2>().prod() <= static_cast<double>(max_columns)) || !(size.z() <= kMaxLevels))
    return;
  first_ = first;
  cols_ = static_cast<int>(size.x());
  rows_ = static_cast<int>(size.y());
  levels_ = static_cast<int>(size.z());
  columns_.resize(static_cast<std::size_t>(cols_) * static_cast<std::size_t>(rows_));
  for (const Eigen::Vector3d& point : object.points.supported_points()) {
    if (const auto column = index_at(point.head<2>())) columns_[*column].has_points = true;
  }
}

std::optional<std::size_t> ObjectColumns::index_at(const Eigen::Vector2d& point_in_map) const {
  const Eigen::Vector2d place =
      (point_in_map / edge_m_).array().floor().matrix() - first_.head<2>();
  const bool is_inside =
      place.x() >= 0.0 && place.y() >= 0.0 && place.x() < cols_ && place.y() < rows_;
  if (!is_inside) return std::nullopt;
  return static_cast<std::size_t>(place.y()) * static_cast<std::size_t>(cols_) +
         static_cast<std::size_t>(place.x());
}

bool ObjectColumns::may_be_of_object(const LeafSample& leaf, const Column& column) const {
  const double z = leaf.centre_in_map.z();
  if (!leaf.occupied || z <= box_.min_in_map.z() + edge_m_ || z >= box_.max_in_map.z())
    return false;
  return leaf.object == kNoObject || (leaf.object == id_ && !column.has_points);
}

// A leaf within one edge of the lowest face that is occupied, or free below that face.
bool ObjectColumns::shows_foot(const LeafSample& leaf) const {
  const double foot_m = box_.min_in_map.z();
  const double half_m = leaf.edge_m / 2;
  const double low_m = leaf.centre_in_map.z() - half_m;
  const double high_m = leaf.centre_in_map.z() + half_m;
  if (high_m <= foot_m - edge_m_ || low_m >= foot_m + edge_m_) return false;
  return leaf.occupied || leaf.centre_in_map.z() < foot_m;
}

ObjectColumns::Span ObjectColumns::covered(const LeafSample& leaf, int axis) const {
  const double size = std::array{cols_, rows_, levels_}[static_cast<std::size_t>(axis)];
  const double edge_m = axis == 2 ? level_edge_m_ : edge_m_;
  const double low = (leaf.centre_in_map[axis] - leaf.edge_m / 2) / edge_m - first_[axis];
  const double high = low + leaf.edge_m / edge_m;
  if (!(high > 0.0 && low < size)) return {};
  return {static_cast<int>(std::floor(std::max(low + kSlackColumns, 0.0))),
          static_cast<int>(std::ceil(std::min(high - kSlackColumns, size))) - 1};
}

std::uint64_t ObjectColumns::levels_of(const LeafSample& leaf) const {
  const Span levels = covered(leaf, 2);
  std::uint64_t bits = 0;
  for (int level = levels.first; level <= levels.last; ++level) bits |= std::uint64_t{1} << level;
  return bits;
}

void ObjectColumns::add(const LeafSample& leaf) {
  const auto height_m = static_cast<float>(height_within(leaf, box_));
  const bool is_foot = shows_foot(leaf);
  if (columns_.empty() || !(height_m > 0.0F || is_foot)) return;
  const Span cols = covered(leaf, 0);
  const Span rows = covered(leaf, 1);
  const std::uint64_t levels = height_m > 0.0F ? levels_of(leaf) : 0;
  for (int row = rows.first; row <= rows.last; ++row) {
    for (int col = cols.first; col <= cols.last; ++col) {
      Column& column = columns_[static_cast<std::size_t>(row) * static_cast<std::size_t>(cols_) +
                                static_cast<std::size_t>(col)];
      column.known_m += height_m;
      column.known |= levels;
      if (!leaf.occupied) column.free |= levels;
      column.is_blocked = column.is_blocked || may_be_of_object(leaf, column);
      column.is_foot_seen = column.is_foot_seen || is_foot;
    }
  }
}

bool ObjectColumns::hides_level(const Column& column) const {
  bool is_free_below = false;
  bool is_hidden = false;
  for (int level = 0; level < levels_; ++level) {
    const auto has = [level](std::uint64_t levels) { return ((levels >> level) & 1U) != 0; };
    if (!has(column.known)) {
      is_hidden = is_free_below;
      continue;
    }
    if (is_hidden && has(column.free)) return true;
    is_free_below = has(column.free);
    is_hidden = false;
  }
  return is_hidden;
}

bool ObjectColumns::can_hold_more(const Eigen::Vector2d& point_in_map) const {
  const auto at = index_at(point_in_map);
  if (!at) return true;
  const Column& column = columns_[*at];
  const double height_m = box_.extent().z();
  return !column.is_foot_seen || column.is_blocked ||
         height_m - static_cast<double>(column.known_m) >= kMinHiddenShare * height_m ||
         hides_level(column);
}

std::vector<ObjectColumns> columns_of(std::span<const Object* const> objects,
                                      const LeafSource& leaves,
                                      double leaf_edge_m) {
  std::vector<ObjectColumns> columns;
  columns.reserve(objects.size());
  std::size_t num_left = kMaxColumns;
  for (const Object* object : objects) {
    columns.emplace_back(*object, leaf_edge_m, num_left);
    num_left -= columns.back().size();
  }
  const ObjectTiles tiles(objects, columns, kTileColumns * leaf_edge_m);
  leaves([&](const LeafSample& leaf) {
    for (const std::size_t i : tiles.near(leaf)) columns[i].add(leaf);
  });
  return columns;
}

}  // namespace hypermap
