// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A furnished room as data, and the same room with its objects in place.
#pragma once

#include "hypermap/core/base/ids.hpp"
#include "hypermap/core/base/image.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/box.hpp"
#include "hypermap/core/geometry/polygon.hpp"
#include "hypermap/io/simulator/camera_path.hpp"
#include "hypermap/io/simulator/triangle_mesh.hpp"

#include <Eigen/Core>

#include <cstdint>
#include <string>
#include <vector>

namespace hypermap {

/// One object in a scene.
struct SceneObject {
  std::string name = {};        ///< Unique in the scene.
  std::string class_name = {};  ///< What a person calls it.
  std::string shape = {};       ///< One of `furniture_shapes()`.
  std::string on = {};          ///< Name of the object that it stands on; empty: the floor.
  /// Name of the object in whose frame it stands, at the height where that object stands; empty:
  /// none. Not together with `on`.
  std::string beside = {};
  /// Centre of its ground plan in the map, or, when it stands on or beside something, in that
  /// object's frame (origin at its middle). Unit: metre.
  Eigen::Vector2d position_m = Eigen::Vector2d::Zero();
  double height_m = 0.0;  ///< Above the floor, or above the top of what it stands on.
  double yaw_rad = 0.0;   ///< Where its front looks, in the same frame as its position.
  Eigen::Vector3d size_m = Eigen::Vector3d::Zero();  ///< Zero: the shape's usual size.
  std::vector<Rgb8> colors = {};                     ///< Empty: the shape's usual colours.
  /// Stands free, so that each seed puts it a little elsewhere.
  bool movable = true;
};

/// Somebody or something that goes to and fro along a line all the time. Frames show it; it is in
/// no truth.
struct MovingBody {
  std::string name = {};
  std::string class_name = {};
  std::string shape = {};                            ///< One of `furniture_shapes()`.
  std::vector<Eigen::Vector2d> way_in_map = {};      ///< Two points or more, apart.
  double speed_m_per_s = 1.0;                        ///< Range: > 0
  Eigen::Vector3d size_m = Eigen::Vector3d::Zero();  ///< Zero: the shape's usual size.
  std::vector<Rgb8> colors = {};                     ///< Empty: the shape's usual colours.
};

/// A part of the building that is no object: a door, a window, a ledge. A cuboid.
struct SceneFixture {
  Box box;
  SurfaceMaterial material;
};

/// A room, what is in it and how the camera goes through it. Read by `load_scene`.
struct Scene {
  std::string name = {};
  Polygon floor;  ///< Inner walls stand on its edges; holes are blocks around which one can walk.
  double wall_height_m = 2.7;
  SurfaceMaterial floor_material{{170, 150, 125}, SurfacePattern::kTiles};
  SurfaceMaterial wall_material{{222, 220, 212}, SurfacePattern::kPlain};
  SurfaceMaterial ceiling_material{{240, 240, 238}, SurfacePattern::kPlain};
  std::vector<Eigen::Vector3d> lights_in_map;  ///< Point lights; none: one under the ceiling.
  std::vector<SceneFixture> fixtures;
  std::vector<SceneObject> objects;
  std::vector<MovingBody> moving;
  std::vector<CameraWaypoint> waypoints;
  CameraPath::Options path;
  /// How much a seed moves free-standing objects on the floor; two fifths of it what stands on
  /// others.
  double position_jitter_m = 0.05;
  double yaw_jitter_rad = 0.1745329251994329577;  ///< 10 degrees
};

/// An object in its place.
struct PlacedObject {
  ObjectId id = kNoObject;  ///< 1, 2, ... in the scene's order.
  std::string name = {};
  std::string class_name = {};
  TriangleMesh mesh = {};  ///< In the map.
  Eigen::Isometry3d map_from_object = Eigen::Isometry3d::Identity();
  Box box = {};
  Polygon footprint = {};  ///< True outline seen from above, in the map.
  /// Centroid of the footprint's area, half way up the box.
  Eigen::Vector3d centroid_in_map = Eigen::Vector3d::Zero();
};

struct FurnishedScene {
  std::vector<PlacedObject> objects;
  TriangleMesh room;  ///< Floor, walls, ceiling, fixtures. In the map.
  std::vector<Eigen::Vector3d> lights_in_map;
};

/// Puts everything in its place. `seed` moves and turns the free-standing objects a little (uniform
/// within the scene's jitter); objects on others go with them. Seed 0 moves nothing.
///
/// What stands beside another goes with it, as what stands on it does.
/// Errors: kNotFound for a shape or a supporting object that does not exist (or comes later in the
/// list); kInvalidArgument for what `build_furniture` and `footprint` refuse. `entry` names the
/// object.
[[nodiscard]] Result<FurnishedScene> furnish(const Scene& scene, std::uint64_t seed);

}  // namespace hypermap
