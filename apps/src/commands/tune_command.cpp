// SPDX-License-Identifier: BSD-3-Clause
#include "choices.hpp"
#include "command.hpp"
#include "dataset_arguments.hpp"
#include "hypermap/core/segmentation/masks.hpp"
#include "hypermap/core/segmentation/segmentation_trace.hpp"
#include "hypermap/io/codec/atomic_file.hpp"
#include "hypermap/io/codec/png_image.hpp"
#include "hypermap/io/dataset/gravity_alignment.hpp"
#include "hypermap/io/dataset/smoothed_depth.hpp"
#include "hypermap/viewer_offscreen/figures/segmentation_figures.hpp"
#include "number_lists.hpp"
#include "outputs.hpp"
#include "tables.hpp"
#include "tune_options.hpp"
#include "tune_sweep.hpp"
#include "tune_times.hpp"

#include <cstdio>
#include <memory>
#include <optional>
#include <utility>

namespace hypermap::app {
namespace {

struct TuneArguments {
  DatasetArguments dataset;
  std::vector<std::string> detections;
  std::optional<std::size_t> frame;
  std::optional<std::size_t> detection;
  std::optional<std::string> output;
  std::optional<std::string> up_axis;
  TuneOptions options;
  SweepArguments sweep;
  bool times = false;
};

std::string file_safe(std::string text) {
  for (char& c : text) {
    if (c == ' ' || c == '/') c = '-';
  }
  return text;
}

/// Writes figures into a folder, when somebody wants them.
class FigureFolder {
 public:
  [[nodiscard]] static Result<FigureFolder> create(const std::optional<std::string>& folder) {
    FigureFolder made;
    if (!folder) return made;
    made.folder_ = *folder;
    HYPERMAP_ASSIGN_OR_RETURN(made.figures_, SegmentationFigures::create());
    std::error_code failed;
    std::filesystem::create_directories(*folder, failed);
    if (failed) return Unexpected(Error{ErrorCode::kIo, failed.message(), *folder});
    return made;
  }

  [[nodiscard]] Result<void> frame(const RgbdFrame& frame,
                                   const ClassRegistry& classes,
                                   const BinnedDepthMapOptions& options) const {
    if (!figures_) return {};
    const BinnedDepthMap panels = BinnedDepthMap::create(frame, options);
    HYPERMAP_TRY(write("detections.png", figures_->detections(frame, classes)));
    HYPERMAP_TRY(write("panels.png", figures_->panels(frame, panels)));
    return write("panels-from-above.png", figures_->panels_from_above(panels));
  }

  [[nodiscard]] Result<void> detection(const RgbdFrame& frame,
                                       std::size_t index,
                                       const SegmentationTrace& trace) const {
    if (!figures_) return {};
    const Detection& detection = frame.detections[index];
    const std::string stem = "detection-" + std::to_string(index);
    for (std::size_t i = 0; i < trace.steps.size(); ++i) {
      const std::string name =
          stem + "-step-" + std::to_string(i + 1) + "-" + file_safe(trace.steps[i].name) + ".png";
      HYPERMAP_TRY(write(name, figures_->step(frame, detection, trace, i)));
    }
    return write(stem + "-box.png", figures_->segment(frame, detection, trace.segment));
  }

 private:
  [[nodiscard]] Result<void> write(const std::string& name, const ColorImage& image) const {
    HYPERMAP_ASSIGN_OR_RETURN(const std::string bytes, encode_png(image));
    return write_file_atomically(folder_ / name, bytes);
  }

