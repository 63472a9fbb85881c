// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/viewer_offscreen/snapshot/map_scene.hpp"

#include "hypermap/viewer_offscreen/snapshot/layer_scene.hpp"

#include <cstdint>
#include <set>
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

SnapshotScene only_named(SnapshotScene scene, const NameSelection& names) {
  std::set<ClassId> ids;
  for (std::uint32_t i = 0; i < scene.classes.size(); ++i) {
    if (names.contains(scene.classes.name(ClassId{i}))) ids.insert(ClassId{i});
  }
  std::erase_if(scene.objects, [&](const SnapshotObject& object) {
    return !object.class_id || !ids.contains(*object.class_id);
  });
  std::erase_if(scene.semantic,
                [&](const SemanticObject& shape) { return !names.contains(shape.name); });
  if (!scene.leaves) return scene;
  scene.leaves = [leaves = std::move(scene.leaves),
                  ids = std::move(ids)](const LeafVisitor& visit) {
    leaves([&](const LeafSample& leaf) {
      LeafSample shown = leaf;
      if (shown.best_class && !ids.contains(*shown.best_class)) shown.best_class.reset();
      visit(shown);
    });
  };
  return scene;
}

}  // namespace hypermap
