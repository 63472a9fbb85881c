// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/objects/object_map.hpp"

#include "objects/map/object_store.hpp"

#include <algorithm>
#include <cassert>
#include <limits>
#include <memory>
#include <string>
#include <utility>

namespace hypermap {
namespace {

bool is_sound(const Box& box) {
  return box.min_in_map.allFinite() && box.max_in_map.allFinite() &&
         (box.min_in_map.array() <= box.max_in_map.array()).all();
}

}  // namespace

ObjectRange::Iterator& ObjectRange::Iterator::operator++() {
  at_ = store_->at_or_after(std::uint64_t{at_->id.value} + 1);
  return *this;
}

ObjectRange::Iterator ObjectRange::begin() const {
  return {store_, store_ == nullptr ? nullptr : store_->at_or_after(0)};
}

std::size_t ObjectRange::size() const noexcept {
  return store_ == nullptr ? 0 : store_->size();
}

ObjectMap::ObjectMap() noexcept = default;
ObjectMap::ObjectMap(const ObjectMap& other) noexcept = default;
ObjectMap::ObjectMap(ObjectMap&& other) noexcept = default;
ObjectMap& ObjectMap::operator=(const ObjectMap& other) noexcept = default;
ObjectMap& ObjectMap::operator=(ObjectMap&& other) noexcept = default;
ObjectMap::~ObjectMap() = default;

Result<ObjectMap> ObjectMap::restore(std::vector<Object> objects, ObjectId next_id) {
  std::sort(
      objects.begin(), objects.end(), [](const Object& a, const Object& b) { return a.id < b.id; });
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const ObjectId id = objects[i].id;
    const std::string name = "objects " + std::to_string(id.value);
    if (id == kNoObject || id >= next_id) {
      return fail(ErrorCode::kInvalidArgument,
                  "ids must be in 1.." + std::to_string(next_id.value) + " - 1",
                  name);
    }
    if (i > 0 && objects[i - 1].id == id) {
      return fail(ErrorCode::kInvalidArgument, "the id is there twice", name);
    }
    if (!is_sound(objects[i].box)) {
      return fail(ErrorCode::kInvalidArgument, "the box must be finite and min <= max", name);
    }
  }
  ObjectMap map;
  ObjectStore& store = map.writable();
  for (Object& object : objects) store.insert(std::make_shared<const Object>(std::move(object)));
  store.set_next_id(next_id);
  return map;
}

ObjectStore& ObjectMap::writable() {
  if (!store_) store_ = CowRef<ObjectStore>::make();
  return store_.writable();
}

ObjectRange ObjectMap::objects() const noexcept {
  return ObjectRange(store_ ? &*store_ : nullptr);
}

ObjectId ObjectMap::next_id() const noexcept {
  return store_ ? store_->next_id() : ObjectId{1};
}

ObjectId ObjectMap::add(Object object) {
  assert(is_sound(object.box));
  ObjectStore& store = writable();
  const ObjectId id = store.next_id();
  object.id = id;
  store.insert(std::make_shared<const Object>(std::move(object)));
  store.set_next_id(ObjectId{id.value + 1});
  return id;
}

void ObjectMap::replace(Object object) {
  assert(contains(object.id) && is_sound(object.box));
  writable().replace(std::make_shared<const Object>(std::move(object)));
}

void ObjectMap::modify(ObjectId id, const std::function<void(Object&)>& change) {
  const auto changed = std::make_shared<Object>(at(id));
  change(*changed);
  assert(changed->id == id && is_sound(changed->box));
  writable().replace(changed);
}

bool ObjectMap::erase(ObjectId id) {
  if (!contains(id)) return false;
  writable().erase(id);
  return true;
}

const Object* ObjectMap::find(ObjectId id) const {
  return store_ ? store_->find(id) : nullptr;
}

const Object& ObjectMap::at(ObjectId id) const {
  const Object* object = find(id);
  assert(object != nullptr);
  return *object;
}

std::vector<ObjectId> ObjectMap::query(const Box& box) const {
  return store_ ? store_->boxes().query(box) : std::vector<ObjectId>{};
}

std::vector<ObjectId> ObjectMap::query(const Rect& area) const {
  constexpr double kAnyHeight = std::numeric_limits<double>::max();
  return query(
      Box{{area.min.x(), area.min.y(), -kAnyHeight}, {area.max.x(), area.max.y(), kAnyHeight}});
}

std::optional<ObjectId> ObjectMap::nearest(const PointInMap& point,
                                           const std::function<bool(const Object&)>& accept) const {
  if (!store_) return std::nullopt;
  return store_->boxes().nearest(point.xyz, [&](ObjectId id) { return accept(at(id)); });
}

std::optional<ObjectId> ObjectMap::nearest(const PointInMap& point,
                                           std::optional<ClassId> class_id) const {
  return nearest(point, [&](const Object& object) {
    if (!class_id) return true;
    const auto best = best_class(object);
    return best && best->id == *class_id;
  });
}

Result<EmbeddingDimensions> embedding_dimensions(const ObjectMap& objects) {
  EmbeddingDimensions dimensions;
  for (const Object& object : objects.objects()) {
    for (const MeanEmbedding& embedding : object.embeddings.entries()) {
      auto added = dimensions.add(embedding.model, embedding.mean.size());
      if (added) continue;
      added.error().entry = "object " + std::to_string(object.id.value);
      return tl::make_unexpected(std::move(added).error());
    }
  }
  return dimensions;
}

}  // namespace hypermap
