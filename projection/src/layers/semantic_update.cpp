// SPDX-License-Identifier: BSD-3-Clause
// Updates of a semantic layer: planned aside, where all that can fail happens, then carried out.
#include "hypermap/projection/layers/semantic_update.hpp"

#include "semantic_layer_impl.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

/// Archives keep ids as signed numbers of 64 bits.
constexpr std::uint64_t kMaxUpdatedId = std::numeric_limits<std::int64_t>::max();

/// An update in terms of the layer that it changes. Objects and ids ascending.
struct UpdatePlan {
  SemanticUpdateReport report;
  std::vector<SemanticObject> added;
  std::vector<SemanticObject> modified;
  std::vector<std::uint64_t> deleted;
  std::vector<ObjectBounds> gone;
  std::vector<ObjectBounds> come;
  std::vector<ObjectNames::const_iterator> old_names;
  ObjectNames new_names;
};

/// A caller's polygon may be anything; those that were read are valid.
Result<void> validate_shape(const SemanticObject& object) {
  for (const Polygon& part : object.parts) {
    const auto valid = make_polygon(part.outer, part.holes);
    if (!valid) return refused_object(object, valid.error().what, "shape", valid.error().code);
  }
  return {};
}

Unexpected unknown_object(std::uint64_t id) {
  Error error{.code = ErrorCode::kNotFound, .what = "is not in the layer", .field = "id"};
  error.entry = "object " + std::to_string(id);
  return Unexpected(std::move(error));
}

/// Whether each id stands once in the update. Errors: kInvalidArgument naming the first that does
/// not.
Result<void> check_ids(const SemanticUpdate& update) {
  std::vector<std::uint64_t> ids = update.to_delete;
  for (const SemanticObject& object : update.to_add) ids.push_back(object.id);
  for (const SemanticModification& change : update.to_modify) ids.push_back(change.id);
  std::sort(ids.begin(), ids.end());
  const auto repeated = std::adjacent_find(ids.begin(), ids.end());
  if (repeated == ids.end()) return {};
  Error error{.code = ErrorCode::kInvalidArgument,
              .what = "stands more than once in the update",
              .field = "id"};
  error.entry = "object " + std::to_string(*repeated);
  return Unexpected(std::move(error));
}

/// The plan of an update, made step by step; the layer stays as it is.
class UpdatePlanner {
 public:
  UpdatePlanner(const SemanticLayer& layer, const ObjectNames& names)
      : layer_(layer), names_(names) {}

  Result<UpdatePlan> plan(const SemanticUpdate& update) {
    HYPERMAP_TRY(check_ids(update));
    for (const SemanticObject& object : update.to_add) HYPERMAP_TRY(add(object));
    HYPERMAP_TRY(number(update.to_number, update.least_new_id));
    for (const SemanticModification& change : update.to_modify) HYPERMAP_TRY(modify(change));
    for (const std::uint64_t id : update.to_delete) HYPERMAP_TRY(remove(id));
    const std::size_t num_objects = layer_.objects().size() + plan_.added.size();
    if (num_objects > SemanticLayer::kMaxObjects + plan_.deleted.size()) return too_many_objects();
    const auto by_id = [](const SemanticObject& a, const SemanticObject& b) { return a.id < b.id; };
    std::sort(plan_.added.begin(), plan_.added.end(), by_id);
    std::sort(plan_.deleted.begin(), plan_.deleted.end());
    return std::move(plan_);
  }

 private:
  Result<void> add(SemanticObject object) {
    HYPERMAP_TRY(validate_object(object));
    HYPERMAP_TRY(validate_shape(object));
    if (object.id > kMaxUpdatedId) return refused_object(object, "is above 2^63 - 1", "id");
    if (layer_.find(object.id) != nullptr)
      return refused_object(object, "is borne by an object of the layer", "id");
    comes(object);
    plan_.report.added.push_back(object.id);
    plan_.added.push_back(std::move(object));
    return {};
  }

  Result<void> number(const std::vector<SemanticObject>& objects, std::uint64_t least_id) {
    std::uint64_t next = std::max(layer_.next_id(), least_id);
    for (const SemanticObject& object : plan_.added) next = std::max(next, object.id + 1);
    for (SemanticObject object : objects) {
      object.id = next++;
      HYPERMAP_TRY(add(std::move(object)));
    }
    return {};
  }

