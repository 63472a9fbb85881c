// SPDX-License-Identifier: BSD-3-Clause
#include "choices.hpp"
#include "command.hpp"
#include "data_dir.hpp"
#include "hypermap/core/base/count_text.hpp"
#include "hypermap/io/simulator/scene_file.hpp"
#include "hypermap/io/simulator/simulator.hpp"
#include "number_lists.hpp"
#include "option_flags.hpp"
#include "progress.hpp"

#include <CLI/Validators.hpp>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace hypermap::app {
namespace {

struct SimulateArguments {
  std::string scene = "laboratory";
  std::string output;
  std::string detector = "noisy";
  std::string size;
  /// What the command line says of the detector; else as `detector` names it.
  std::optional<double> miss_rate;
  std::optional<double> false_alarms;
  std::optional<double> box_jitter;
  std::optional<double> wrong_class_rate;
  bool masks = false;
  SimulationOptions simulation;
};

SimulatedDetectorOptions detector_of(const SimulateArguments& arguments) {
  SimulatedDetectorOptions detector;
  detector.noisy = arguments.detector != "perfect";
  if (arguments.detector == "worse") detector = worse_detector(detector);
  detector.miss_rate = arguments.miss_rate.value_or(detector.miss_rate);
  detector.false_alarms_per_frame =
      arguments.false_alarms.value_or(detector.false_alarms_per_frame);
  detector.box_jitter = arguments.box_jitter.value_or(detector.box_jitter);
  detector.wrong_class_rate = arguments.wrong_class_rate.value_or(detector.wrong_class_rate);
  detector.masks = arguments.masks;
  return detector;
}

/// What contradicts what on the command line, for people.
std::optional<std::string> usage_fault(const SimulateArguments& arguments) {
  const SimulationOptions& simulation = arguments.simulation;
  if (simulation.num_passes < 2 && simulation.changes.total() > 0) {
    return "--moved, --removed and --added change what the last pass shows: --passes must be 2 or "
           "more, is " +
           std::to_string(simulation.num_passes);
  }
  if (arguments.detector != "perfect") return std::nullopt;
  const std::pair<const char*, bool> rates[] = {
      {"--miss-rate", arguments.miss_rate.has_value()},
      {"--false-alarms", arguments.false_alarms.has_value()},
      {"--box-noise", arguments.box_jitter.has_value()},
      {"--wrong-class", arguments.wrong_class_rate.has_value()}};
  for (const auto& [flag, is_given] : rates) {
    if (is_given) return std::string(flag) + ": --detector perfect makes no mistakes";
  }
  return std::nullopt;
}

/// For `check`: WIDTHxHEIGHT.
CLI::Validator image_size() {
  const auto check = [](const std::string& text) {
    const auto size = parse_sides(text, "");
    if (!size) return size.error().what;
    if (std::int64_t{size->width_px} * size->height_px <= kMostImagePixels) return std::string();
    return "must have at most " + std::to_string(kMostImagePixels) + " pixels, is '" + text + "'";
  };
  return {check, "WIDTHxHEIGHT"};
}

Result<SimulationReport> run(const SimulateArguments& arguments, const std::string& progress_when) {
  HYPERMAP_ASSIGN_OR_RETURN(const auto path, find_scene(arguments.scene, data_dir()));
  HYPERMAP_ASSIGN_OR_RETURN(const Scene scene, load_scene(path));
  Progress progress("simulating", progress_when);
  return simulate(
      scene, arguments.simulation, arguments.output, [&](std::size_t done, std::size_t total) {
        return progress.update(done, total);
      });
}

void print(const SimulationReport& report, const std::string& output) {
  std::size_t num_counted = 0;
  for (const SimulatedTruth& truth : report.objects) num_counted += truth.exclusion_reason.empty();
  std::printf("%s and %s of %s in %s\n",
              count_text(report.num_frames, "frame").c_str(),
              count_text(report.num_detections, "detection").c_str(),
              count_text(report.objects.size(), "object").c_str(),
              output.c_str());
  std::printf("%s %s in evaluations; not counted:\n",
              count_text(num_counted, "object").c_str(),
              num_counted == 1 ? "counts" : "count");
  for (const SimulatedTruth& truth : report.objects) {
    if (truth.exclusion_reason.empty()) continue;
    std::printf(
        "  %-16s %s\n", printable(truth.name).c_str(), printable(truth.exclusion_reason).c_str());
  }
}

void add_way_options(CLI::App& command, const std::shared_ptr<SimulateArguments>& arguments) {
  SimulationOptions& simulation = arguments->simulation;
  const OptionTable& table = option_table(simulation);
  const auto add = [&](const char* flag, auto& value, const char* field, const char* what) {
    command.add_option(flag, value, what)
        ->check(value_of_field(table, field))
        ->capture_default_str();
  };
  add("--frames", simulation.num_frames, "num_frames", "frames along the camera's way, each pass");
  add("--frame-step", simulation.frame_step, "frame_step", "make every n-th of them only");
  add("--passes", simulation.num_passes, "num_passes", "times over the camera's way");
  add("--speed", simulation.speed, "speed", "ratio to the scene's; frames stay as many");
  add("--lens-height", simulation.lens_height_m, "lens_height_m", "metres; 0: as the scene says");
  command.add_option("--size", arguments->size, "of the images instead of 640x480")
      ->check(image_size());
  add("--pose-noise", simulation.pose_noise, "pose_noise", "drift of the recorded poses");
  add("--pose-noise-m",
      simulation.pose_noise_m,
      "pose_noise_m",
      "white noise of positions, metres");
  add("--pose-noise-rad",
      simulation.pose_noise_rad,
      "pose_noise_rad",
      "white noise of orientations, radians");
}

void add_detector_options(CLI::App& command, const std::shared_ptr<SimulateArguments>& arguments) {
  const SimulatedDetectorOptions usual;
  const OptionTable& table = option_table(usual);
  command.add_option("--detector", arguments->detector, "how well it sees")
      ->transform(one_of({"perfect", "noisy", "worse"}))
      ->capture_default_str();
  const auto add = [&](const char* flag, auto& value, const char* field, const char* what) {
    command.add_option(flag, value, what)->check(value_of_field(table, field));
  };
  add("--miss-rate", arguments->miss_rate, "miss_rate", "share of visible objects missed");
  add("--false-alarms", arguments->false_alarms, "false_alarms_per_frame", "a frame");
  add("--box-noise", arguments->box_jitter, "box_jitter", "of each edge, as a share of the side");
  add("--wrong-class", arguments->wrong_class_rate, "wrong_class_rate", "share named wrongly");
  command.add_flag("--masks", arguments->masks, "also a mask of each thing");
}

void add_change_options(CLI::App& command, const std::shared_ptr<SimulateArguments>& arguments) {
  SceneChangeOptions& changes = arguments->simulation.changes;
  const OptionTable& table = option_table(changes);
  const auto add = [&](const char* flag, auto& value, const char* field, const char* what) {
    command.add_option(flag, value, what)
        ->check(value_of_field(table, field))
        ->capture_default_str();
  };
  add("--moved", changes.num_moved, "num_moved", "things moved before the last pass");
  add("--removed", changes.num_removed, "num_removed", "things removed before the last pass");
  add("--added", changes.num_added, "num_added", "things that the last pass alone shows");
}

}  // namespace

