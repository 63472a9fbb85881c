// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Drives a camera through a furnished scene and gives what a real robot would have recorded,
/// together with the truth.
#pragma once

#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/core/base/job_progress.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/camera.hpp"
#include "hypermap/core/segmentation/rgbd_frame.hpp"
#include "hypermap/io/simulator/scene.hpp"
#include "hypermap/io/simulator/scene_renderer.hpp"
#include "hypermap/io/simulator/sensor_noise.hpp"
#include "hypermap/io/simulator/simulated_detector.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace hypermap {

struct OptionTable;

struct SimulationOptions {
  int num_frames = 200;    ///< Spread evenly over the scene's camera path. Range: 1 .. 100,000
  std::uint64_t seed = 1;  ///< Of noise, detector and arrangement.
  /// Drift of the recorded poses: 1 walks randomly by 1 cm and 0.1 degrees in the first metre,
  /// growing with the root of the way; 0: exact. Range: 0 .. 100
  double pose_noise = 0.0;
  PinholeCamera camera{640, 480, 525.0, 525.0, 319.5, 239.5};
  SensorNoiseOptions sensor = {};
  SimulatedDetectorOptions detector = {};
  /// 0: as many as there are cores. The result does not depend on it. Range: 0 .. 256
  int num_threads = 0;
};

/// Errors: kInvalidArgument naming the field.
[[nodiscard]] Result<void> validate(const SimulationOptions& options);
[[nodiscard]] const OptionTable& option_table(const SimulationOptions& options);

/// One moment of the simulation.
struct SimulatedFrame {
  RgbdFrame frame;                     ///< As a dataset reader would give it: noise, recorded pose.
  MapFromCamera true_pose;             ///< Where the camera really was.
  InstanceImage instances;             ///< What each pixel really shows.
  std::vector<VisibleObject> visible;  ///< Objects with enough pixels, in id order.
  std::vector<int> depth_pixels;       ///< Measured pixels of each object, by id - 1.
  std::vector<ObjectId> named_rightly;  ///< Objects whose detection names their class.
};

/// A scene that can be photographed at any moment of the camera's way.
class Simulator {
 public:
  /// Errors: of `validate`, `furnish`, `CameraPath::create`, `SceneRenderer::create`.
  [[nodiscard]] static Result<Simulator> create(const Scene& scene,
                                                const SimulationOptions& options);
  Simulator(Simulator&&) noexcept;
  Simulator& operator=(Simulator&&) noexcept;
  ~Simulator();

  [[nodiscard]] std::size_t size() const noexcept;
  /// Requires: index < size(). Safe to call concurrently; frames do not depend on each other.
  [[nodiscard]] SimulatedFrame render(std::size_t index) const;
  /// The objects in their places, in id order.
  [[nodiscard]] std::span<const PlacedObject> objects() const noexcept;
  /// The room, for whoever derives truth from it.
  [[nodiscard]] const FurnishedScene& furnished() const noexcept;
  /// Classes that the detector names; detections of `render` refer to it.
  [[nodiscard]] const ClassRegistry& classes() const noexcept;
  [[nodiscard]] const SimulatedDetector& detector() const noexcept;

 private:
  struct Impl;
  explicit Simulator(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// What became of one true object.
struct SimulatedTruth {
  std::string name;
  std::string class_name;
  int most_depth_pixels = 0;           ///< In the frame that shows it best.
  std::size_t num_frames_visible = 0;  ///< Frames that show it well enough for the detector.
  std::string exclusion_reason;        ///< Empty when it counts in evaluations.
  std::size_t num_frames_named = 0;    ///< Frames in which the detector named it rightly.
};

struct SimulationReport {
  std::size_t num_frames = 0;
  std::size_t num_detections = 0;
  std::vector<SimulatedTruth> objects;  ///< In id order.
};

/// Writes a TUM RGB-D dataset that `hypermap map --input` reads as it is, and the truth:
///
///     rgb.txt, rgb/*.png            colour
///     depth.txt, depth/*.png        16 bit, 5000 units a metre
///     groundtruth.txt               recorded poses
///     intrinsics.json               camera and depth scale
///     detections.jsonl              boxes with full class vectors
///     truth.hmap                    the objects as objects and footprints, the true occupancy
///
/// Written beside `output_dir` under a temporary name, synced and renamed at the end: a failure
/// leaves nothing. An `output_dir` that exists is replaced only when it is empty or holds a
/// simulation (has a `truth.hmap` and an `rgb.txt`) and nothing else: images are those that its
/// lists name. A symbolic link is followed and stays.
/// Errors: those of `Simulator::create`; kIo; kInvalidArgument when `output_dir` is something else,
/// naming what is no part of a simulation.
[[nodiscard]] Result<SimulationReport> simulate(const Scene& scene,
                                                const SimulationOptions& options,
                                                const std::filesystem::path& output_dir,
                                                const JobProgress& progress = {});

}  // namespace hypermap
