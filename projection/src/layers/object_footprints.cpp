// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/layers/object_footprints.hpp"

#include "footprints/carved_footprint.hpp"
#include "footprints/column_evidence.hpp"

#include <cstddef>
#include <optional>
#include <utility>

namespace hypermap {
namespace {

Result<Polygon> box_footprint(const Box& box) {
  const Eigen::Vector2d min = box.min_in_map.head<2>();
  const Eigen::Vector2d max = box.max_in_map.head<2>();
  return make_polygon({min, {max.x(), min.y()}, max, {min.x(), max.y()}});
}

/// A shape, and whether the box stands in for it.
struct Shape {
  Polygon outline;
  bool is_box = false;
};

/// The columns that carve the shape of each object; none when shapes are not carved.
std::vector<ObjectColumns> carving_columns(std::span<const Object* const> objects,
                                           const FootprintOptions& options) {
  if (options.policy != ShapePolicy::kVoxels || !options.carving) return {};
  return columns_of(objects, options.carving->leaves, options.carving->leaf_edge_m);
}

/// `columns` may be null: the shape is not carved.
std::optional<Shape> shape_of(const Object& object,
                              ShapePolicy policy,
                              const ObjectColumns* columns) {
  auto shape =
      columns == nullptr ? footprint(object, policy) : carved_footprint(object.points, *columns);
  if (shape) return Shape{*std::move(shape), false};
  if (auto box = box_footprint(object.box)) return Shape{*std::move(box), true};
  return std::nullopt;
}

}  // namespace

Result<FootprintLayer> project_footprints(std::span<const Object* const> objects,
                                          const ClassRegistry& classes,
                                          const FootprintOptions& options) {
  FootprintLayer out;
  const std::vector<ObjectColumns> columns = carving_columns(objects, options);
  std::vector<SemanticObject> entries;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const Object* object = objects[i];
    const auto named = best_class(*object);
    auto shape = named ? shape_of(*object, options.policy, columns.empty() ? nullptr : &columns[i])
                       : std::nullopt;
    if (!shape) {
      out.left_out.push_back(object->id);
      continue;
    }
    if (!classes.contains(named->id)) {
      return fail(ErrorCode::kInvalidArgument,
                  "class " + std::to_string(named->id.value) + " is not in the registry",
                  "class");
    }
    if (shape->is_box) out.from_box.push_back(object->id);
    const std::string& name = classes.name(named->id);
    entries.push_back({.id = object->id.value,
                       .name = name,
                       .parts = {std::move(shape->outline)},
                       .tags = {name},
                       .confidence = {object_confidence(*object, options.confidence).value()}});
  }
  HYPERMAP_ASSIGN_OR_RETURN(out.layer, SemanticLayer::create(std::move(entries)));
  return out;
}

}  // namespace hypermap
