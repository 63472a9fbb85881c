// SPDX-License-Identifier: BSD-3-Clause
#include "transformed_parts.hpp"

#include "hypermap/core/base/value_tree.hpp"
#include "hypermap/io/codec/bounded_yaml.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

double turned_by(double angle_rad, double yaw_rad) {
  return yaw_rad == 0.0 ? angle_rad : std::remainder(angle_rad + yaw_rad, kTurn);
}

GridGeometry moved_geometry(GridGeometry geometry, const UprightMotion& motion) {
  geometry.origin = motion.in_plane() * geometry.origin;
  geometry.yaw_rad = turned_by(geometry.yaw_rad, motion.yaw_rad);
  return geometry;
}

Ring moved_ring(const Ring& ring, const Eigen::Isometry2d& motion) {
  Ring moved;
  moved.reserve(ring.size());
  for (const Eigen::Vector2d& point : ring) moved.push_back(motion * point);
  return moved;
}

/// Keys of a shape, of which `box` (six numbers: two corners) lies in the map.
ValueTree with_moved_box(ValueTree extra, const UprightMotion& motion) {
  const auto key = std::ranges::find(extra.entries, "box", &ValueTree::Entry::first);
  if (key == extra.entries.end()) return extra;
  const SourceName unnamed;
  const auto old = YamlNode(key->second, "box", unnamed).as_doubles(6);
  if (!old) return extra;  // somebody else's key
  const Box moved = transformed(
      Box{{old->at(0), old->at(1), old->at(2)}, {old->at(3), old->at(4), old->at(5)}}, motion);
  std::vector<ValueTree> numbers;
  for (const Eigen::Vector3d& corner : {moved.min_in_map, moved.max_in_map}) {
    for (const double coordinate : corner) numbers.push_back(make_number(coordinate));
  }
  key->second = make_list(std::move(numbers));
  return extra;
}

}  // namespace

Box transformed(const Box& box, const UprightMotion& motion) {
  if (motion.yaw_rad == 0.0) {
    return {box.min_in_map + motion.shift_m, box.max_in_map + motion.shift_m};
  }
  const Eigen::Isometry3d in_space = motion.in_space();
  const auto corners = box.corners();
  Box moved{in_space * corners.front(), in_space * corners.front()};
  for (const Eigen::Vector3d& corner : corners) {
    moved.min_in_map = moved.min_in_map.cwiseMin(in_space * corner);
    moved.max_in_map = moved.max_in_map.cwiseMax(in_space * corner);
  }
  return moved;
}

Eigen::Isometry3d UprightMotion::in_space() const {
  return Eigen::Translation3d(shift_m) * Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ());
}

Eigen::Isometry2d UprightMotion::in_plane() const {
  return Eigen::Translation2d(shift_m.head<2>()) * Eigen::Rotation2Dd(yaw_rad);
}

Result<Polygon> transformed(const Polygon& polygon, const UprightMotion& motion) {
  std::vector<Ring> holes;
  for (const Ring& hole : polygon.holes) holes.push_back(moved_ring(hole, motion.in_plane()));
  return make_polygon(moved_ring(polygon.outer, motion.in_plane()), std::move(holes));
}

Result<OccupancyGrid> transformed(const OccupancyGrid& grid, const UprightMotion& motion) {
  if (grid.cells().empty()) return grid;
  return OccupancyGrid::create(moved_geometry(grid.geometry(), motion),
                               {grid.cells().begin(), grid.cells().end()});
}

Result<GridStackLayer> transformed(const GridStackLayer& layer, const UprightMotion& motion) {
  if (!layer.stack()) return layer;
  const GridGeometry geometry = moved_geometry(layer.stack()->geometry(), motion);
  GridStack::Layers layers;
  for (const auto& [name, grid] : layer.stack()->layers()) {
    HYPERMAP_ASSIGN_OR_RETURN(
        LogOddsGrid moved,
        LogOddsGrid::create(geometry, {grid.cells().begin(), grid.cells().end()}));
    layers.emplace(name, std::move(moved));
  }
  HYPERMAP_ASSIGN_OR_RETURN(
      GridStack stack, GridStack::create(geometry, layer.stack()->options(), std::move(layers)));
  return GridStackLayer(std::move(stack));
}

Result<SupercellLayer> transformed(const SupercellLayer& layer, const UprightMotion& motion) {
  if (layer.supercells().labels.empty()) return layer;
  Supercells supercells = layer.supercells();
  supercells.geometry = moved_geometry(supercells.geometry, motion);
  TopometricGraph graph = layer.graph();
  for (SupercellNode& node : graph.nodes) node.centroid = motion.in_plane() * node.centroid;
  return SupercellLayer::create(std::move(supercells), std::move(graph));
}

Result<SemanticLayer> transformed(const SemanticLayer& layer, const UprightMotion& motion) {
  std::vector<SemanticObject> objects(layer.objects().begin(), layer.objects().end());
  for (SemanticObject& object : objects) {
    for (Polygon& part : object.parts) {
      auto moved = transformed(part, motion);
      if (!moved) {
        return fail(moved.error().code, moved.error().what, "object " + std::to_string(object.id));
      }
      part = std::move(*moved);
    }
    object.shape_text.clear();
    object.extra = with_moved_box(std::move(object.extra), motion);
  }
  return SemanticLayer::create(std::move(objects));
}

Result<TopologicalMap> transformed(const TopologicalMap& map, const UprightMotion& motion) {
  const Eigen::Isometry3d space = motion.in_space();
  std::vector<TopologicalVertex> vertices = map.vertices();
  for (TopologicalVertex& vertex : vertices) {
    vertex.position_in_map = space * vertex.position_in_map;
  }
  auto walk = map.walk();
  if (walk) walk->position_in_map = space * walk->position_in_map;
  return TopologicalMap::create(map.options(), vertices, map.edges(), walk);
}

}  // namespace hypermap
