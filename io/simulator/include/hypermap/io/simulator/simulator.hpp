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

/// How many things are moved, taken away and brought before the last pass over the camera's way.
///
/// A seed says which: among what the detector can name, the seed does not leave fixed, and nothing
/// else stands on or beside. Moved things stand on the floor and find a free place 0.6 m or more
/// from the old one.
struct SceneChangeOptions {
  int num_moved = 0;    ///< Range: 0 .. 100
  int num_removed = 0;  ///< Range: 0 .. 100
  int num_added = 0;    ///< Not there before the last pass. Range: 0 .. 100

  [[nodiscard]] int total() const noexcept { return num_moved + num_removed + num_added; }
};

[[nodiscard]] const OptionTable& option_table(const SceneChangeOptions& options);

/// Of an image: 8K video has 33 million. A frame is in memory some times over, as depth, colour,
/// objects and masks.
inline constexpr std::int64_t kMostImagePixels = std::int64_t{1} << 26U;

struct SimulationOptions {
  /// Spread evenly over the scene's camera path, in each pass. Range: 1 .. 100,000
  int num_frames = 200;
  /// Every n-th of them is made: the same bytes as without the others. Range: 1 .. 100,000
  int frame_step = 1;
  int num_passes = 1;      ///< Times that the camera goes over its way. Range: 1 .. 100
  std::uint64_t seed = 1;  ///< Of noise, detector and arrangement.
  /// Drift of the recorded poses: 1 walks randomly by 1 cm and 0.1 degrees in the first metre,
  /// growing with the root of the way; 0: exact. Range: 0 .. 100
  double pose_noise = 0.0;
  /// Standard deviation of each coordinate of a recorded position, anew in every frame, beside the
  /// drift. Range: 0 .. 10
  double pose_noise_m = 0.0;
  /// The same of a recorded orientation, about each axis of the map. Range: 0 .. 3
  double pose_noise_rad = 0.0;
  double speed = 1.0;          ///< Driving and turning: ratio to the scene's. Range: > 0
  double lens_height_m = 0.0;  ///< Instead of all heights of the scene. Range: 0, 0.05 .. 100
  PinholeCamera camera{640, 480, 525.0, 525.0, 319.5, 239.5};
  /// Of the images instead of the camera's, whose intrinsics follow; 0: the camera's. Range: 0 ..
  /// 65535, and kMostImagePixels in all
  int width_px = 0;
  int height_px = 0;  ///< The same of their height. Range: 0 .. 65535
  SensorNoiseOptions sensor = {};
  SimulatedDetectorOptions detector = {};
  SceneChangeOptions changes = {};
  /// 0: as many as there are cores. The result does not depend on it. Range: 0 .. 256
  int num_threads = 0;
};

/// Errors: kInvalidArgument naming the field.
[[nodiscard]] Result<void> validate(const SimulationOptions& options);
[[nodiscard]] const OptionTable& option_table(const SimulationOptions& options);

/// The camera that frames are made with: `camera` scaled to `width_px` and `height_px`, so that the
/// outer edges of the image see what they saw before.
[[nodiscard]] PinholeCamera image_camera(const SimulationOptions& options);

/// Something that earlier frames show and that is elsewhere, or gone, at the end; or the other way
/// round.
struct SceneChange {
  enum class Kind : std::uint8_t { kMoved, kRemoved, kAdded };
  Kind kind = Kind::kRemoved;
  PlacedObject object = {};  ///< Where it stood before; of what was added: where it stands.
  /// The same thing at the end; kNoObject when it was removed.
  ObjectId at_end = kNoObject;
};

/// One moment of the simulation.
struct SimulatedFrame {
  RgbdFrame frame;          ///< As a dataset reader would give it: noise, recorded pose.
  MapFromCamera true_pose;  ///< Where the camera really was.
  /// What each pixel really shows. Ids beyond those of `objects` are things that were moved or
  /// removed later, where they stood, and then those that move through the scene.
  InstanceImage instances;
  std::vector<VisibleObject> visible;   ///< All with enough pixels, in id order.
  std::vector<int> depth_pixels;        ///< Measured pixels of each of `objects`, by id - 1.
  std::vector<ObjectId> named_rightly;  ///< Of `visible`: whose detection names their class.
};

/// A scene that can be photographed at any moment of the camera's way.
class Simulator {
 public:
  /// Errors: of `validate`, `furnish`, `CameraPath::create`, `SceneRenderer::create`;
  /// kInvalidArgument naming `changes.num_moved` (or `num_removed`, `num_added`) when the scene has
  /// not so many things that can change.
  [[nodiscard]] static Result<Simulator> create(const Scene& scene,
                                                const SimulationOptions& options);
  Simulator(Simulator&&) noexcept;
  Simulator& operator=(Simulator&&) noexcept;
  ~Simulator();

  [[nodiscard]] std::size_t size() const noexcept;
  /// Requires: index < size(). Safe to call concurrently; frames do not depend on each other.
  [[nodiscard]] SimulatedFrame render(std::size_t index) const;
  /// The objects where they are at the end, in id order.
  [[nodiscard]] std::span<const PlacedObject> objects() const noexcept;
  /// The room at the end, for whoever derives truth from it.
  [[nodiscard]] const FurnishedScene& furnished() const noexcept;
  /// What is otherwise before the last pass.
  [[nodiscard]] std::span<const SceneChange> changes() const noexcept;
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
///     truth.hmap                    the objects as objects and footprints, the true occupancy;
///     when
///                                   things changed, a layer `changes` that says what (moved,
///                                   removed, added), from where, and which object it is at the end
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
