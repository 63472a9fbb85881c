// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/simulator/scene_file.hpp"

#include "hypermap/core/base/nearest_name.hpp"
#include "hypermap/io/codec/bounded_yaml.hpp"
#include "scene_yaml.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numbers>
#include <system_error>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180.0;
constexpr std::size_t kMaxWaypoints = 10'000;

Result<void> read_materials(const YamlNode& building, Scene& scene) {
  const auto node = building.find("materials");
  if (!node) return {};
  constexpr std::array<std::string_view, 3> kKeys{"floor", "walls", "ceiling"};
  HYPERMAP_TRY(require_map(*node, kKeys));
  const std::array<SurfaceMaterial*, 3> targets{
      &scene.floor_material, &scene.wall_material, &scene.ceiling_material};
  for (std::size_t i = 0; i < kKeys.size(); ++i) {
    const auto item = node->find(kKeys[i]);
    if (!item) continue;
    constexpr std::array<std::string_view, 2> kSurfaceKeys{"color", "pattern"};
    HYPERMAP_TRY(require_map(*item, kSurfaceKeys));
    HYPERMAP_ASSIGN_OR_RETURN(*targets[i], read_surface(*item, *targets[i]));
  }
  return {};
}

Result<void> read_building(const YamlNode& node, Scene& scene) {
  constexpr std::array<std::string_view, 4> kKeys{"height", "floor", "blocks", "materials"};
  HYPERMAP_TRY(require_map(node, kKeys));
  HYPERMAP_ASSIGN_OR_RETURN(scene.wall_height_m, read_number(node, "height", 2.7, 0.5, 100.0));
  HYPERMAP_ASSIGN_OR_RETURN(const YamlNode floor, node.at("floor"));
  HYPERMAP_ASSIGN_OR_RETURN(Ring outer, read_ring(floor));
  std::vector<Ring> holes;
  HYPERMAP_ASSIGN_OR_RETURN(const std::vector<YamlNode> blocks,
                            read_list(node, "blocks", kMaxSceneObjects));
  for (const YamlNode& block : blocks) {
    HYPERMAP_ASSIGN_OR_RETURN(Ring hole, read_ring(block));
    holes.push_back(std::move(hole));
  }
  auto polygon = make_polygon(std::move(outer), std::move(holes));
  if (!polygon) return refuse(floor, polygon.error().what);
  scene.floor = *std::move(polygon);
  return read_materials(node, scene);
}

Result<SceneFixture> read_fixture(const YamlNode& node) {
  constexpr std::array<std::string_view, 4> kKeys{"from", "to", "color", "pattern"};
  HYPERMAP_TRY(require_map(node, kKeys));
  HYPERMAP_ASSIGN_OR_RETURN(const YamlNode from, node.at("from"));
  HYPERMAP_ASSIGN_OR_RETURN(const YamlNode to, node.at("to"));
  SceneFixture fixture;
  HYPERMAP_ASSIGN_OR_RETURN(fixture.box.min_in_map, read_vector<3>(from));
  HYPERMAP_ASSIGN_OR_RETURN(fixture.box.max_in_map, read_vector<3>(to));
  if (!(fixture.box.extent().minCoeff() > 0.0))
    return refuse(node, "each coordinate of `to` must be greater than that of `from`");
  HYPERMAP_ASSIGN_OR_RETURN(fixture.material, read_surface(node, {}));
  return fixture;
}

/// Name, class and looks, of objects and of what moves.
template <class Described>
Result<Described> read_named(const YamlNode& node) {
  Described described;
  HYPERMAP_ASSIGN_OR_RETURN(described.name, read_text(node, "name"));
  HYPERMAP_ASSIGN_OR_RETURN(described.class_name, read_text(node, "class"));
  HYPERMAP_ASSIGN_OR_RETURN(described.shape, read_text(node, "shape"));
  if (const auto size = node.find("size")) {
    HYPERMAP_ASSIGN_OR_RETURN(described.size_m, read_vector<3>(*size));
  }
  HYPERMAP_ASSIGN_OR_RETURN(const std::vector<YamlNode> colors, read_list(node, "colors", 2));
  for (const YamlNode& item : colors) {
    HYPERMAP_ASSIGN_OR_RETURN(const Rgb8 color, read_color(item));
    described.colors.push_back(color);
  }
  return described;
}

