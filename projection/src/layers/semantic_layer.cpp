// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/layers/semantic_layer.hpp"

#include "hypermap/core/base/utf8.hpp"
#include "semantic_layer_impl.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace hypermap {
namespace {

using Ids = std::vector<std::uint64_t>;

Result<void> validate_name(const SemanticObject& object) {
  const std::string& name = object.name;
  if (name.empty()) return refused_object(object, "must not be empty", "name");
  if (name.size() > SemanticLayer::kMaxNameBytes) {
    return refused_object(object,
                          "has " + std::to_string(name.size()) + " bytes, the limit is " +
                              std::to_string(SemanticLayer::kMaxNameBytes),
                          "name");
  }
  if (first_bad_utf8(name) < name.size()) return refused_object(object, "is no UTF-8", "name");
  return {};
}

}  // namespace

Unexpected refused_object(const SemanticObject& object,
                          std::string what,
                          std::string field,
                          ErrorCode code) {
  Error error{.code = code, .what = std::move(what), .field = std::move(field)};
  error.entry = "object " + std::to_string(object.id) + " (" + printable(object.name, 40) + ")";
  return Unexpected(std::move(error));
}

Unexpected too_many_objects() {
  return fail(ErrorCode::kLimit,
              "more than " + std::to_string(SemanticLayer::kMaxObjects) + " objects",
              "objects");
}

Result<void> validate_object(const SemanticObject& object) {
  HYPERMAP_TRY(validate_name(object));
  if (object.parts.empty()) return refused_object(object, "has no polygon", "shape");
  for (const double confidence : object.confidence) {
    if (!(confidence >= 0.0 && confidence <= 1.0)) {
      return refused_object(
          object, "must be from 0 to 1, is " + std::to_string(confidence), "confidence");
    }
  }
  const std::size_t count = object.confidence.size();
  if (count > 1 && count != object.tags.size()) {
    return refused_object(object,
                          std::to_string(count) + " values for " +
                              std::to_string(object.tags.size()) + " tags, expected one for each",
                          "confidence");
  }
  return {};
}

std::optional<double> confidence_of(const SemanticObject& object) {
  const auto best = std::max_element(object.confidence.begin(), object.confidence.end());
  return best == object.confidence.end() ? std::nullopt : std::optional<double>(*best);
}

Eigen::Vector2d position_of(const SemanticObject& object) {
  if (object.parts.size() == 1) return centroid(object.parts.front());
  Eigen::Vector2d moment = Eigen::Vector2d::Zero();
  double area = 0.0;
  for (const Polygon& part : object.parts) {
    moment += area_m2(part) * centroid(part);
    area += area_m2(part);
  }
  return moment / area;
}

Rect bounds_of(const SemanticObject& object) {
  Rect rect = bounds(object.parts.front());
  for (const Polygon& part : object.parts) {
    const Rect other = bounds(part);
    rect.min = rect.min.cwiseMin(other.min);
    rect.max = rect.max.cwiseMax(other.max);
  }
  return rect;
}

SemanticLayer::SemanticLayer() : impl_(std::make_unique<Impl>()) {}
SemanticLayer::SemanticLayer(const SemanticLayer& other)
    : MapLayer(other), impl_(std::make_unique<Impl>(*other.impl_)) {}
SemanticLayer::SemanticLayer(SemanticLayer&& other) noexcept = default;
SemanticLayer& SemanticLayer::operator=(const SemanticLayer& other) {
  if (this != &other) impl_ = std::make_unique<Impl>(*other.impl_);
  return *this;
}
SemanticLayer& SemanticLayer::operator=(SemanticLayer&& other) noexcept = default;
SemanticLayer::~SemanticLayer() = default;

Result<SemanticLayer> SemanticLayer::create(std::vector<SemanticObject> objects) {
  if (objects.size() > kMaxObjects) return too_many_objects();
  for (const SemanticObject& object : objects) HYPERMAP_TRY(validate_object(object));
  std::sort(
      objects.begin(), objects.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
  const auto duplicate = std::adjacent_find(
      objects.begin(), objects.end(), [](const auto& a, const auto& b) { return a.id == b.id; });
  if (duplicate != objects.end())
    return refused_object(*duplicate, "is borne by two objects", "id");
  SemanticLayer layer;
  for (const SemanticObject& object : objects)
    layer.impl_->names.emplace(canonical_class_name(object.name), object.id);
  layer.impl_->index = BoundsIndex(objects);
  layer.impl_->objects = std::move(objects);
  return layer;
}

Result<void> SemanticLayer::add(SemanticObject object) {
  HYPERMAP_TRY(validate_object(object));
  if (find(object.id) != nullptr) return refused_object(object, "is borne by another object", "id");
  if (impl_->objects.size() >= kMaxObjects) return too_many_objects();
  auto& objects = impl_->objects;
  if (objects.size() == objects.capacity()) objects.reserve(2 * objects.size() + 1);
  impl_->announce(object, [&] { impl_->index.insert(objects, object); });
  objects.insert(impl_->place(object.id), std::move(object));
  return {};
}

Result<void> SemanticLayer::replace(SemanticObject object) {
  const SemanticObject* const old = find(object.id);
  if (old == nullptr) {
    return fail(ErrorCode::kNotFound, "no object has the id " + std::to_string(object.id), "id");
  }
  HYPERMAP_TRY(validate_object(object));
  const auto old_name = impl_->name_of(*old);
  const auto name =
      impl_->announce(object, [&] { impl_->index.replace(impl_->objects, *old, object); });
  if (name != old_name) impl_->names.erase(old_name);
  *impl_->place(object.id) = std::move(object);
  return {};
}

bool SemanticLayer::erase(std::uint64_t id) {
  const SemanticObject* object = find(id);
  if (object == nullptr) return false;
  impl_->names.erase(impl_->name_of(*object));
  impl_->index.remove(impl_->objects, *object);
  impl_->objects.erase(impl_->place(id));
  return true;
}

std::uint64_t SemanticLayer::next_id() const {
  return impl_->objects.empty() ? 0 : impl_->objects.back().id + 1;
}

std::span<const SemanticObject> SemanticLayer::objects() const {
  return impl_->objects;
}

const SemanticObject* SemanticLayer::find(std::uint64_t id) const {
  return impl_->find(id);
}

std::vector<std::uint64_t> SemanticLayer::at(const Eigen::Vector2d& point) const {
  if (!point.allFinite()) return {};
  return impl_->select({point, point}, [&](const Polygon& part) { return contains(part, point); });
}

std::vector<std::uint64_t> SemanticLayer::in(const Polygon& area) const {
  return impl_->select(bounds(area), [&](const Polygon& part) { return intersects(part, area); });
}

std::vector<std::uint64_t> SemanticLayer::named(std::string_view name) const {
  std::vector<std::uint64_t> ids = of_class(name);
  std::erase_if(ids, [&](std::uint64_t id) { return find(id)->name != name; });
  return ids;
}

std::vector<std::uint64_t> SemanticLayer::of_class(std::string_view name) const {
  const std::string canonical = canonical_class_name(name);
  Ids ids;
  for (auto it = impl_->names.lower_bound({canonical, 0});
       it != impl_->names.end() && it->first == canonical;
       ++it) {
    ids.push_back(it->second);
  }
  return ids;
}

bool operator==(const SemanticLayer& a, const SemanticLayer& b) {
  return a.impl_->objects == b.impl_->objects;
}

}  // namespace hypermap
