// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/viewer_offscreen/snapshot/map_scene.hpp"

#include <utility>
#include <variant>

namespace hypermap {
namespace {

SnapshotObject drawn(const Object& object, const ClassRegistry& classes) {
  const auto best = best_class(object);
  if (!best) return {.box = object.box, .label = "unknown"};
  return {.box = object.box, .class_id = best->id, .label = classes.name(best->id)};
}

void add_layer(SnapshotScene& scene, const Layer& layer) {
  scene.frame_id = layer.info.frame_id;
  if (const auto* grid = std::get_if<OccupancyLayer>(&layer.content)) {
    if (!scene.occupancy) scene.occupancy = grid->grid;
  } else if (const auto* semantic = std::get_if<SemanticLayer>(&layer.content)) {
    const auto objects = semantic->objects();
    if (scene.semantic.empty()) scene.semantic.assign(objects.begin(), objects.end());
  }
}

}  // namespace

SnapshotScene map_scene(const Hypermap& hypermap,
                        const ClassRegistry& classes,
                        std::span<const Object* const> objects,
                        LeafSource leaves) {
  SnapshotScene scene{.leaves = std::move(leaves), .classes = classes};
  for (const Layer& layer : hypermap.layers()) add_layer(scene, layer);
  for (const Object* object : objects) scene.objects.push_back(drawn(*object, classes));
  return scene;
}

}  // namespace hypermap
