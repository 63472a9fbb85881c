// SPDX-License-Identifier: BSD-3-Clause
#include "bounds_index.hpp"

#include <boost/geometry.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>

#include <new>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

namespace bg = boost::geometry;
using BoundsPoint = bg::model::point<double, 2, bg::cs::cartesian>;
using BoundsBox = bg::model::box<BoundsPoint>;
using Entry = std::pair<BoundsBox, std::uint64_t>;
using BoxTree = bg::index::rtree<Entry, bg::index::rstar<16>>;

BoundsBox box_of(const Rect& rect) {
  return {{rect.min.x(), rect.min.y()}, {rect.max.x(), rect.max.y()}};
}

Entry entry_of(const SemanticObject& object) {
  return {box_of(bounds_of(object)), object.id};
}

BoxTree packed(BoundsIndex::Objects objects) {
  std::vector<Entry> entries;
  entries.reserve(objects.size());
  for (const SemanticObject& object : objects) entries.push_back(entry_of(object));
  return {entries.begin(), entries.end()};
}

}  // namespace

struct BoundsIndex::Tree {
  Tree() = default;
  explicit Tree(BoxTree packed) : boxes(std::move(packed)) {}
  BoxTree boxes;
};

BoundsIndex::BoundsIndex() : tree_(std::make_unique<Tree>()) {}
BoundsIndex::BoundsIndex(Objects objects) : tree_(std::make_unique<Tree>(packed(objects))) {}
BoundsIndex::BoundsIndex(const BoundsIndex& other)
    : tree_(std::make_unique<Tree>(*other.tree_)), is_whole_(other.is_whole_) {}
BoundsIndex::BoundsIndex(BoundsIndex&& other) noexcept = default;
BoundsIndex& BoundsIndex::operator=(const BoundsIndex& other) {
  if (this != &other) *this = BoundsIndex(other);
  return *this;
}
BoundsIndex& BoundsIndex::operator=(BoundsIndex&& other) noexcept = default;
BoundsIndex::~BoundsIndex() = default;

void BoundsIndex::give_up() noexcept {
  tree_->boxes.clear();
  is_whole_ = false;
}

template <class Change>
void BoundsIndex::change(Objects objects, const Change& change) {
  if (!is_whole_) tree_->boxes = packed(objects);
  is_whole_ = true;
  try {
    change(tree_->boxes);
  } catch (...) {
    give_up();
    throw;
  }
}

void BoundsIndex::insert(Objects objects, const SemanticObject& object) {
  change(objects, [&](BoxTree& boxes) { boxes.insert(entry_of(object)); });
}

void BoundsIndex::replace(Objects objects,
                          const SemanticObject& old,
                          const SemanticObject& object) {
  change(objects, [&](BoxTree& boxes) {
    boxes.remove(entry_of(old));
    boxes.insert(entry_of(object));
  });
}

void BoundsIndex::remove(Objects objects, const SemanticObject& object) noexcept try {
  change(objects, [&](BoxTree& boxes) { boxes.remove(entry_of(object)); });
} catch (const std::bad_alloc&) {
  give_up();
}

void BoundsIndex::change_many(Objects objects,
                              std::span<const ObjectBounds> gone,
                              std::span<const ObjectBounds> come) noexcept try {
  if (!is_whole_ || gone.size() + come.size() > objects.size()) {
    tree_->boxes = packed(objects);
    is_whole_ = true;
    return;
  }
  for (const auto& [rect, id] : gone) tree_->boxes.remove({box_of(rect), id});
  for (const auto& [rect, id] : come) tree_->boxes.insert({box_of(rect), id});
} catch (const std::bad_alloc&) {
  give_up();
}

std::vector<std::uint64_t> BoundsIndex::find(Objects objects, const Rect& rect) const {
  std::vector<std::uint64_t> ids;
  if (is_whole_) {
    const auto meets = bg::index::intersects(box_of(rect));
    for (auto it = tree_->boxes.qbegin(meets); it != tree_->boxes.qend(); ++it)
      ids.push_back(it->second);
    return ids;
  }
  for (const SemanticObject& object : objects)
    if (bg::intersects(box_of(bounds_of(object)), box_of(rect))) ids.push_back(object.id);
  return ids;
}

}  // namespace hypermap
