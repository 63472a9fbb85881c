// SPDX-License-Identifier: BSD-3-Clause
#include "command.hpp"
#include "dataset_arguments.hpp"
#include "hypermap/core/base/number_text.hpp"
#include "hypermap/core/segmentation/segmentation_trace.hpp"
#include "hypermap/io/codec/atomic_file.hpp"
#include "hypermap/io/codec/png_image.hpp"
#include "number_lists.hpp"
#include "option_flags.hpp"
#include "outputs.hpp"
#include "tables.hpp"

#include <CLI/Validators.hpp>

#include <cstdio>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>

namespace hypermap::app {
namespace {

struct TuneArguments {
  DatasetArguments dataset;
  std::vector<std::string> detections;
  std::size_t frame = 0;
  std::optional<std::size_t> detection;
  std::optional<std::string> output;
  std::string policy = "foreground";
  std::optional<double> angle_deg;
  std::optional<std::string> curvature;
  std::optional<std::string> leaf_size_m;
  bool no_outliers = false;
  bool no_clusters = false;
};

constexpr const char* kPolicyOption = "segmentation.policy";
constexpr const char* kAngleOption = "segmentation.region_growing.angle_threshold_rad";
constexpr const char* kCurvatureOption = "segmentation.region_growing.curvature_threshold";
constexpr const char* kLeafOption = "segmentation.leaf_size_m";

/// As the option's text.
std::optional<std::string> radians_of(std::optional<double> angle_deg) {
  if (!angle_deg) return std::nullopt;
  return number_text(*angle_deg * std::numbers::pi / 180.0);
}

/// The source's own values for a source's policy, then what was asked for.
Result<GeometricSegmentationOptions> options_of(const TuneArguments& arguments) {
  HYPERMAP_ASSIGN_OR_RETURN(MapOptions all, with_option({}, kPolicyOption, arguments.policy));
  GeometricSegmentationOptions& options = all.mapper.objects.segmentation;
  const SegmentationPolicy policy = options.policy;
  if (policy == SegmentationPolicy::kCluster) options = smap_segmentation();
  if (policy == SegmentationPolicy::kRegionGrowing) options = hypermap_segmentation();
  if (arguments.no_outliers) options.outlier_neighbours = 0;
  if (arguments.no_clusters) options.cluster_gap_m = 0.0;
  const bool is_growing = policy == SegmentationPolicy::kRegionGrowing;
  if (!is_growing && (arguments.angle_deg || arguments.curvature)) {
    return fail(ErrorCode::kInvalidArgument,
                "belongs to --policy region_growing, is given with " + arguments.policy,
                arguments.angle_deg ? "--angle" : "--curvature");
  }
  HYPERMAP_ASSIGN_OR_RETURN(all,
                            with_flags(std::move(all),
                                       {{kAngleOption, radians_of(arguments.angle_deg)},
                                        {kCurvatureOption, arguments.curvature},
                                        {kLeafOption, arguments.leaf_size_m}}));
  return all.mapper.objects.segmentation;
}

Result<void> write_image(const std::filesystem::path& path, const ColorImage& image) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::string bytes, encode_png(image));
  return write_file_atomically(path, bytes);
}

std::string file_safe(std::string text) {
  for (char& c : text) {
    if (c == ' ' || c == '/') c = '-';
  }
  return text;
}

Result<void> write_images(const SegmentationTrace& trace,
                          const RgbdFrame& frame,
                          const std::filesystem::path& folder,
                          std::size_t detection) {
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  if (failed) return Unexpected(Error{ErrorCode::kIo, failed.message(), folder.string()});
  for (std::size_t i = 0; i < trace.steps.size(); ++i) {
    const std::string name = "detection-" + std::to_string(detection) + "-step-" +
                             std::to_string(i + 1) + "-" + file_safe(trace.steps[i].name) + ".png";
    HYPERMAP_TRY(write_image(folder / name, render_labels(trace.steps[i].labels, frame.color)));
  }
  return {};
}