void add_simulate_command(CLI::App& program, const CommonOptions& common, Action& action) {
  auto arguments = std::make_shared<SimulateArguments>();
  const OptionTable& table = option_table(arguments->simulation);
  CLI::App& command = *program.add_subcommand(
      "simulate", "Render a posed RGB-D sequence of a furnished scene, with detections and truth");
  command
      .add_option(
          "--scene", arguments->scene, "a scene that ships, such as laboratory, or a scene file")
      ->capture_default_str();
  command.add_option("--output", arguments->output, "folder to make: a TUM RGB-D dataset")
      ->required();
  add_way_options(command, arguments);
  command.add_option("--seed", arguments->simulation.seed, "of arrangement, noise and detector")
      ->transform(whole_number())
      ->capture_default_str();
  add_detector_options(command, arguments);
  add_change_options(command, arguments);
  command.add_option("--threads", arguments->simulation.num_threads, "0: one for each core")
      ->check(value_of_field(table, "num_threads"))
      ->capture_default_str();
  show_examples(command,
                {"hypermap simulate --scene laboratory --frames 200 --output lab",
                 "hypermap simulate --passes 2 --moved 2 --removed 1 --output changing"});
  command.callback([arguments, &common, &action] {
    if (const auto fault = usage_fault(*arguments)) throw CLI::ValidationError("simulate", *fault);
    action = [arguments, &common] {
      arguments->simulation.detector = detector_of(*arguments);
      if (const auto size = parse_sides(arguments->size, "--size")) {
        arguments->simulation.width_px = size->width_px;
        arguments->simulation.height_px = size->height_px;
      }
      const auto report_or_error = run(*arguments, common.progress);
      if (!report_or_error) return report(report_or_error.error());
      print(*report_or_error, arguments->output);
      return ExitCode::kDone;
    };
  });
}

}  // namespace hypermap::app
