// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/layers/object_footprints.hpp"

#include <optional>
#include <utility>

namespace hypermap {
namespace {

Result<Polygon> box_footprint(const Box& box) {
  const Eigen::Vector2d min = box.min_in_map.head<2>();
  const Eigen::Vector2d max = box.max_in_map.head<2>();
  return make_polygon({min, {max.x(), min.y()}, max, {min.x(), max.y()}});
}

/// The shape by policy, else the box; `second` says whether the box stands in.
std::optional<std::pair<Polygon, bool>> shape_of(const Object& object, ShapePolicy policy) {
  if (auto shape = footprint(object, policy)) return {{*std::move(shape), false}};
  if (auto shape = box_footprint(object.box)) return {{*std::move(shape), true}};
  return std::nullopt;
}

}  // namespace

Result<FootprintLayer> project_footprints(std::span<const Object* const> objects,
                                          const ClassRegistry& classes,
                                          const FootprintOptions& options) {
  FootprintLayer out;
  std::vector<SemanticObject> entries;
  for (const Object* object : objects) {
    const auto named = best_class(*object);
    auto shape = named ? shape_of(*object, options.policy) : std::nullopt;
    if (!shape) {
      out.left_out.push_back(object->id);
      continue;
    }
    if (!classes.contains(named->id)) {
      return fail(ErrorCode::kInvalidArgument,
                  "class " + std::to_string(named->id.value) + " is not in the registry",
                  "class");
    }
    if (shape->second) out.from_box.push_back(object->id);
    const std::string& name = classes.name(named->id);
    entries.push_back({.id = object->id.value,
                       .name = name,
                       .parts = {std::move(shape->first)},
                       .tags = {name},
                       .confidence = {object_confidence(*object, options.confidence).value()}});
  }
  HYPERMAP_ASSIGN_OR_RETURN(out.layer, SemanticLayer::create(std::move(entries)));
  return out;
}

}  // namespace hypermap