  Result<void> modify(const SemanticModification& change) {
    const SemanticObject* old = layer_.find(change.id);
    if (old == nullptr) return unknown_object(change.id);
    SemanticObject object = modified(*old, change);
    HYPERMAP_TRY(validate_object(object));
    if (change.parts) HYPERMAP_TRY(validate_shape(object));
    goes(*old);
    comes(object);
    ++plan_.report.num_modified;
    plan_.modified.push_back(std::move(object));
    return {};
  }

  Result<void> remove(std::uint64_t id) {
    const SemanticObject* old = layer_.find(id);
    if (old == nullptr) return unknown_object(id);
    goes(*old);
    ++plan_.report.num_deleted;
    plan_.deleted.push_back(id);
    return {};
  }

  void goes(const SemanticObject& object) {
    plan_.gone.push_back({bounds_of(object), object.id});
    plan_.old_names.push_back(names_.find({canonical_class_name(object.name), object.id}));
  }
  void comes(const SemanticObject& object) {
    plan_.come.push_back({bounds_of(object), object.id});
    plan_.new_names.emplace(canonical_class_name(object.name), object.id);
  }

  const SemanticLayer& layer_;
  const ObjectNames& names_;
  UpdatePlan plan_;
};

void erase_all(std::vector<SemanticObject>& objects, const std::vector<std::uint64_t>& ids) {
  if (ids.empty()) return;
  const auto is_deleted = [&](const SemanticObject& object) {
    return std::binary_search(ids.begin(), ids.end(), object.id);
  };
  const auto first = std::lower_bound(objects.begin(), objects.end(), ids.front(), has_lower_id);
  objects.erase(std::remove_if(first, objects.end(), is_deleted), objects.end());
}

/// Requires: room for both.
void insert_all(std::vector<SemanticObject>& objects, std::vector<SemanticObject> added) {
  if (added.empty()) return;
  const auto num_old = static_cast<std::ptrdiff_t>(objects.size());
  const std::uint64_t first_id = added.front().id;
  std::move(added.begin(), added.end(), std::back_inserter(objects));
  const auto middle = objects.begin() + num_old;
  std::inplace_merge(std::lower_bound(objects.begin(), middle, first_id, has_lower_id),
                     middle,
                     objects.end(),
                     [](const auto& a, const auto& b) { return a.id < b.id; });
}

ValueTree with_keys_of(ValueTree extra, const ValueTree& more) {
  if (extra.kind == ValueKind::kNull) return more;
  for (const ValueTree::Entry& entry : more.entries) {
    const auto old = std::find_if(extra.entries.begin(),
                                  extra.entries.end(),
                                  [&](const auto& known) { return known.first == entry.first; });
    if (old == extra.entries.end()) {
      extra.entries.push_back(entry);
    } else {
      old->second = entry.second;
    }
  }
  return extra;
}

}  // namespace

SemanticObject modified(SemanticObject object, const SemanticModification& modification) {
  if (modification.name) object.name = *modification.name;
  if (modification.parts) {
    object.parts = *modification.parts;
    object.shape_text = modification.shape_text;
  }
  if (modification.tags) object.tags = *modification.tags;
  if (modification.confidence) object.confidence = *modification.confidence;
  object.extra = with_keys_of(std::move(object.extra), modification.extra);
  return object;
}

Result<SemanticUpdateReport> SemanticLayer::apply(const SemanticUpdate& update) {
  HYPERMAP_ASSIGN_OR_RETURN(UpdatePlan plan, UpdatePlanner(*this, impl_->names).plan(update));
  auto& objects = impl_->objects;
  const std::size_t num_wanted = objects.size() + plan.added.size();
  if (num_wanted > objects.capacity()) objects.reserve(std::max(num_wanted, 2 * objects.size()));
  // Nothing fails from here on.
  for (const auto& name : plan.old_names) impl_->names.erase(name);
  impl_->names.merge(plan.new_names);
  for (SemanticObject& object : plan.modified) *impl_->place(object.id) = std::move(object);
  erase_all(objects, plan.deleted);
  insert_all(objects, std::move(plan.added));
  impl_->index.change_many(objects, plan.gone, plan.come);
  return std::move(plan.report);
}

}  // namespace hypermap