void print(const SegmentationTrace& trace,
           const Detection& detection,
           const ClassRegistry& classes,
           std::size_t index) {
  const auto best = best_class(detection.class_scores);
  std::printf("detection %zu: %s, score %.2f, box %.0f %.0f %.0f %.0f\n",
              index,
              best ? printable(classes.name(best->id)).c_str() : "unknown",
              detection.score.value(),
              detection.box_px.u_min_px,
              detection.box_px.v_min_px,
              detection.box_px.u_max_px,
              detection.box_px.v_max_px);
  Table table({"  step", "points", "segments", "ms"});
  for (const SegmentationStep& step : trace.steps) {
    table.add({"  " + step.name,
               std::to_string(step.num_points),
               std::to_string(step.num_segments),
               fixed(1000.0 * step.seconds, 2)});
  }
  std::printf("%s", table.text().c_str());
  if (!trace.segment) {
    std::printf("  nothing left: %s\n", to_string(trace.segment.error()).c_str());
    return;
  }
  const Segment& segment = *trace.segment;
  const Eigen::Vector3d extent = segment.box.extent();
  std::printf(
      "  segment of %zu points, %zu pixels, %.3f x %.3f x %.3f m, %.2f m from the camera, box "
      "confidence %.2f\n",
      segment.points_in_map.size(),
      segment.pixel_indices.size(),
      extent.x(),
      extent.y(),
      extent.z(),
      segment.distance_m,
      segment.box_confidence.value());
}

Result<void> tune(const TuneArguments& arguments, const GeometricSegmentationOptions& options) {
  ClassRegistry classes;
  HYPERMAP_ASSIGN_OR_RETURN(DatasetOptions dataset_options, arguments.dataset.options());
  dataset_options.detections.assign(arguments.detections.begin(), arguments.detections.end());
  HYPERMAP_ASSIGN_OR_RETURN(const auto dataset,
                            open_dataset(arguments.dataset.input, dataset_options, classes));
  if (arguments.frame >= dataset->size()) {
    return fail(ErrorCode::kNotFound,
                "the dataset has frames 0.." + std::to_string(dataset->size() - 1) +
                    ", asked for " + std::to_string(arguments.frame),
                "--frame");
  }
  HYPERMAP_ASSIGN_OR_RETURN(const RgbdFrame frame, dataset->read(arguments.frame));
  if (frame.detections.empty()) {
    return fail(ErrorCode::kNotFound, "nothing was detected in it", frame.name);
  }
  if (arguments.detection && *arguments.detection >= frame.detections.size()) {
    return fail(ErrorCode::kNotFound,
                "the frame has detections 0.." + std::to_string(frame.detections.size() - 1) +
                    ", asked for " + std::to_string(*arguments.detection),
                "--detection");
  }
  for (std::size_t i = 0; i < frame.detections.size(); ++i) {
    if (arguments.detection && *arguments.detection != i) continue;
    const SegmentationTrace trace = trace_segmentation(frame, frame.detections[i], options);
    print(trace, frame.detections[i], classes, i);
    if (!arguments.output) continue;
    HYPERMAP_TRY(write_images(trace, frame, *arguments.output, i));
  }
  return {};
}

}  // namespace

void add_tune_command(CLI::App& program, Action& action) {
  auto arguments = std::make_shared<TuneArguments>();
  CLI::App& command =
      *program.add_subcommand("tune", "The segmentation of one frame's detections, step by step");
  arguments->dataset.add_to(command);
  command.add_option("--detections", arguments->detections, "detections file; may be repeated");
  command.add_option("--frame", arguments->frame, "which frame, counted from 0")
      ->required()
      ->check(CLI::NonNegativeNumber.description("at least 0"));
  command
      .add_option("--detection", arguments->detection, "only this one of the frame, counted from 0")
      ->check(CLI::NonNegativeNumber.description("at least 0"));
  command.add_option("--output", arguments->output, "folder for an image of each step");
  command
      .add_option(
          "--policy", arguments->policy, "how objects are separated from their surroundings")
      ->transform(choice_of_option(kPolicyOption))
      ->capture_default_str();
  command.add_option("--angle", arguments->angle_deg, "region growing: degrees between normals")
      ->check(number_in(0.0, 90.0));
  command.add_option("--curvature", arguments->curvature, "region growing: of points that lead on")
      ->check(value_of_option(kCurvatureOption));
  command.add_option("--leaf-size", arguments->leaf_size_m, "voxel grid, metres; 0 leaves it out")
      ->check(value_of_option(kLeafOption));
  command.add_flag("--no-outliers", arguments->no_outliers, "leave out the removal of outliers");
  command.add_flag("--no-clusters", arguments->no_clusters, "leave out the clustering");
  show_examples(command, {"hypermap tune --input lab --frame 10 --detection 0 --output steps"});
  command.callback([arguments, &action] {
    const auto options = options_of(*arguments);
    if (!options) throw CLI::ValidationError("tune", to_string(options.error()));
    if (arguments->output) keep_out_of_datasets("--output", *arguments->output);
    action = [arguments, options = *options] {
      const auto done = tune(*arguments, options);
      return done ? ExitCode::kDone : report(done.error());
    };
  });
}

}  // namespace hypermap::app
