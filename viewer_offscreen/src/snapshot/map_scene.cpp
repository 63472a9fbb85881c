// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/viewer_offscreen/snapshot/map_scene.hpp"

#include "hypermap/viewer_offscreen/snapshot/layer_scene.hpp"

#include <string>
#include <utility>

namespace hypermap {
namespace {

SnapshotObject drawn(const Object& object, const ClassRegistry& classes) {
  const auto best = best_class(object);
  const std::string id = " " + std::to_string(object.id.value);
  if (!best) return {.box = object.box, .label = "unknown" + id};
  return {.box = object.box, .class_id = best->id, .label = classes.name(best->id) + id};
}

}  // namespace

SnapshotScene map_scene(const Hypermap& hypermap,
                        const ClassRegistry& classes,
                        std::span<const Object* const> objects,
                        LeafSource leaves,
                        std::string frame_id) {
  SnapshotScene scene{
      .frame_id = std::move(frame_id), .leaves = std::move(leaves), .classes = classes};
  for (const Layer& layer : hypermap.layers()) {
    scene = with_layer(std::move(scene), layer, hypermap.frames());
  }
  for (const Object* object : objects) scene.objects.push_back(drawn(*object, classes));
  return scene;
}

}  // namespace hypermap