Result<MovingBody> read_moving(const YamlNode& node) {
  constexpr std::array<std::string_view, 7> kKeys{
      "name", "class", "shape", "size", "colors", "speed", "way"};
  HYPERMAP_TRY(require_map(node, kKeys));
  HYPERMAP_ASSIGN_OR_RETURN(MovingBody body, read_named<MovingBody>(node));
  HYPERMAP_ASSIGN_OR_RETURN(body.speed_m_per_s, read_number(node, "speed", 1.0, 0.001, 100.0));
  HYPERMAP_ASSIGN_OR_RETURN(const std::vector<YamlNode> way, read_list(node, "way", kMaxWaypoints));
  for (const YamlNode& item : way) {
    HYPERMAP_ASSIGN_OR_RETURN(const Eigen::Vector2d point, read_vector<2>(item));
    if (!body.way_in_map.empty() && (point - body.way_in_map.back()).norm() < 0.01)
      return refuse(item, "must lie 1 cm or more from the point before it");
    body.way_in_map.push_back(point);
  }
  if (body.way_in_map.size() < 2) return refuse(node, "`way` must have 2 points or more");
  return body;
}

Result<SceneObject> read_object(const YamlNode& node) {
  constexpr std::array<std::string_view, 11> kKeys{
      "name", "class", "shape", "on", "beside", "at", "height", "yaw", "size", "colors", "fixed"};
  HYPERMAP_TRY(require_map(node, kKeys));
  HYPERMAP_ASSIGN_OR_RETURN(SceneObject object, read_named<SceneObject>(node));
  if (node.find("on")) {
    HYPERMAP_ASSIGN_OR_RETURN(object.on, read_text(node, "on"));
  }
  if (const auto beside = node.find("beside")) {
    if (!object.on.empty()) return refuse(*beside, "must not be given together with `on`");
    HYPERMAP_ASSIGN_OR_RETURN(object.beside, read_text(node, "beside"));
  }
  HYPERMAP_ASSIGN_OR_RETURN(const YamlNode at, node.at("at"));
  HYPERMAP_ASSIGN_OR_RETURN(object.position_m, read_vector<2>(at));
  HYPERMAP_ASSIGN_OR_RETURN(object.height_m, read_number(node, "height", 0.0, -100.0, 100.0));
  HYPERMAP_ASSIGN_OR_RETURN(const double yaw_deg, read_number(node, "yaw", 0.0, -3600.0, 3600.0));
  object.yaw_rad = kRadPerDeg * yaw_deg;
  if (const auto fixed = node.find("fixed")) {
    HYPERMAP_ASSIGN_OR_RETURN(const bool is_fixed, fixed->as_bool());
    object.movable = !is_fixed;
  }
  return object;
}

Result<CameraWaypoint> read_waypoint(const YamlNode& node, double usual_height_m) {
  constexpr std::array<std::string_view, 3> kKeys{"at", "look_at", "height"};
  HYPERMAP_TRY(require_map(node, kKeys));
  HYPERMAP_ASSIGN_OR_RETURN(const YamlNode at, node.at("at"));
  HYPERMAP_ASSIGN_OR_RETURN(const YamlNode target, node.at("look_at"));
  HYPERMAP_ASSIGN_OR_RETURN(const Eigen::Vector2d position, read_vector<2>(at));
  CameraWaypoint waypoint;
  HYPERMAP_ASSIGN_OR_RETURN(waypoint.look_at_in_map, read_vector<3>(target));
  HYPERMAP_ASSIGN_OR_RETURN(const double height,
                            read_number(node, "height", usual_height_m, 0.05, 100.0));
  waypoint.position_in_map << position, height;
  return waypoint;
}

Result<void> read_camera(const YamlNode& node, Scene& scene) {
  constexpr std::array<std::string_view, 4> kKeys{"height", "speed", "turn_rate", "path"};
  HYPERMAP_TRY(require_map(node, kKeys));
  HYPERMAP_ASSIGN_OR_RETURN(const double height_m, read_number(node, "height", 1.2, 0.05, 100.0));
  HYPERMAP_ASSIGN_OR_RETURN(scene.path.speed_m_per_s,
                            read_number(node, "speed", 0.3, 0.001, 100.0));
  HYPERMAP_ASSIGN_OR_RETURN(const double turn_deg,
                            read_number(node, "turn_rate", 25.0, 0.1, 3600.0));
  scene.path.turn_rate_rad_per_s = kRadPerDeg * turn_deg;
  HYPERMAP_ASSIGN_OR_RETURN(const std::vector<YamlNode> path,
                            read_list(node, "path", kMaxWaypoints));
  for (const YamlNode& item : path) {
    HYPERMAP_ASSIGN_OR_RETURN(const CameraWaypoint waypoint, read_waypoint(item, height_m));
    scene.waypoints.push_back(waypoint);
  }
  const auto valid = CameraPath::create(scene.waypoints, scene.path);
  if (!valid) return refuse(node, valid.error().what);
  return {};
}

