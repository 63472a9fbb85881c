// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which objects of a semantic layer lie where, by their bounds.
///
/// Source: [hypermap] 2.5.3 (R*-tree).
#pragma once

#include "hypermap/projection/layers/semantic_layer.hpp"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace hypermap {

/// Where an object lies.
struct ObjectBounds {
  Rect bounds;
  std::uint64_t id = 0;
};

/// An R-tree beside the objects, which each call is given as they are before its change, but for
/// `change_many`.
///
/// Boost's tree need not survive memory that ends within a change. It is given up then, and all
/// objects are looked at until a later change has made the tree anew: what is found stays right.
class BoundsIndex {
 public:
  using Objects = std::span<const SemanticObject>;

  BoundsIndex();
  /// Packed at once.
  explicit BoundsIndex(Objects objects);
  BoundsIndex(const BoundsIndex& other);
  BoundsIndex(BoundsIndex&& other) noexcept;
  BoundsIndex& operator=(const BoundsIndex& other);
  BoundsIndex& operator=(BoundsIndex&& other) noexcept;
  ~BoundsIndex();

  /// Throws std::bad_alloc: the object is not found then.
  void insert(Objects objects, const SemanticObject& object);
  /// Throws std::bad_alloc: `old`, one of the objects, is found as it was then.
  void replace(Objects objects, const SemanticObject& old, const SemanticObject& object);
  /// `object` is one of the objects.
  void remove(Objects objects, const SemanticObject& object) noexcept;
  /// Many changes at once: `objects` are those after it, `gone` those that are no more or that lie
  /// elsewhere now, `come` the new ones and these again. Where most objects change the tree is
  /// packed anew.
  void change_many(Objects objects,
                   std::span<const ObjectBounds> gone,
                   std::span<const ObjectBounds> come) noexcept;

  /// Ids of the objects whose bounds meet the rectangle, in no order.
  [[nodiscard]] std::vector<std::uint64_t> find(Objects objects, const Rect& rect) const;

 private:
  template <class Change>
  void change(Objects objects, const Change& change);
  void give_up() noexcept;

  struct Tree;  // Boost's: its templates are compiled in one file.
  std::unique_ptr<Tree> tree_;
  bool is_whole_ = true;
};

}  // namespace hypermap
