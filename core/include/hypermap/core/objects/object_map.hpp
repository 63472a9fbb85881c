// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// All objects of a map, found by id and by place.
///
/// Source: [hypermap] 3.4.5: a map by id and an R-tree over bounding boxes.
#pragma once

#include "hypermap/core/base/cow_ref.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/box.hpp"
#include "hypermap/core/geometry/polygon.hpp"
#include "hypermap/core/objects/object.hpp"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <iterator>
#include <optional>
#include <vector>

namespace hypermap {

class ObjectStore;

/// Objects in ascending order of their ids, as they stand in a map. Lives until that is next
/// changed.
class ObjectRange {
 public:
  class Iterator {
   public:
    using iterator_category = std::forward_iterator_tag;
    using value_type = Object;
    using difference_type = std::ptrdiff_t;
    using pointer = const Object*;
    using reference = const Object&;

    Iterator() = default;
    Iterator(const ObjectStore* store, const Object* at) : store_(store), at_(at) {}
    reference operator*() const { return *at_; }
    pointer operator->() const { return at_; }
    Iterator& operator++();
    Iterator operator++(int) {
      Iterator before = *this;
      ++*this;
      return before;
    }
    friend bool operator==(const Iterator& a, const Iterator& b) { return a.at_ == b.at_; }

   private:
    const ObjectStore* store_ = nullptr;
    const Object* at_ = nullptr;  // null at the end
  };

  /// `store`: null when there are none.
  explicit ObjectRange(const ObjectStore* store) : store_(store) {}
  [[nodiscard]] Iterator begin() const;
  [[nodiscard]] Iterator end() const { return {store_, nullptr}; }
  [[nodiscard]] std::size_t size() const noexcept;
  [[nodiscard]] bool empty() const noexcept { return size() == 0; }

 private:
  const ObjectStore* store_;
};

/// Objects in ascending order of their ids, with an R-tree over their boxes. A value: copies are
/// independent, and share all memory until one side changes something, and then what is not
/// changed. Ids are given from 1 on and never again, also not after erasing.
///
/// When memory ends in a call that changes something, std::bad_alloc is thrown and nothing has
/// changed.
/// Cost: a copy is one atomic increment, at any number of objects.
/// Threads: const functions may run concurrently; a copy made before may be read, copied and
/// destroyed while the original is changed.
class ObjectMap {
 public:
  ObjectMap() noexcept;
  ObjectMap(const ObjectMap& other) noexcept;
  ObjectMap(ObjectMap&& other) noexcept;
  ObjectMap& operator=(const ObjectMap& other) noexcept;
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
  [[nodiscard]] ObjectRange objects() const noexcept;
  [[nodiscard]] std::size_t size() const noexcept { return objects().size(); }
  [[nodiscard]] bool empty() const noexcept { return size() == 0; }
  /// The id that the next object will get.
  [[nodiscard]] ObjectId next_id() const noexcept;

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
    return a.store_.shares(b.store_) ||
           (a.next_id() == b.next_id() &&
            std::equal(left.begin(), left.end(), right.begin(), right.end()));
  }

 private:
  [[nodiscard]] ObjectStore& writable();

  CowRef<ObjectStore> store_;  ///< Null: as a new one.
};

/// The models whose embeddings the objects have. Errors: those of EmbeddingDimensions::add, with
/// the object's id as the entry. Cost: one pass over the objects.
[[nodiscard]] Result<EmbeddingDimensions> embedding_dimensions(const ObjectMap& objects);

}  // namespace hypermap
