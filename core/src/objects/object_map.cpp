// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/objects/object_map.hpp"

#include <boost/geometry.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>

#include <algorithm>
#include <cassert>
#include <iterator>
#include <limits>
#include <string>
#include <utility>

namespace hypermap {
namespace {

namespace bg = boost::geometry;
namespace bgi = boost::geometry::index;
using BoostPoint = bg::model::point<double, 3, bg::cs::cartesian>;
using BoostBox = bg::model::box<BoostPoint>;
using Entry = std::pair<BoostBox, std::uint32_t>;

BoostPoint to_boost(const Eigen::Vector3d& p) {
  return {p.x(), p.y(), p.z()};
}

BoostBox to_boost(const Box& box) {
  return {to_boost(box.min_in_map), to_boost(box.max_in_map)};
}

Entry entry_of(const Object& object) {
  return {to_boost(object.box), object.id.value};
}

bool is_sound(const Box& box) {
  return box.min_in_map.allFinite() && box.max_in_map.allFinite() &&
         (box.min_in_map.array() <= box.max_in_map.array()).all();
}

}  // namespace

struct ObjectMap::Index {
  bgi::rtree<Entry, bgi::quadratic<16>> tree;

  [[nodiscard]] std::vector<ObjectId> within(const BoostBox& box) const {
    std::vector<ObjectId> ids;
    for (auto it = tree.qbegin(bgi::intersects(box)); it != tree.qend(); ++it) {
      ids.push_back(ObjectId{it->second});
    }
    std::sort(ids.begin(), ids.end());
    return ids;
  }
};

ObjectMap::ObjectMap() : index_(std::make_unique<Index>()) {}
ObjectMap::ObjectMap(const ObjectMap& other)
    : objects_(other.objects_),
      next_id_(other.next_id_),
      index_(std::make_unique<Index>(*other.index_)) {}
ObjectMap& ObjectMap::operator=(const ObjectMap& other) {
  if (this != &other) *this = ObjectMap(other);
  return *this;
}
ObjectMap::ObjectMap(ObjectMap&& other) noexcept : ObjectMap() {
  *this = std::move(other);
}
ObjectMap& ObjectMap::operator=(ObjectMap&& other) noexcept {
  std::swap(objects_, other.objects_);
  std::swap(next_id_, other.next_id_);
  std::swap(index_, other.index_);
  return *this;
}
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
  for (Object& object : objects) {
    map.index_->tree.insert(entry_of(object));
    map.objects_.push_back(std::make_shared<const Object>(std::move(object)));
  }
  map.next_id_ = next_id;
  return map;
}

std::size_t ObjectMap::position_of(ObjectId id) const {
  const auto it = std::lower_bound(
      objects_.begin(), objects_.end(), id, [](const ObjectRange::Held& held, ObjectId key) {
        return held->id < key;
      });
  return static_cast<std::size_t>(it - objects_.begin());
}

ObjectId ObjectMap::add(Object object) {
  assert(is_sound(object.box));
  object.id = next_id_;
  ++next_id_.value;
  index_->tree.insert(entry_of(object));
  objects_.push_back(std::make_shared<const Object>(std::move(object)));
  return objects_.back()->id;
}

void ObjectMap::replace(Object object) {
  const std::size_t position = position_of(object.id);
  put(position, std::make_shared<const Object>(std::move(object)));
}

void ObjectMap::modify(ObjectId id, const std::function<void(Object&)>& change) {
  const std::size_t position = position_of(id);
  assert(position < objects_.size());
  const auto changed = std::make_shared<Object>(*objects_[position]);
  change(*changed);
  put(position, changed);
}

void ObjectMap::put(std::size_t position, ObjectRange::Held object) {
  assert(position < objects_.size() && objects_[position]->id == object->id);
  assert(is_sound(object->box));
  if (!(object->box == objects_[position]->box)) {
    index_->tree.remove(entry_of(*objects_[position]));
    index_->tree.insert(entry_of(*object));
  }
  objects_[position] = std::move(object);
}

bool ObjectMap::erase(ObjectId id) {
  const std::size_t position = position_of(id);
  if (position == objects_.size() || objects_[position]->id != id) return false;
  index_->tree.remove(entry_of(*objects_[position]));
  objects_.erase(objects_.begin() + static_cast<std::ptrdiff_t>(position));
  return true;
}

const Object* ObjectMap::find(ObjectId id) const {
  const std::size_t position = position_of(id);
  const bool found = position < objects_.size() && objects_[position]->id == id;
  return found ? objects_[position].get() : nullptr;
}

const Object& ObjectMap::at(ObjectId id) const {
  const Object* object = find(id);
  assert(object != nullptr);
  return *object;
}

std::vector<ObjectId> ObjectMap::query(const Box& box) const {
  return index_->within(to_boost(box));
}

std::vector<ObjectId> ObjectMap::query(const Rect& area) const {
  constexpr double kAnyHeight = std::numeric_limits<double>::max();
  return index_->within(
      {{area.min.x(), area.min.y(), -kAnyHeight}, {area.max.x(), area.max.y(), kAnyHeight}});
}

std::optional<ObjectId> ObjectMap::nearest(const PointInMap& point,
                                           const std::function<bool(const Object&)>& accept) const {
  const BoostPoint from = to_boost(point.xyz);
  const auto accepted = [&](const Entry& entry) { return accept(at(ObjectId{entry.second})); };
  std::optional<ObjectId> best;
  double best_distance = std::numeric_limits<double>::infinity();
  const auto num = static_cast<unsigned>(std::max<std::size_t>(1, objects_.size()));
  const auto query = bgi::nearest(from, num) && bgi::satisfies(accepted);
  for (auto it = index_->tree.qbegin(query); it != index_->tree.qend(); ++it) {
    const double distance = bg::comparable_distance(from, it->first);
    if (distance > best_distance) break;
    best_distance = distance;
    if (!best || it->second < best->value) best = ObjectId{it->second};
  }
  return best;
}

std::optional<ObjectId> ObjectMap::nearest(const PointInMap& point,
                                           std::optional<ClassId> class_id) const {
  return nearest(point, [&](const Object& object) {
    if (!class_id) return true;
    const auto best = object.belief.best();
    return best && best->id == *class_id;
  });
}

}  // namespace hypermap
