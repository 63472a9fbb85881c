// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/viewer_offscreen/snapshot/layer_scene.hpp"

#include <utility>
#include <variant>

namespace hypermap {
namespace {

/// Puts each primitive to those of its kind.
class SceneFiller {
 public:
  explicit SceneFiller(SnapshotScene& scene)
      : scene_(scene), takes_areas_(scene.semantic.empty()) {}

  void operator()(DrawnArea&& area) {
    if (!takes_areas_) return;
    scene_.semantic.push_back({.id = scene_.semantic.size(),
                               .name = std::move(area.class_name),
                               .parts = std::move(area.parts)});
  }
  void operator()(DrawnOccupancy&& occupancy) {
    if (!scene_.occupancy) scene_.occupancy = std::move(occupancy.grid);
  }
  void operator()(DrawnVoxels&& voxels) {
    if (!scene_.leaves) scene_.leaves = std::move(voxels.leaves);
  }
  void operator()(DrawnBox&& box) {
    const auto class_id = scene_.classes.find(box.class_name);
    scene_.objects.push_back(
        {.box = box.box, .class_id = class_id, .label = std::move(box.class_name)});
  }
  void operator()(DrawnCells&& cells) { scene_.overlay.cells.push_back(std::move(cells)); }
  void operator()(DrawnLine&& line) { scene_.overlay.lines.push_back(std::move(line)); }
  void operator()(DrawnText&& text) { scene_.overlay.texts.push_back(std::move(text)); }

 private:
  SnapshotScene& scene_;
  bool takes_areas_;
};

}  // namespace

SnapshotScene with_layer(SnapshotScene scene, const Layer& layer) {
  scene.frame_id = layer.info.frame_id;
  SceneFiller filler(scene);
  for (LayerPrimitive& primitive : layer.content->draw()) std::visit(filler, std::move(primitive));
  return scene;
}

}  // namespace hypermap
