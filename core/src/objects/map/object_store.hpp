// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How the objects of a map lie in memory: pages by id, and an R-tree over their boxes.
#pragma once

#include "hypermap/core/base/cow_ref.hpp"
#include "hypermap/core/objects/object.hpp"
#include "objects/map/box_tree.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace hypermap {

/// Objects by id. A copy shares pages, objects and the nodes of the tree; it costs one reference
/// for each 2,048 ids in use, and a change the page and the path of the tree that it touches.
///
/// Exceptions: std::bad_alloc, and nothing has changed then.
class ObjectStore {
 public:
  using Held = std::shared_ptr<const Object>;

  [[nodiscard]] std::size_t size() const noexcept { return num_objects_; }
  [[nodiscard]] ObjectId next_id() const noexcept { return next_id_; }
  [[nodiscard]] const BoxTree& boxes() const noexcept { return boxes_; }
  /// Null when there is none.
  [[nodiscard]] const Object* find(ObjectId id) const noexcept;
  /// The object of the lowest id that is `id` or above; null when there is none.
  [[nodiscard]] const Object* at_or_after(std::uint64_t id) const noexcept;

  /// Requires: no object has this id, it is not 0.
  void insert(Held object);
  /// Requires: an object has this id.
  void replace(Held object);
  /// Requires: an object has this id.
  void erase(ObjectId id);
  void set_next_id(ObjectId id) noexcept { next_id_ = id; }

  OwnerCount owners;

 private:
  static constexpr std::uint32_t kPageSize = 32;
  static constexpr std::uint32_t kPages = 64;
  static constexpr std::uint32_t kIdsPerDirectory = kPageSize * kPages;

  struct Page {
    std::array<Held, kPageSize> objects;  // null where no object has the id
    std::uint32_t num_objects = 0;
    OwnerCount owners;
  };
  struct Directory {
    std::array<CowRef<Page>, kPages> pages;  // null where no object has an id of the page
    std::uint32_t num_objects = 0;
    OwnerCount owners;
  };
  struct Root {
    std::uint32_t number = 0;  // of ids number * kIdsPerDirectory and on
    CowRef<Directory> directory;
  };

  [[nodiscard]] std::vector<Root>::const_iterator root_of(std::uint32_t number) const noexcept;
  [[nodiscard]] Directory& writable_directory(ObjectId id);
  [[nodiscard]] Page& writable_page(Directory& directory, ObjectId id);

  std::vector<Root> roots_;  // ascending
  BoxTree boxes_;
  std::size_t num_objects_ = 0;
  ObjectId next_id_{1};
};

}  // namespace hypermap
