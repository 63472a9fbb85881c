// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What the frames of a recorded or simulated dataset say of the plane, in a stack.
///
/// Source: [sogm] III-A to III-C: sensors' grids are made, aligned and fused.
#pragma once

#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/core/base/job_progress.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/vocabulary/class_vocabulary.hpp"
#include "hypermap/grid_registration/grid_registration.hpp"
#include "hypermap/io/archive/provenance.hpp"
#include "hypermap/io/dataset/dataset_reader.hpp"
#include "hypermap/projection/sensor_models/inverse_sensor_model.hpp"
#include "hypermap/projection/stack/grid_stack.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap {

/// Which inverse sensor model reads the frames.
enum class FrameSensorKind : std::uint8_t {
  kDepth,       ///< DepthCameraModel: layer `<parent>/depth`.
  kDetections,  ///< DetectionModel: layers `<parent>/detections/<class>`.
};

/// "depth", "detections".
[[nodiscard]] std::span<const std::string_view> frame_sensor_names();

/// Why a frame was not registered, for people, by the reason's field: "rivals" is "several places
/// fit about as well". Boundary: another field is its own text.
[[nodiscard]] std::string_view refusal_text(std::string_view reason);

struct FrameSensor {
  FrameSensorKind kind = FrameSensorKind::kDepth;
  double weight = 1.0;  ///< As SensorGrid::weight: frames of a slow camera see much the same.
};

struct SensedStackJob {
  std::filesystem::path input;
  DatasetOptions dataset = {};
  std::vector<FrameSensor> sensors = {FrameSensor{}};
  /// Of detections: what these ask for (asked_names); all when empty.
  std::vector<std::string> classes = {};
  ClassVocabulary vocabulary = {};  ///< By which they are understood.
  HeightOptions heights = {};
  /// The layer of the stack that the depth of each frame is registered to before the frame is
  /// fused; none: poses are taken as they are.
  std::optional<std::string> reference = std::nullopt;
  GridRegistrationOptions registration = {.max_shift_m = 0.5, .max_turn_rad = 0.2};
};

struct SensedStackReport {
  std::size_t num_frames = 0;      ///< That were fused.
  std::size_t num_detections = 0;  ///< In them.
  std::vector<Error> skipped;      ///< Frames that could not be read, with the reason.
  std::size_t num_registered = 0;
  /// Frames whose registration was refused, by the reason's field ("rivals"): fused as posed.
  std::map<std::string, std::size_t> num_refused;
  double mean_shift_m = 0.0;  ///< Of the registered ones, as the next one: how far they were moved.
  double max_shift_m = 0.0;
};

/// Fuses what the frames say, which were posed in the world of one of the map's runs.
///
/// That is the newest run whose world has the input's name of it, else the newest one of an input
/// with this folder's name. A class gets a layer when some detection of it has a foot on the
/// ground; a class of the map and of the dataset is one. Grids are made in the stack's resolution;
/// what lies outside of it is left out. Errors, after which the stack is as it was:
/// kInvalidArgument when no run has the input's world, nothing is to be sensed or a registration's
/// options are wrong; kNotFound when the stack has no layer `reference`, no frame can be read, or
/// frames are to be registered and none can be, with the reasons;
/// those of open_dataset, asked_classes and GridStack::fuse; kInterrupted. Cost: a pass
/// over the frames; a registration is a fraction of a second each.
[[nodiscard]] Result<SensedStackReport> fuse_frames(GridStack& stack,
                                                    const SensedStackJob& job,
                                                    std::span<const Provenance> runs,
                                                    ClassRegistry classes,
                                                    const JobProgress& progress = {});

}  // namespace hypermap
