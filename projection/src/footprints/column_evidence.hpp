// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What the 3D map says of the columns around each object: can more of it stand there?
#pragma once

#include "hypermap/core/geometry/box.hpp"
#include "hypermap/core/geometry/leaf.hpp"
#include "hypermap/core/objects/object.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace hypermap {

/// Columns, as wide as the map's smallest leaf, over the heights that an object's box spans.
///
/// More of the object can stand in a column that was not looked through down to its foot, or where
/// something was measured that no other object owns. It cannot where sensors looked through and saw
/// what is under it, nor where another object stands. What is under it must have been seen, since
/// rays along a flat top clear the leaves of that top, but show nothing below it. And a column that
/// was looked through but for a level hides one: the seat of a chair seen from the height of the
/// seat, the top of a table seen from below. Where the object has points, those show it finer than
/// its leaves.
class ObjectColumns {
 public:
  /// Nothing is known of any column. Requires: edge_m > 0.
  /// Boundary: no columns where the box is not finite or has more than `max_columns`.
  ObjectColumns(const Object& object, double edge_m, std::size_t max_columns);

  [[nodiscard]] std::size_t size() const noexcept { return columns_.size(); }
  [[nodiscard]] bool empty() const noexcept { return columns_.empty(); }
  /// Requires: the leaf's edge is that of the columns doubled some times, on their lattice.
  void add(const LeafSample& leaf);
  /// Boundary: true where there is no column.
  [[nodiscard]] bool can_hold_more(const Eigen::Vector2d& point_in_map) const;

 private:
  struct Column {
    std::uint64_t known = 0;    ///< Bit i: of level i something was looked through or measured.
    std::uint64_t free = 0;     ///< Bit i: of level i something was looked through.
    float known_m = 0.0F;       ///< Height that was looked through or measured.
    bool is_foot_seen = false;  ///< What is beside or below the lowest leaf was measured.
    bool has_points = false;    ///< Supported ones of the object.
    bool is_blocked = false;    ///< Something was measured above its foot that may be the object.
  };
  struct Span {
    int first = 0;
    int last = -1;
  };
  [[nodiscard]] Span covered(const LeafSample& leaf, int axis) const;
  [[nodiscard]] std::uint64_t levels_of(const LeafSample& leaf) const;
  [[nodiscard]] std::optional<std::size_t> index_at(const Eigen::Vector2d& point_in_map) const;
  [[nodiscard]] bool may_be_of_object(const LeafSample& leaf, const Column& column) const;
  [[nodiscard]] bool shows_foot(const LeafSample& leaf) const;
  /// Whether nothing was seen of a level above one that was looked through, and what is above both
  /// was looked through or not seen either.
  [[nodiscard]] bool hides_level(const Column& column) const;

  ObjectId id_;
  Box box_;
  double edge_m_;
  double level_edge_m_;  ///< That of the columns, or that doubled until kMaxLevels are enough.
  /// Number of column (0, 0) and of the lowest level from the origin.
  Eigen::Vector3d first_ = Eigen::Vector3d::Zero();
  int cols_ = 0;
  int rows_ = 0;
  int levels_ = 0;
  std::vector<Column> columns_;
};

/// Of all objects of a map, 24 bytes each.
inline constexpr std::size_t kMaxColumns = 20'000'000;

/// The columns of each object, in its order, filled from the leaves. Frame: Map.
/// Requires: leaves are cubes; the smallest have the edge `leaf_edge_m` > 0, others that doubled
/// some times, on its lattice.
/// Boundary: without leaves nothing is known. Objects whose columns would make more than
/// kMaxColumns with those before have none: boxes may come from files of strangers.
/// Cost: one pass over the leaves, each against the objects of its tile; memory a column each.
[[nodiscard]] std::vector<ObjectColumns> columns_of(std::span<const Object* const> objects,
                                                    const LeafSource& leaves,
                                                    double leaf_edge_m);

}  // namespace hypermap
