// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/simulator/simulator.hpp"

#include "pose_drift.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string_view>
#include <utility>

namespace hypermap {
namespace {

/// Moments that divide the camera's way evenly, the first and last included.
std::vector<double> moments(const CameraPath& path, int num_frames) {
  std::vector<double> times;
  times.reserve(static_cast<std::size_t>(num_frames));
  for (int i = 0; i < num_frames; ++i)
    times.push_back(num_frames == 1 ? 0.0 : path.duration_s() * i / (num_frames - 1));
  return times;
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
    if (id != kNoObject && depth_m.pixels()[i] > 0.0F) ++counts[id.value - 1];
  }
  return counts;
}

}  // namespace

struct Simulator::Impl {
  SimulationOptions options;
  FurnishedScene scene;
  std::vector<std::string_view> class_names;  ///< Of the objects, by id - 1; views into `scene`.
  std::vector<double> times_s;
  std::vector<MapFromCamera> true_poses;
  std::vector<MapFromCamera> recorded_poses;
  ClassRegistry classes;
  SceneRenderer renderer;
  SimulatedDetector detector;

  /// Visible objects with how much of them is unhidden; small ones are left out beforehand.
  [[nodiscard]] std::vector<VisibleObject> seen_in(const RenderedView& view,
                                                   const MapFromCamera& pose) const {
    std::vector<VisibleObject> seen = visible_objects(view.instances, class_names);
    std::erase_if(seen, [this](const VisibleObject& object) {
      return object.visible_px < options.detector.min_visible_px;
    });
    std::vector<ObjectId> ids;
    ids.reserve(seen.size());
    for (const VisibleObject& object : seen) ids.push_back(object.id);
    const auto shares = renderer.unhidden_shares(view, ids, options.camera, pose);
    for (std::size_t i = 0; i < seen.size(); ++i) seen[i].unhidden_share = shares[i];
    return seen;
  }
};

Simulator::Simulator(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Simulator::Simulator(Simulator&&) noexcept = default;
Simulator& Simulator::operator=(Simulator&&) noexcept = default;
Simulator::~Simulator() = default;

Result<Simulator> Simulator::create(const Scene& scene, const SimulationOptions& options) {
  HYPERMAP_TRY(validate(options));
  HYPERMAP_ASSIGN_OR_RETURN(FurnishedScene furnished, furnish(scene, options.seed));
  HYPERMAP_ASSIGN_OR_RETURN(const CameraPath path, CameraPath::create(scene.waypoints, scene.path));
  HYPERMAP_ASSIGN_OR_RETURN(SceneRenderer renderer, SceneRenderer::create(furnished));
  ClassRegistry classes;
  HYPERMAP_ASSIGN_OR_RETURN(SimulatedDetector detector,
                            SimulatedDetector::create(options.detector, classes, options.seed));
  const std::vector<double> times_s = moments(path, options.num_frames);
  std::vector<MapFromCamera> true_poses;
  true_poses.reserve(times_s.size());
  for (const double time_s : times_s) true_poses.push_back(path.pose_at(time_s));
  std::vector<MapFromCamera> recorded = drifted(true_poses, options.pose_noise, options.seed);
  auto impl = std::make_unique<Impl>(Impl{options,
                                          std::move(furnished),
                                          {},
                                          times_s,
                                          std::move(true_poses),
                                          std::move(recorded),
                                          std::move(classes),
                                          std::move(renderer),
                                          std::move(detector)});
  for (const PlacedObject& object : impl->scene.objects)
    impl->class_names.push_back(object.class_name);
  return Simulator(std::move(impl));
}

std::size_t Simulator::size() const noexcept {
  return impl_->times_s.size();
}
std::span<const PlacedObject> Simulator::objects() const noexcept {
  return impl_->scene.objects;
}
const FurnishedScene& Simulator::furnished() const noexcept {
  return impl_->scene;
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
  const MapFromCamera& pose = impl_->true_poses[index];
  RenderedView view = impl_->renderer.render(options.camera, pose);
  SimulatedFrame result;
  result.true_pose = pose;
  result.visible = impl_->seen_in(view, pose);
  RgbdFrame& frame = result.frame;
  frame.index = index;
  frame.name = frame_name(index);
  frame.stamp = Stamp{std::llround(1e6 * impl_->times_s[index]) * 1000};
  frame.camera = options.camera;
  frame.map_from_camera = impl_->recorded_poses[index];
  frame.depth_m =
      measured_depth(view.depth_m, view.incidence_cos, options.sensor, options.seed, index);
  frame.color = std::move(view.color);
  frame.detections = impl_->detector.detect(result.visible, view.instances, index);
  result.named_rightly = impl_->detector.named_rightly(result.visible, view.instances, index);
  result.depth_pixels =
      count_depth_pixels(frame.depth_m, view.instances, impl_->scene.objects.size());
  result.instances = std::move(view.instances);
  return result;
}

}  // namespace hypermap
