// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/base/number_text.hpp"
#include "hypermap/core/base/option_rows.hpp"
#include "hypermap/io/simulator/simulation_truth.hpp"
#include "hypermap/io/simulator/simulator.hpp"

#include <cstdint>
#include <numbers>
#include <string>
#include <string_view>

namespace hypermap {
namespace {

using Sensor = SensorNoiseOptions;
using Detector = SimulatedDetectorOptions;

constexpr std::string_view kNoise = "docs/EVALUATION.md, Noise";
constexpr std::string_view kAxialNoise = "Nguyen, Izadi, Lovell 2012";

constexpr OptionRow kSensorNoiseRows[] = {
    option::number<&Sensor::min_range_m>(
        "min_range_m",
        {0, 1000},
        {.unit = "m", .source = kNoise, .effect = "Nearer gives no depth."}),
    option::number<&Sensor::max_range_m>(
        "max_range_m",
        {0, 1000},
        {.unit = "m", .source = kNoise, .effect = "Farther gives no depth."}),
    option::number<&Sensor::noise_base_m>(
        "noise_base_m",
        option::at_least(0),
        {.unit = "m", .source = kAxialNoise, .effect = "Standard deviation at 0.4 m."}),
    option::number<&Sensor::noise_per_m2>(
        "noise_per_m2",
        option::at_least(0),
        {.unit = "1/m", .source = kAxialNoise, .effect = "Its growth with (z - 0.4 m)^2."}),
    option::number<&Sensor::step_m>(
        "step_m",
        option::above(0, kUnbounded),
        {.unit = "m", .source = kNoise, .effect = "Depth comes in these steps."}),
    option::number<&Sensor::edge_ratio>(
        "edge_ratio",
        option::above(0, kUnbounded),
        {.source = kNoise,
         .effect = "Steps of depth to a neighbour above this share of it give a hole."}),
    option::number<&Sensor::max_incidence_rad>(
        "max_incidence_rad",
        {0, std::numbers::pi / 2},
        {.unit = "rad", .source = kNoise, .effect = "Flatter views give holes."}),
    option::number<&Sensor::dropout>(
        "dropout", {0, 1}, {.source = kNoise, .effect = "Share of pixels lost at random."}),
};

Result<void> check_ranges(const SensorNoiseOptions& options) {
  return check_above("min_range_m", options.min_range_m, "max_range_m", options.max_range_m);
}

constexpr OptionRow kDetectorRows[] = {
    option::flag<&Detector::noisy>("noisy",
                                   {.effect = "Else exact boxes, no misses, no false alarms."}),
    option::count<&Detector::min_visible_px>(
        "min_visible_px",
        option::at_least(1),
        {.unit = "px", .source = kNoise, .effect = "Smaller ones are not detected."}),
    option::number<&Detector::min_unhidden_share>(
        "min_unhidden_share",
        {0, 1},
        {.source = kNoise, .effect = "Objects hidden more are not seen."}),
    option::number<&Detector::miss_rate>(
        "miss_rate", {0, 1}, {.source = kNoise, .effect = "Share of visible objects missed."}),
    option::number<&Detector::false_alarms_per_frame>(
        "false_alarms_per_frame",
        {0, 20},
        {.source = kNoise, .effect = "Mean of a Poisson distribution."}),
    option::number<&Detector::box_jitter>(
        "box_jitter",
        {0, 1},
        {.source = kNoise, .effect = "Standard deviation of an edge, as a share of the side."}),
    option::number<&Detector::similar_weight>(
        "similar_weight",
        {0, 1},
        {.source = kNoise, .effect = "Share of the weight at similar classes."}),
    option::number<&Detector::wrong_class_rate>(
        "wrong_class_rate",
        {0, 1},
        {.source = kNoise, .effect = "Share that names a wrong class outright."}),
    option::number<&Detector::min_score>(
        "min_score", {0, 1}, {.source = kNoise, .effect = "Scores are uniform from here."}),
    option::number<&Detector::max_score>(
        "max_score", {0, 1}, {.source = kNoise, .effect = "Scores are uniform up to here."}),
    option::number<&Detector::perfect_probability>(
        "perfect_probability",
        {0, 1},
        {.source = kNoise, .effect = "Of the true class without noise."}),
    option::flag<&Detector::masks>("masks",
                                   {.source = kNoise, .effect = "Also a mask of each object."}),
    option::names<&Detector::class_names>(
        "class_names", {.effect = "What the detector can name; the classes of COCO when empty."}),
};

Result<void> check_scores(const SimulatedDetectorOptions& options) {
  if (options.min_score <= options.max_score) return {};
  return fail(ErrorCode::kInvalidArgument,
              "must be at most max_score (" + number_text(options.max_score) + "), is " +
                  number_text(options.min_score),
              "min_score");
}

constexpr std::string_view kChanges = "docs/EVALUATION.md, Changes";

constexpr OptionRow kChangeRows[] = {
    option::count<&SceneChangeOptions::num_moved>(
        "num_moved",
        {0, 100},
        {.source = kChanges, .effect = "Things that stand elsewhere in the last pass."}),
    option::count<&SceneChangeOptions::num_removed>(
        "num_removed",
        {0, 100},
        {.source = kChanges, .effect = "Things that are gone in the last pass."}),
    option::count<&SceneChangeOptions::num_added>(
        "num_added",
        {0, 100},
        {.source = kChanges, .effect = "Things that are there in the last pass alone."}),
};

constexpr OptionRow kSimulationRows[] = {
    option::count<&SimulationOptions::num_frames>(
        "num_frames",
        {1, 100000},
        {.effect = "Spread evenly over the camera path of the scene, in each pass."}),
    option::count<&SimulationOptions::frame_step>(
        "frame_step", {1, 100000}, {.effect = "Every n-th of the frames is made."}),
    option::count<&SimulationOptions::num_passes>(
        "num_passes", {1, 100}, {.effect = "Times that the camera goes over its way."}),
    option::count<&SimulationOptions::seed>(
        "seed", option::at_least(0), {.effect = "Of noise, detector and arrangement."}),
    option::number<&SimulationOptions::pose_noise>(
        "pose_noise",
        {0, 100},
        {.source = kNoise,
         .effect = "Drift of the recorded poses; 1 is 1 cm and 0.1 degrees in the first metre."}),
    option::number<&SimulationOptions::pose_noise_m>(
        "pose_noise_m",
        {0, 10},
        {.unit = "m",
         .source = kNoise,
         .effect = "White noise of each coordinate of a recorded position."}),
    option::number<&SimulationOptions::pose_noise_rad>(
        "pose_noise_rad",
        {0, 3},
        {.unit = "rad",
         .source = kNoise,
         .effect = "White noise of a recorded orientation about each axis."}),
    option::number<&SimulationOptions::speed>(
        "speed",
        option::above(0, 1000),
        {.effect = "Driving and turning, as a multiple of what the scene says."}),
    option::number<&SimulationOptions::lens_height_m>(
        "lens_height_m",
        option::zero_or(0.05, 100),
        {.unit = "m", .effect = "Instead of all heights of the scene; 0: those of the scene."}),
    option::count<&SimulationOptions::width_px>(
        "width_px",
        {0, 65535},
        {.unit = "px", .effect = "Of the images; 0: as the camera has it."}),
    option::count<&SimulationOptions::height_px>(
        "height_px",
        {0, 65535},
        {.unit = "px", .effect = "Of the images; 0: as the camera has it."}),
    option::section<&SimulationOptions::sensor>("sensor"),
    option::section<&SimulationOptions::detector>("detector"),
    option::section<&SimulationOptions::changes>("changes"),
    option::count<&SimulationOptions::num_threads>(
        "num_threads", {0, 256}, {.effect = "0: as many as there are cores.", .is_listed = false}),
};

Result<void> check_camera_and_changes(const SimulationOptions& options) {
  if (options.changes.total() > 0 && options.num_passes < 2)
    return fail(ErrorCode::kInvalidArgument,
                "must be 2 or more when things change between passes, is " +
                    std::to_string(options.num_passes),
                "num_passes");
  HYPERMAP_TRY(validate(options.camera));
  const PinholeCamera camera = image_camera(options);
  if (static_cast<std::int64_t>(camera.width_px) * camera.height_px > kMostImagePixels)
    return fail(ErrorCode::kInvalidArgument,
                "images must have at most " + std::to_string(kMostImagePixels) + " pixels, have " +
                    std::to_string(camera.width_px) + " x " + std::to_string(camera.height_px),
                "width_px");
  return validate(camera);
}

constexpr OptionRow kTrueOccupancyRows[] = {
    option::number<&TrueOccupancyOptions::min_height_m>(
        "min_height_m",
        {-kUnbounded, kUnbounded},
        {.unit = "m", .effect = "Lower surfaces (the floor) are no obstacle."}),
    option::number<&TrueOccupancyOptions::max_height_m>(
        "max_height_m",
        {-kUnbounded, kUnbounded},
        {.unit = "m", .effect = "Higher surfaces are none either."}),
    option::number<&TrueOccupancyOptions::resolution_m>(
        "resolution_m", {0.001, 10}, {.unit = "m", .effect = "Edge of a cell."}),
};

Result<void> check_true_band(const TrueOccupancyOptions& options) {
  return check_above("min_height_m", options.min_height_m, "max_height_m", options.max_height_m);
}

}  // namespace

const OptionTable& option_table(const SensorNoiseOptions&) {
  static constexpr OptionTable kTable{kSensorNoiseRows, kRule<check_ranges>};
  return kTable;
}

Result<void> validate(const SensorNoiseOptions& options) {
  return check_options(options, "sensor");
}

const OptionTable& option_table(const SimulatedDetectorOptions&) {
  static constexpr OptionTable kTable{kDetectorRows, kRule<check_scores>};
  return kTable;
}

Result<void> validate(const SimulatedDetectorOptions& options) {
  return check_options(options, "detector");
}

const OptionTable& option_table(const SceneChangeOptions&) {
  static constexpr OptionTable kTable{kChangeRows};
  return kTable;
}

const OptionTable& option_table(const SimulationOptions&) {
  static constexpr OptionTable kTable{kSimulationRows, kRule<check_camera_and_changes>};
  return kTable;
}

Result<void> validate(const SimulationOptions& options) {
  return check_options(options);
}

const OptionTable& option_table(const TrueOccupancyOptions&) {
  static constexpr OptionTable kTable{kTrueOccupancyRows, kRule<check_true_band>};
  return kTable;
}

Result<void> validate(const TrueOccupancyOptions& options) {
  return check_options(options);
}

}  // namespace hypermap