  std::filesystem::path folder_;
  std::optional<SegmentationFigures> figures_;
};

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
  if (detection.mask) {
    const PixelRect bounds = bounds_of(*detection.mask);
    std::printf("  with a mask, columns %d to %d, rows %d to %d\n",
                bounds.u_begin,
                bounds.u_end - 1,
                bounds.v_begin,
                bounds.v_end - 1);
  }
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

/// As `map` aligns it. What has no floor to be seen is segmented as it is, unless an axis was
/// named.
Result<void> align_world(DatasetReader& dataset, const std::optional<std::string>& up_axis) {
  const auto up = align_to_gravity(dataset, up_axis);
  if (up) {
    dataset.set_map_from_input(up->map_from_input);
  } else if (up_axis) {
    return Unexpected(up.error());
  } else {
    std::fprintf(
        stderr, "tune: z of the input is taken to be up: %s\n", to_string(up.error()).c_str());
  }
  return {};
}

Result<std::unique_ptr<DatasetReader>> open_aligned(const TuneArguments& arguments,
                                                    const DepthSmoothingOptions& smoothing,
                                                    ClassRegistry& classes) {
  HYPERMAP_ASSIGN_OR_RETURN(DatasetOptions dataset_options, arguments.dataset.options());
  dataset_options.detections.assign(arguments.detections.begin(), arguments.detections.end());
  HYPERMAP_ASSIGN_OR_RETURN(auto dataset,
                            open_dataset(arguments.dataset.input, dataset_options, classes));
  HYPERMAP_TRY(align_world(*dataset, arguments.up_axis));
  return with_smoothed_depth(std::move(dataset), smoothing);
}

Result<RgbdFrame> read_asked_frame(const TuneArguments& arguments, const DatasetReader& dataset) {
  if (*arguments.frame >= dataset.size()) {
    return fail(ErrorCode::kNotFound,
                "the dataset has frames 0.." + std::to_string(dataset.size() - 1) + ", asked for " +
                    std::to_string(*arguments.frame),
                "--frame");
  }
  HYPERMAP_ASSIGN_OR_RETURN(RgbdFrame frame, dataset.read(*arguments.frame));
  if (frame.detections.empty()) {
    return fail(ErrorCode::kNotFound, "nothing was detected in it", frame.name);
  }
  if (arguments.detection && *arguments.detection >= frame.detections.size()) {
    return fail(ErrorCode::kNotFound,
                "the frame has detections 0.." + std::to_string(frame.detections.size() - 1) +
                    ", asked for " + std::to_string(*arguments.detection),
                "--detection");
  }
  return frame;
}

Result<void> show_frame(const TuneArguments& arguments,
                        const DatasetReader& dataset,
                        const ClassRegistry& classes,
                        const ObjectPipelineOptions& objects) {
  HYPERMAP_ASSIGN_OR_RETURN(const RgbdFrame frame, read_asked_frame(arguments, dataset));
  HYPERMAP_ASSIGN_OR_RETURN(const FigureFolder folder, FigureFolder::create(arguments.output));
  HYPERMAP_TRY(folder.frame(frame, classes, objects.binned_depth));
  for (std::size_t i = 0; i < frame.detections.size(); ++i) {
    if (arguments.detection && *arguments.detection != i) continue;
    const SegmentationTrace trace =
        trace_segmentation(frame, frame.detections[i], objects.segmentation);
    print(trace, frame.detections[i], classes, i);
    HYPERMAP_TRY(folder.detection(frame, i, trace));
  }
  return {};
}

Result<void> tune(const TuneArguments& arguments,
                  const MapOptions& options,
                  const std::string& progress_when) {
  ClassRegistry classes;
  HYPERMAP_ASSIGN_OR_RETURN(const auto dataset,
                            open_aligned(arguments, options.mapper.smoothing, classes));
  const ObjectPipelineOptions objects = with_ranges(options.mapper).objects;
  if (!arguments.times) return show_frame(arguments, *dataset, classes, objects);
  return tell_times(
      *dataset, objects.segmentation, arguments.output, arguments.sweep.json, progress_when);
}

/// Which frame, unless maps are compared; which dataset, unless their sequences are simulated.
void require_inputs(const TuneArguments& arguments) {
  const bool has_input = !arguments.dataset.input.empty();
  if (arguments.sweep.is_asked()) {
    if (arguments.sweep.truth && !has_input) throw CLI::RequiredError("--input");
    if (has_input && !arguments.sweep.truth) {
      throw CLI::ValidationError("--input", "is swept when its --truth is given");
    }
    return;
  }
  if (!has_input) throw CLI::RequiredError("--input");
  if (arguments.sweep.json && !arguments.times) {
    throw CLI::ValidationError("--json", "goes with --sweep and --times");
  }
  if (!arguments.frame && !arguments.times) throw CLI::RequiredError("--frame");
}

}  // namespace

void add_tune_command(CLI::App& program, const CommonOptions& common, Action& action) {
  auto arguments = std::make_shared<TuneArguments>();
  CLI::App& command = *program.add_subcommand(
      "tune", "The segmentation of one frame's detections, step by step; maps with other options");
  arguments->dataset.add_to(command);
  command.get_option("--input")->required(false);
  command.add_option("--detections", arguments->detections, "detections file; may be repeated");
  command.add_option("--frame", arguments->frame, "which frame, counted from 0")
      ->transform(whole_number());
  command
      .add_option("--detection", arguments->detection, "only this one of the frame, counted from 0")
      ->transform(whole_number());
  command
      .add_option("--up", arguments->up_axis, "axis of the dataset's world, or floor to find it")
      ->transform(one_of({"x", "-x", "y", "-y", "z", "-z", "floor"}));
  command.add_option(
      "--output",
      arguments->output,
      "folder for figures of the detections, each step, the box and the panels; for box plots");
  arguments->options.add_to(command);
  arguments->sweep.add_to(command);
  command
      .add_flag("--times",
                arguments->times,
                "instead of --frame: what each step takes and leaves over all detections, with box "
                "plots in --output")
      ->excludes(command.get_option("--frame"))
      ->excludes(command.get_option("--sweep"));
  show_examples(command,
                {"hypermap tune --input lab --frame 10 --detection 0 --output steps",
                 "hypermap tune --input lab --frame 10 --preset smap --without outliers,clusters",
                 "hypermap tune --input lab --times --output plots",
                 "hypermap tune --sweep octree.resolution_m=0.03,0.05 --seeds 1,2,3"});
  command.callback([arguments, &common, &action] {
    require_inputs(*arguments);
    arguments->sweep.keep_to_rules();
    const auto options = map_options_of(arguments->options);
    if (!options) {
      const Error& error = options.error();
      if (exit_code_of(error) == ExitCode::kSystem || !error.file.empty()) {
        action = [error] { return report(error); };
        return;
      }
      throw CLI::ValidationError("tune", to_string(error));
    }
    if (arguments->output) keep_out_of_datasets("--output", *arguments->output);
    action = [arguments, &common, options = *options] {
      if (arguments->sweep.is_asked()) {
        return sweep(
            arguments->sweep, arguments->dataset, arguments->detections, options, common.progress);
      }
      const auto done = tune(*arguments, options, common.progress);
      return done ? ExitCode::kDone : report(done.error());
    };
  });
}

}  // namespace hypermap::app
