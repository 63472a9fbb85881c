// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// All objects of a map, found by id and by place.
///
/// Source: [hypermap] 3.4.5: a map by id and an R-tree over bounding boxes.
#pragma once

#include "hypermap/core/box.hpp"
#include "hypermap/core/object.hpp"
#include "hypermap/core/polygon.hpp"
#include "hypermap/core/result.hpp"

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace hypermap {

/// Objects in ascending order of their ids, with an R-tree over their boxes. A value: copies are
/// independent. Ids are given from 1 on and never again, also not after erasing.
class ObjectMap {
 public:
  ObjectMap();
  ObjectMap(const ObjectMap& other);
  ObjectMap(ObjectMap&& other) noexcept;
  ObjectMap& operator=(const ObjectMap& other);
  ObjectMap& operator=(ObjectMap&& other) noexcept;
  ~ObjectMap();

  /// A stored map. Errors: kInvalidArgument: an id is 0, not below `next_id` or there twice; a box
  /// is not finite or inside out.
  [[nodiscard]] static Result<ObjectMap> restore(std::vector<Object> objects, ObjectId next_id);

  /// Gives the object the next id, which is returned; its own is ignored.
  /// Requires: a finite box, min <= max. Cost: O(log n).
  ObjectId add(Object object);
  /// Requires: contains(object.id), a finite box. Cost: O(log n).
  void replace(Object object);
  /// Lets `change` alter an object in place and brings the R-tree up to date.
  /// Requires: contains(id); `change` leaves the id and a finite box.
  void modify(ObjectId id, const std::function<void(Object&)>& change);
  /// False when there is none.
  bool erase(ObjectId id);

  [[nodiscard]] bool contains(ObjectId id) const { return find(id) != nullptr; }
  /// None when there is none. The pointer lives until the map is next changed.
  [[nodiscard]] const Object* find(ObjectId id) const;
  /// Requires: contains(id).
  [[nodiscard]] const Object& at(ObjectId id) const;
  /// In ascending order of ids. The span lives until the map is next changed.
  [[nodiscard]] std::span<const Object> objects() const noexcept { return objects_; }
  [[nodiscard]] std::size_t size() const noexcept { return objects_.size(); }
  [[nodiscard]] bool empty() const noexcept { return objects_.empty(); }
  /// The id that the next object will get.
  [[nodiscard]] ObjectId next_id() const noexcept { return next_id_; }

  /// Objects whose boxes meet `box` (closed), in ascending order of ids. Cost: O(log n + result).
  [[nodiscard]] std::vector<ObjectId> query(const Box& box) const;
  /// Objects whose boxes meet the rectangle at any height, in ascending order of ids.
  [[nodiscard]] std::vector<ObjectId> query(const Rect& area) const;
  /// The accepted object whose box is nearest to the point; the lowest id of equals.
  [[nodiscard]] std::optional<ObjectId> nearest(
      const PointInMap& point, const std::function<bool(const Object&)>& accept) const;
  /// The same for objects whose best class is `class_id`; any class when none is given.
  [[nodiscard]] std::optional<ObjectId> nearest(const PointInMap& point,
                                                std::optional<ClassId> class_id) const;

  friend bool operator==(const ObjectMap& a, const ObjectMap& b) {
    return a.next_id_ == b.next_id_ && a.objects_ == b.objects_;
  }

 private:
  struct Index;  ///< The R-tree.
  [[nodiscard]] std::vector<Object>::iterator position_of(ObjectId id);

  std::vector<Object> objects_;
  ObjectId next_id_{1};
  std::unique_ptr<Index> index_;
};

}  // namespace hypermap
