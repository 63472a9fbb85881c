// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/simulator/simulator.hpp"

#include "pose_drift.hpp"
#include "scene/moving_bodies.hpp"
#include "scene/scene_changes.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string_view>
#include <utility>

namespace hypermap {
namespace {

constexpr double kPauseBetweenPassesS = 10.0;

/// A frame of the walk, made or not.
struct Moment {
  std::size_t number = 0;  ///< In the whole walk.
  double time_s = 0.0;
  MapFromCamera true_pose;
  MapFromCamera recorded_pose;
  bool is_last_pass = true;
};

/// Moments that divide the camera's way evenly, the first and last included, in each pass.
std::vector<Moment> whole_walk(const CameraPath& path, const SimulationOptions& options) {
  std::vector<Moment> walk;
  walk.reserve(static_cast<std::size_t>(options.num_frames) *
               static_cast<std::size_t>(options.num_passes));
  for (int pass = 0; pass < options.num_passes; ++pass) {
    const double start_s = pass * (path.duration_s() + kPauseBetweenPassesS);
    for (int i = 0; i < options.num_frames; ++i) {
      const double time_s =
          options.num_frames == 1 ? 0.0 : path.duration_s() * i / (options.num_frames - 1);
      const MapFromCamera pose = path.pose_at(time_s);
      walk.push_back({walk.size(), start_s + time_s, pose, pose, pass + 1 == options.num_passes});
    }
  }
  return walk;
}

void add_pose_noise(std::vector<Moment>& walk, const SimulationOptions& options) {
  std::vector<MapFromCamera> true_poses;
  true_poses.reserve(walk.size());
  for (const Moment& moment : walk) true_poses.push_back(moment.true_pose);
  const auto recorded = drifted(true_poses, options.pose_noise, options.seed);
  for (std::size_t i = 0; i < walk.size(); ++i)
    walk[i].recorded_pose = with_white_noise(
        recorded[i], options.pose_noise_m, options.pose_noise_rad, options.seed, i);
}

/// Every n-th frame of each pass.
std::vector<Moment> stepped(const std::vector<Moment>& walk, const SimulationOptions& options) {
  std::vector<Moment> made;
  for (const Moment& moment : walk) {
    const std::size_t in_pass = moment.number % static_cast<std::size_t>(options.num_frames);
    if (in_pass % static_cast<std::size_t>(options.frame_step) == 0) made.push_back(moment);
  }
  return made;
}

/// The scene's way as the options have it.
Result<CameraPath> camera_path(const Scene& scene, const SimulationOptions& options) {
  std::vector<CameraWaypoint> waypoints = scene.waypoints;
  if (options.lens_height_m > 0.0) {
    for (CameraWaypoint& waypoint : waypoints) waypoint.position_in_map.z() = options.lens_height_m;
  }
  CameraPath::Options path = scene.path;
  path.speed_m_per_s *= options.speed;
  path.turn_rate_rad_per_s *= options.speed;
  return CameraPath::create(waypoints, path);
}

std::string frame_name(std::size_t index) {
  std::string digits = std::to_string(index);
  return std::string(digits.size() < 6 ? 6 - digits.size() : 0, '0') + digits;
}

std::vector<int> count_depth_pixels(const DepthImage& depth_m,
                                    const InstanceImage& instances,
                                    std::size_t num_objects) {
  std::vector<int> counts(num_objects, 0);
  for (std::size_t i = 0; i < depth_m.size(); ++i) {
    const ObjectId id = instances.pixels()[i];
    if (id == kNoObject || id.value > num_objects) continue;
    if (depth_m.pixels()[i] > 0.0F) ++counts[id.value - 1];
  }
  return counts;
}

}  // namespace

struct Simulator::Impl {
  SimulationOptions options;
  PinholeCamera camera;
  FurnishedScene scene;  ///< At the end.
  std::vector<SceneChange> changes;
  /// Of all that frames show, by id - 1; views into `scene`, `changes` and `body_classes`.
  std::vector<std::string_view> class_names;
  std::vector<std::string> body_classes;
  std::vector<Moment> moments;
  ClassRegistry classes;
  MovingBodies bodies;
  std::vector<SceneRenderer> renderers;  ///< Of the first passes, when things change; of the last.
  SimulatedDetector detector;

  [[nodiscard]] const SceneRenderer& renderer_at(const Moment& moment) const {
    return moment.is_last_pass ? renderers.back() : renderers.front();
  }

  void name_classes() {
    for (const PlacedObject& object : scene.objects) class_names.push_back(object.class_name);
    for (const SceneChange& change : changes) {
      if (change.kind != SceneChange::Kind::kAdded) class_names.push_back(change.object.class_name);
    }
    for (const std::string& name : body_classes) class_names.push_back(name);
  }

