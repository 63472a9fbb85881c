// SPDX-License-Identifier: BSD-3-Clause
#include "bounds_index.hpp"

#include <new>
#include <vector>

namespace hypermap {

BoundsIndex::Entry BoundsIndex::entry_of(const SemanticObject& object) {
  return {box_of(bounds_of(object)), object.id};
}

BoundsIndex::Tree BoundsIndex::packed(Objects objects) {
  std::vector<Entry> entries;
  entries.reserve(objects.size());
  for (const SemanticObject& object : objects) entries.push_back(entry_of(object));
  return {entries.begin(), entries.end()};
}

void BoundsIndex::give_up() noexcept {
  tree_.clear();
  is_whole_ = false;
}

template <class Change>
void BoundsIndex::change(Objects objects, const Change& change) {
  if (!is_whole_) tree_ = packed(objects);
  is_whole_ = true;
  try {
    change();
  } catch (...) {
    give_up();
    throw;
  }
}

BoundsIndex::BoundsIndex(Objects objects) : tree_(packed(objects)) {}

void BoundsIndex::insert(Objects objects, const SemanticObject& object) {
  change(objects, [&] { tree_.insert(entry_of(object)); });
}

void BoundsIndex::replace(Objects objects,
                          const SemanticObject& old,
                          const SemanticObject& object) {
  change(objects, [&] {
    tree_.remove(entry_of(old));
    tree_.insert(entry_of(object));
  });
}

void BoundsIndex::remove(Objects objects, const SemanticObject& object) noexcept try {
  change(objects, [&] { tree_.remove(entry_of(object)); });
} catch (const std::bad_alloc&) {
  give_up();
}

}  // namespace hypermap