Result<void> read_lights_and_jitter(const YamlNode& root, Scene& scene) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::vector<YamlNode> lights, read_list(root, "lights", 100));
  for (const YamlNode& item : lights) {
    HYPERMAP_ASSIGN_OR_RETURN(const Eigen::Vector3d light, read_vector<3>(item));
    scene.lights_in_map.push_back(light);
  }
  const auto jitter = root.find("jitter");
  if (!jitter) return {};
  constexpr std::array<std::string_view, 2> kKeys{"position", "yaw"};
  HYPERMAP_TRY(require_map(*jitter, kKeys));
  HYPERMAP_ASSIGN_OR_RETURN(scene.position_jitter_m,
                            read_number(*jitter, "position", scene.position_jitter_m, 0.0, 10.0));
  HYPERMAP_ASSIGN_OR_RETURN(const double yaw_deg, read_number(*jitter, "yaw", 10.0, 0.0, 180.0));
  scene.yaw_jitter_rad = kRadPerDeg * yaw_deg;
  return {};
}

Result<Scene> read_scene(const YamlNode& root) {
  constexpr std::array<std::string_view, 8> kKeys{
      "name", "building", "lights", "jitter", "fixtures", "objects", "moving", "camera"};
  HYPERMAP_TRY(require_map(root, kKeys));
  Scene scene;
  HYPERMAP_ASSIGN_OR_RETURN(scene.name, read_text(root, "name"));
  HYPERMAP_ASSIGN_OR_RETURN(const YamlNode building, root.at("building"));
  HYPERMAP_TRY(read_building(building, scene));
  HYPERMAP_TRY(read_lights_and_jitter(root, scene));
  HYPERMAP_ASSIGN_OR_RETURN(const auto fixtures, read_list(root, "fixtures", kMaxSceneObjects));
  for (const YamlNode& item : fixtures) {
    HYPERMAP_ASSIGN_OR_RETURN(const SceneFixture fixture, read_fixture(item));
    scene.fixtures.push_back(fixture);
  }
  HYPERMAP_ASSIGN_OR_RETURN(const auto objects, read_list(root, "objects", kMaxSceneObjects));
  for (const YamlNode& item : objects) {
    HYPERMAP_ASSIGN_OR_RETURN(SceneObject object, read_object(item));
    scene.objects.push_back(std::move(object));
  }
  HYPERMAP_ASSIGN_OR_RETURN(const auto moving, read_list(root, "moving", kMaxSceneObjects));
  for (const YamlNode& item : moving) {
    HYPERMAP_ASSIGN_OR_RETURN(MovingBody body, read_moving(item));
    scene.moving.push_back(std::move(body));
  }
  HYPERMAP_ASSIGN_OR_RETURN(const YamlNode camera, root.at("camera"));
  HYPERMAP_TRY(read_camera(camera, scene));
  return scene;
}

}  // namespace

Result<Scene> load_scene(const std::filesystem::path& path) {
  HYPERMAP_ASSIGN_OR_RETURN(const YamlDocument document, read_yaml(path));
  return read_scene(document.root());
}

Result<Scene> parse_scene(std::string_view yaml, const std::string& name) {
  HYPERMAP_ASSIGN_OR_RETURN(const YamlDocument document, parse_yaml(yaml, SourceName{name}));
  return read_scene(document.root());
}

Result<std::filesystem::path> find_scene(const std::string& name_or_path,
                                         const std::filesystem::path& data_dir) {
  std::error_code ignored;
  const std::filesystem::path given(name_or_path);
  if (std::filesystem::is_regular_file(given, ignored)) return given;
  const std::filesystem::path scenes = data_dir / "scenes";
  const std::filesystem::path shipped = scenes / (name_or_path + ".yaml");
  if (!given.has_parent_path() && std::filesystem::is_regular_file(shipped, ignored))
    return shipped;
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(scenes, ignored)) {
    if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem().string());
  }
  std::ranges::sort(names);
  return tl::make_unexpected(
      Error{ErrorCode::kNotFound,
            "no such file, and " + nothing_named("shipped scene", name_or_path, names),
            name_or_path});
}

}  // namespace hypermap
