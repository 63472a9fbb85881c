// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which objects of a semantic layer lie where, by their bounds.
///
/// Source: [hypermap] 2.5.3 (R*-tree).
#pragma once

#include "hypermap/projection/layers/semantic_layer.hpp"

#include <boost/geometry.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>

#include <cstdint>
#include <span>
#include <utility>

namespace hypermap {

/// An R-tree beside the objects, which each call is given as they are before its change.
///
/// Boost's tree need not survive memory that ends within a change. It is given up then, and all
/// objects are looked at until a later change has made the tree anew: what is found stays right.
class BoundsIndex {
 public:
  using Objects = std::span<const SemanticObject>;

  BoundsIndex() = default;
  /// Packed at once.
  explicit BoundsIndex(Objects objects);

  /// Throws std::bad_alloc: the object is not found then.
  void insert(Objects objects, const SemanticObject& object);
  /// Throws std::bad_alloc: `old`, one of the objects, is found as it was then.
  void replace(Objects objects, const SemanticObject& old, const SemanticObject& object);
  /// `object` is one of the objects.
  void remove(Objects objects, const SemanticObject& object) noexcept;

  /// Calls `visit` with the id of each object whose bounds meet the rectangle, in no order.
  template <class Visit>
  void for_each(Objects objects, const Rect& rect, const Visit& visit) const {
    namespace bgi = boost::geometry::index;
    if (is_whole_) {
      for (auto it = tree_.qbegin(bgi::intersects(box_of(rect))); it != tree_.qend(); ++it)
        visit(it->second);
      return;
    }
    for (const SemanticObject& object : objects)
      if (boost::geometry::intersects(box_of(bounds_of(object)), box_of(rect))) visit(object.id);
  }

 private:
  using Point = boost::geometry::model::point<double, 2, boost::geometry::cs::cartesian>;
  using Box = boost::geometry::model::box<Point>;
  using Entry = std::pair<Box, std::uint64_t>;
  using Tree = boost::geometry::index::rtree<Entry, boost::geometry::index::rstar<16>>;

  static Box box_of(const Rect& rect) {
    return {{rect.min.x(), rect.min.y()}, {rect.max.x(), rect.max.y()}};
  }
  static Entry entry_of(const SemanticObject& object);
  static Tree packed(Objects objects);
  template <class Change>
  void change(Objects objects, const Change& change);
  void give_up() noexcept;

  Tree tree_;
  bool is_whole_ = true;
};

}  // namespace hypermap
