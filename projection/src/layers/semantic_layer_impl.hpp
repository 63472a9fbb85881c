// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What a semantic layer is made of: its objects, and where they are found by place and by name.
#pragma once

#include "bounds_index.hpp"
#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/projection/layers/semantic_layer.hpp"

#include <algorithm>
#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace hypermap {

/// Whether a layer may hold the object. Errors: those of SemanticLayer::add but for its id.
[[nodiscard]] Result<void> validate_object(const SemanticObject& object);
/// An error that names the object.
[[nodiscard]] Unexpected refused_object(const SemanticObject& object,
                                        std::string what,
                                        std::string field,
                                        ErrorCode code = ErrorCode::kInvalidArgument);
[[nodiscard]] Unexpected too_many_objects();

inline bool has_lower_id(const SemanticObject& object, std::uint64_t id) {
  return object.id < id;
}

/// Canonical names of objects, with their ids.
using ObjectNames = std::set<std::pair<std::string, std::uint64_t>>;

struct SemanticLayer::Impl {
  std::vector<SemanticObject> objects;  // ascending ids
  BoundsIndex index;
  ObjectNames names;

  auto place(std::uint64_t id) {
    return std::lower_bound(objects.begin(), objects.end(), id, has_lower_id);
  }
  [[nodiscard]] const SemanticObject* find(std::uint64_t id) const {
    const auto found = std::lower_bound(objects.begin(), objects.end(), id, has_lower_id);
    return found != objects.end() && found->id == id ? &*found : nullptr;
  }
  /// Under which name the object is found. Requires: it is there.
  [[nodiscard]] auto name_of(const SemanticObject& object) const {
    return names.find({canonical_class_name(object.name), object.id});
  }
  /// Names the object, then changes the index; neither when memory ends. Tells the name's place.
  template <class Change>
  auto announce(const SemanticObject& object, const Change& change) {
    const auto [name, is_new] = names.emplace(canonical_class_name(object.name), object.id);
    try {
      change();
    } catch (...) {
      if (is_new) names.erase(name);
      throw;
    }
    return name;
  }
  /// Ids of those whose bounds meet the box and whose shape passes the exact test.
  template <class ExactTest>
  [[nodiscard]] std::vector<std::uint64_t> select(const Rect& rect, const ExactTest& meets) const {
    std::vector<std::uint64_t> ids = index.find(objects, rect);
    std::erase_if(ids, [&](std::uint64_t id) {
      const SemanticObject& object = *find(id);
      return std::none_of(object.parts.begin(), object.parts.end(), meets);
    });
    std::sort(ids.begin(), ids.end());
    return ids;
  }
};

}  // namespace hypermap
