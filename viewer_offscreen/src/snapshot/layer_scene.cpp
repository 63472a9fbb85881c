// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/viewer_offscreen/snapshot/layer_scene.hpp"

#include "hypermap/core/geometry/polygon_motion.hpp"

#include <Eigen/Geometry>

#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace hypermap {
namespace {

GridGeometry moved(GridGeometry geometry, const Eigen::Isometry2d& to_from) {
  geometry.origin = to_from * geometry.origin;
  geometry.yaw_rad += Eigen::Rotation2Dd(to_from.linear()).angle();
  return geometry;
}

Eigen::Vector3d moved(const Eigen::Vector3d& point, const Eigen::Isometry2d& to_from) {
  const Eigen::Vector2d in_plane = to_from * point.head<2>();
  return {in_plane.x(), in_plane.y(), point.z()};
}

/// The box around the moved corners.
Box moved(const Box& box, const Eigen::Isometry2d& to_from) {
  const Eigen::Vector3d half = 0.5 * box.extent();
  const Eigen::Vector2d turned = to_from.linear().cwiseAbs() * half.head<2>();
  const Eigen::Vector3d reach(turned.x(), turned.y(), half.z());
  const Eigen::Vector3d centre = moved(box.centre(), to_from);
  return {centre - reach, centre + reach};
}

LeafSource moved(LeafSource leaves, const Eigen::Isometry2d& to_from) {
  return [leaves = std::move(leaves), to_from](const LeafVisitor& visit) {
    leaves([&](const LeafSample& leaf) {
      LeafSample there = leaf;
      there.centre_in_map = moved(leaf.centre_in_map, to_from);
      visit(there);
    });
  };
}

/// Puts each primitive to those of its kind, in the scene's frame.
class SceneFiller {
 public:
  SceneFiller(SnapshotScene& scene, const Eigen::Isometry2d& scene_from_layer)
      : scene_(scene),
        scene_from_layer_(scene_from_layer),
        stays_(scene_from_layer.isApprox(Eigen::Isometry2d::Identity(), 0.0)),
        takes_areas_(scene.semantic.empty()) {}

  void operator()(DrawnArea&& area) {
    if (!takes_areas_) return;
    for (Polygon& part : area.parts) part = in_scene(std::move(part));
    scene_.semantic.push_back(
        {.id = area.id, .name = std::move(area.class_name), .parts = std::move(area.parts)});
  }
  void operator()(DrawnOccupancy&& occupancy) {
    if (scene_.occupancy) return;
    if (stays_) {
      scene_.occupancy = std::move(occupancy.grid);
      return;
    }
    const auto cells = occupancy.grid.cells();
    auto grid = OccupancyGrid::create(in_scene(occupancy.grid.geometry()),
                                      std::vector<std::int8_t>(cells.begin(), cells.end()));
    if (grid) {
      scene_.occupancy = std::move(*grid);
    } else {
      scene_.left_out.push_back(to_string(grid.error()));
    }
  }
  void operator()(DrawnVoxels&& voxels) {
    if (!scene_.leaves) scene_.leaves = in_scene(std::move(voxels.leaves));
  }
  void operator()(DrawnBox&& box) {
    const auto class_id = scene_.classes.find(box.class_name);
    scene_.objects.push_back({.box = in_scene(box.box),
                              .class_id = class_id,
                              .label = box.class_name + " " + std::to_string(box.id)});
  }
  void operator()(DrawnCells&& cells) {
    cells.geometry = in_scene(cells.geometry);
    scene_.overlay.cells.push_back(std::move(cells));
  }
  void operator()(DrawnLine&& line) {
    for (Eigen::Vector2d& point : line.points) point = scene_from_layer_ * point;
    scene_.overlay.lines.push_back(std::move(line));
  }
  void operator()(DrawnText&& text) {
    text.position = scene_from_layer_ * text.position;
    scene_.overlay.texts.push_back(std::move(text));
  }

 private:
  template <class Shape>
  [[nodiscard]] Shape in_scene(Shape shape) const {
    return stays_ ? shape : moved(std::move(shape), scene_from_layer_);
  }

  SnapshotScene& scene_;
  Eigen::Isometry2d scene_from_layer_;
  bool stays_;  // what is not moved keeps every bit
  bool takes_areas_;
};

}  // namespace

SnapshotScene with_layer(SnapshotScene scene, const Layer& layer, const FrameTree& frames) {
  const auto scene_from_layer = frames.to_from(scene.frame_id, layer.info.frame_id);
  if (!scene_from_layer) {
    scene.left_out.push_back("layer " + printable(layer.info.name) + ": " +
                             scene_from_layer.error().what);
    return scene;
  }
  SceneFiller filler(scene, *scene_from_layer);
  for (LayerPrimitive& primitive : layer.content->draw()) std::visit(filler, std::move(primitive));
  return scene;
}

}  // namespace hypermap
