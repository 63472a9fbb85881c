// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// All objects of a map, found by id and by place.
///
/// Source: [hypermap] 3.4.5: a map by id and an R-tree over bounding boxes.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/box.hpp"
#include "hypermap/core/geometry/polygon.hpp"
#include "hypermap/core/objects/object.hpp"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <iterator>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace hypermap {

/// Objects in ascending order of their ids, as they stand in a map. Lives until that is next
/// changed.
class ObjectRange {
 public:
  using Held = std::shared_ptr<const Object>;

  class Iterator {
   public:
    using iterator_category = std::forward_iterator_tag;
    using value_type = Object;
    using difference_type = std::ptrdiff_t;
    using pointer = const Object*;
    using reference = const Object&;

    Iterator() = default;
    explicit Iterator(const Held* at) : at_(at) {}
    reference operator*() const { return **at_; }
    pointer operator->() const { return at_->get(); }
    Iterator& operator++() {
      ++at_;
      return *this;
    }
    Iterator operator++(int) {
      Iterator before = *this;
      ++at_;
      return before;
    }
    friend bool operator==(const Iterator&, const Iterator&) = default;

   private:
    const Held* at_ = nullptr;
  };

  explicit ObjectRange(std::span<const Held> held) : held_(held) {}
  [[nodiscard]] Iterator begin() const { return Iterator(held_.data()); }
  [[nodiscard]] Iterator end() const { return Iterator(held_.data() + held_.size()); }
  [[nodiscard]] std::size_t size() const noexcept { return held_.size(); }
  [[nodiscard]] bool empty() const noexcept { return held_.empty(); }
  [[nodiscard]] const Object& operator[](std::size_t i) const { return *held_[i]; }

 private:
  std::span<const Held> held_;
};

/// Objects in ascending order of their ids, with an R-tree over their boxes. A value: copies are
/// independent, and cheap, since they share objects until one side changes them. Ids are given from
/// 1 on and never again, also not after erasing.
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
  /// Lets `change` alter a copy of an object, which then takes its place, and brings the R-tree up
  /// to date. Requires: contains(id); `change` leaves the id and a finite box.
  void modify(ObjectId id, const std::function<void(Object&)>& change);
  /// False when there is none.
  bool erase(ObjectId id);

  [[nodiscard]] bool contains(ObjectId id) const { return find(id) != nullptr; }
  /// None when there is none. The pointer lives until the map is next changed.
  [[nodiscard]] const Object* find(ObjectId id) const;
  /// Requires: contains(id).
  [[nodiscard]] const Object& at(ObjectId id) const;
  /// In ascending order of ids. The range lives until the map is next changed.
  [[nodiscard]] ObjectRange objects() const noexcept { return ObjectRange(objects_); }
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
    const ObjectRange left = a.objects();
    const ObjectRange right = b.objects();
    return a.next_id_ == b.next_id_ &&
           std::equal(left.begin(), left.end(), right.begin(), right.end());
  }

 private:
  struct Index;  ///< The R-tree.
  [[nodiscard]] std::size_t position_of(ObjectId id) const;
  void put(std::size_t position, ObjectRange::Held object);

  std::vector<ObjectRange::Held> objects_;
  ObjectId next_id_{1};
  std::unique_ptr<Index> index_;
};

}  // namespace hypermap