  /// Visible objects with how much of them is unhidden; small ones are left out beforehand.
  [[nodiscard]] std::vector<VisibleObject> seen_in(
      const RenderedView& view,
      const Moment& moment,
      std::span<const Eigen::Isometry3d> map_from_bodies) const {
    std::vector<VisibleObject> seen = visible_objects(view.instances, class_names);
    std::erase_if(seen, [this](const VisibleObject& object) {
      return object.visible_px < options.detector.min_visible_px;
    });
    std::vector<ObjectId> ids;
    ids.reserve(seen.size());
    for (const VisibleObject& object : seen) ids.push_back(object.id);
    const auto shares =
        renderer_at(moment).unhidden_shares(view, ids, camera, moment.true_pose, map_from_bodies);
    for (std::size_t i = 0; i < seen.size(); ++i) seen[i].unhidden_share = shares[i];
    return seen;
  }
};

PinholeCamera image_camera(const SimulationOptions& options) {
  PinholeCamera camera = options.camera;
  if (options.width_px > 0 && options.width_px != camera.width_px) {
    const double scale = static_cast<double>(options.width_px) / camera.width_px;
    camera.width_px = options.width_px;
    camera.fx_px *= scale;
    camera.cx_px = (camera.cx_px + 0.5) * scale - 0.5;
  }
  if (options.height_px > 0 && options.height_px != camera.height_px) {
    const double scale = static_cast<double>(options.height_px) / camera.height_px;
    camera.height_px = options.height_px;
    camera.fy_px *= scale;
    camera.cy_px = (camera.cy_px + 0.5) * scale - 0.5;
  }
  return camera;
}

Simulator::Simulator(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Simulator::Simulator(Simulator&&) noexcept = default;
Simulator& Simulator::operator=(Simulator&&) noexcept = default;
Simulator::~Simulator() = default;

Result<Simulator> Simulator::create(const Scene& scene, const SimulationOptions& options) {
  HYPERMAP_TRY(validate(options));
  HYPERMAP_ASSIGN_OR_RETURN(FurnishedScene furnished, furnish(scene, options.seed));
  HYPERMAP_ASSIGN_OR_RETURN(const CameraPath path, camera_path(scene, options));
  ClassRegistry classes;
  HYPERMAP_ASSIGN_OR_RETURN(SimulatedDetector detector,
                            SimulatedDetector::create(options.detector, classes, options.seed));
  std::vector<Moment> walk = whole_walk(path, options);
  std::vector<Eigen::Vector3d> way;
  way.reserve(walk.size());
  for (const Moment& moment : walk) way.push_back(moment.true_pose.origin().xyz);
  HYPERMAP_ASSIGN_OR_RETURN(
      ChangedScene changed,
      change_scene(scene,
                   std::move(furnished),
                   way,
                   options.changes,
                   options.seed,
                   [&](std::string_view name) { return detector.knows_class(name); }));
  HYPERMAP_ASSIGN_OR_RETURN(MovingBodies bodies, MovingBodies::create(scene.moving, options.seed));
  std::vector<SceneRenderer> renderers;
  if (!changed.changes.empty()) {
    HYPERMAP_ASSIGN_OR_RETURN(SceneRenderer first,
                              SceneRenderer::create(changed.first_passes, bodies.meshes()));
    renderers.push_back(std::move(first));
  }
  HYPERMAP_ASSIGN_OR_RETURN(SceneRenderer last,
                            SceneRenderer::create(changed.last_pass, bodies.meshes()));
  renderers.push_back(std::move(last));
  add_pose_noise(walk, options);
  std::vector<std::string> body_classes;
  body_classes.reserve(scene.moving.size());
  for (const MovingBody& body : scene.moving) body_classes.push_back(body.class_name);
  auto impl = std::make_unique<Impl>(Impl{options,
                                          image_camera(options),
                                          std::move(changed.at_end),
                                          std::move(changed.changes),
                                          {},
                                          std::move(body_classes),
                                          stepped(walk, options),
                                          std::move(classes),
                                          std::move(bodies),
                                          std::move(renderers),
                                          std::move(detector)});
  impl->name_classes();
  return Simulator(std::move(impl));
}

std::size_t Simulator::size() const noexcept {
  return impl_->moments.size();
}
std::span<const PlacedObject> Simulator::objects() const noexcept {
  return impl_->scene.objects;
}
const FurnishedScene& Simulator::furnished() const noexcept {
  return impl_->scene;
}
std::span<const SceneChange> Simulator::changes() const noexcept {
  return impl_->changes;
}
const ClassRegistry& Simulator::classes() const noexcept {
  return impl_->classes;
}
const SimulatedDetector& Simulator::detector() const noexcept {
  return impl_->detector;
}

SimulatedFrame Simulator::render(std::size_t index) const {
  assert(index < size());
  const SimulationOptions& options = impl_->options;
  const Moment& moment = impl_->moments[index];
  const auto map_from_bodies = impl_->bodies.poses_at(moment.time_s);
  RenderedView view =
      impl_->renderer_at(moment).render(impl_->camera, moment.true_pose, map_from_bodies);
  SimulatedFrame result;
  result.true_pose = moment.true_pose;
  result.visible = impl_->seen_in(view, moment, map_from_bodies);
  RgbdFrame& frame = result.frame;
  frame.index = index;
  frame.name = frame_name(moment.number);
  frame.stamp = Stamp{std::llround(1e6 * moment.time_s) * 1000};
  frame.camera = impl_->camera;
  frame.map_from_camera = moment.recorded_pose;
  frame.depth_m =
      measured_depth(view.depth_m, view.incidence_cos, options.sensor, options.seed, moment.number);
  frame.color = std::move(view.color);
  SimulatedDetections said = impl_->detector.detect(result.visible, view.instances, moment.number);
  frame.detections = std::move(said.detections);
  result.named_rightly = std::move(said.named_rightly);
  result.depth_pixels =
      count_depth_pixels(frame.depth_m, view.instances, impl_->scene.objects.size());
  result.instances = std::move(view.instances);
  return result;
}

}  // namespace hypermap
