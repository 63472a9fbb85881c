// SPDX-License-Identifier: BSD-3-Clause
#include "objects/map/object_store.hpp"

#include <algorithm>
#include <cassert>

namespace hypermap {

std::vector<ObjectStore::Root>::const_iterator ObjectStore::root_of(
    std::uint32_t number) const noexcept {
  return std::lower_bound(
      roots_.begin(), roots_.end(), number, [](const Root& root, std::uint32_t key) {
        return root.number < key;
      });
}

const Object* ObjectStore::find(ObjectId id) const noexcept {
  const auto root = root_of(id.value / kIdsPerDirectory);
  if (root == roots_.end() || root->number != id.value / kIdsPerDirectory) return nullptr;
  const CowRef<Page>& page = root->directory->pages[id.value / kPageSize % kPages];
  return page ? page->objects[id.value % kPageSize].get() : nullptr;
}

const Object* ObjectStore::at_or_after(std::uint64_t id) const noexcept {
  auto root = root_of(static_cast<std::uint32_t>(id / kIdsPerDirectory));
  for (; root != roots_.end(); ++root) {
    const std::uint64_t first = std::uint64_t{root->number} * kIdsPerDirectory;
    const std::uint64_t from = std::max(id, first) - first;
    for (std::uint64_t i = from / kPageSize; i < kPages; ++i) {
      const CowRef<Page>& page = root->directory->pages[i];
      if (!page) continue;
      for (std::uint64_t k = i == from / kPageSize ? from % kPageSize : 0; k < kPageSize; ++k) {
        if (page->objects[k]) return page->objects[k].get();
      }
    }
  }
  return nullptr;
}

/// Made when absent. An empty one that is left behind when memory ends holds no object.
ObjectStore::Directory& ObjectStore::writable_directory(ObjectId id) {
  const std::uint32_t number = id.value / kIdsPerDirectory;
  const auto at = roots_.begin() + (root_of(number) - roots_.cbegin());
  if (at != roots_.end() && at->number == number) return at->directory.writable();
  auto made = CowRef<Directory>::make();
  return roots_.insert(at, Root{number, std::move(made)})->directory.sole();
}

ObjectStore::Page& ObjectStore::writable_page(Directory& directory, ObjectId id) {
  CowRef<Page>& page = directory.pages[id.value / kPageSize % kPages];
  if (!page) page = CowRef<Page>::make();
  return page.writable();
}

void ObjectStore::insert(Held object) {
  const ObjectId id = object->id;
  assert(id != kNoObject && find(id) == nullptr);
  BoxTree boxes = boxes_.with(object->box, id);
  Directory& directory = writable_directory(id);
  Page& page = writable_page(directory, id);
  // From here on nothing can fail.
  boxes_ = std::move(boxes);
  page.objects[id.value % kPageSize] = std::move(object);
  ++page.num_objects;
  ++directory.num_objects;
  ++num_objects_;
}

void ObjectStore::replace(Held object) {
  const ObjectId id = object->id;
  const Object* before = find(id);
  assert(before != nullptr);
  BoxTree boxes = boxes_;
  if (!(object->box == before->box)) {
    boxes = boxes_.without(before->box, id).with(object->box, id);
  }
  Page& page = writable_page(writable_directory(id), id);
  boxes_ = std::move(boxes);
  page.objects[id.value % kPageSize] = std::move(object);
}

void ObjectStore::erase(ObjectId id) {
  const Object* object = find(id);
  assert(object != nullptr);
  BoxTree boxes = boxes_.without(object->box, id);
  Directory& directory = writable_directory(id);
  Page& page = writable_page(directory, id);
  boxes_ = std::move(boxes);
  page.objects[id.value % kPageSize] = nullptr;
  --num_objects_;
  if (--page.num_objects == 0) directory.pages[id.value / kPageSize % kPages] = {};
  if (--directory.num_objects != 0) return;
  roots_.erase(root_of(id.value / kIdsPerDirectory));
}

}  // namespace hypermap
