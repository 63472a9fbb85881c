// SPDX-License-Identifier: BSD-3-Clause
#include "sensed_arguments.hpp"

#include "hypermap/core/base/nearest_name.hpp"
#include "hypermap/core/base/number_text.hpp"
#include "load_arguments.hpp"
#include "number_lists.hpp"
#include "option_flags.hpp"
#include "stack_arguments.hpp"

#include <CLI/Validators.hpp>

#include <algorithm>
#include <cstdio>

namespace hypermap::app {
namespace {

FrameSensor parse_sensor(const std::string& text) {
  const auto parsed = parse_weighted(text, "--sensor");
  if (!parsed) throw CLI::ValidationError("--sensor", parsed.error().what);
  const auto names = frame_sensor_names();
  const auto name = std::ranges::find(names, parsed->name);
  if (name == names.end()) {
    throw CLI::ValidationError("--sensor", not_one_of(parsed->name, names));
  }
  return {.kind = static_cast<FrameSensorKind>(name - names.begin()), .weight = parsed->weight};
}

/// Detections were to be fused, and the frames had none.
void print_nothing_detected(const SensedStackJob& job) {
  const auto is_of_detections = [](const FrameSensor& sensor) {
    return sensor.kind == FrameSensorKind::kDetections;
  };
  if (std::ranges::none_of(job.sensors, is_of_detections)) return;
  std::fprintf(stderr, "--sensor detections: nothing was detected in the frames fused\n");
  if (!job.dataset.detections.empty()) return;
  for (const std::string& name : unused_detections(job.input)) {
    std::fprintf(
        stderr, "not used: %s in the input; --detections names it\n", printable(name).c_str());
  }
}

}  // namespace

void SensedArguments::add_to(CLI::App& command) {
  const OptionTable& limits = option_table(GridRegistrationOptions{});
  dataset.add_to(command);
  CLI::Option* input = command.get_option("--input")->required(false);
  command
      .add_option("--sensor",
                  sensors,
                  "depth, detections, or one of them with =WEIGHT: what of the frames of --input "
                  "is fused as further layers; may be repeated")
      ->delimiter(',')
      ->capture_default_str()
      ->needs(input);
  command
      .add_option("--detections",
                  detections,
                  "detections file for --sensor detections, one a detector; may be repeated")
      ->needs(input);
  CLI::Option* register_option =
      command
          .add_option("--register",
                      reference,
                      "layer of the stack that each frame's depth is registered to before it is "
                      "fused; frames that cannot be are fused as posed and counted by the reason, "
                      "unless none can be, which is an error")
          ->needs(input);
  command
      .add_option("--max-shift", job.registration.max_shift_m, "metres that a frame may be moved")
      ->check(value_of_field(limits, "max_shift_m"))
      ->capture_default_str()
      ->needs(register_option);
  command.add_option("--max-turn", job.registration.max_turn_rad, "radians that it may be turned")
      ->check(value_of_field(limits, "max_turn_rad"))
      ->capture_default_str()
      ->needs(register_option);
  for (const char* of_frames :
       {"--dataset", "--classes", "--first", "--stride", "--max-frames", "--stamp-tolerance"}) {
    command.get_option(of_frames)->needs(input);
  }
}

void SensedArguments::finish() {
  job.sensors.clear();
  for (const std::string& text : sensors) job.sensors.push_back(parse_sensor(text));
  if (dataset.input.empty()) return;
  if (validate(job.heights)) return;
  throw CLI::ValidationError("--max-height",
                             "with --input it must be above " +
                                 number_text(job.heights.ground_tolerance_m) +
                                 ", what is lower is the ground, and at most 100, is " +
                                 number_text(job.heights.max_obstacle_m));
}

Result<std::optional<SensedStackReport>> SensedArguments::fuse_into(GridStack& stack,
                                                                    const MapArchive& map) const {
  if (dataset.input.empty()) return std::optional<SensedStackReport>();
  SensedStackJob asked = job;
  asked.input = dataset.input;
  asked.vocabulary = map.vocabulary;
  asked.heights.ground_m = map.floor.height_m;
  HYPERMAP_ASSIGN_OR_RETURN(asked.dataset, dataset.options());
  asked.dataset.read_color = false;
  asked.dataset.detections.assign(detections.begin(), detections.end());
  if (reference) asked.reference = full_layer_name(stack.options(), *reference);
  const StopCheck stop = stop_when_interrupted();
  HYPERMAP_ASSIGN_OR_RETURN(
      SensedStackReport report,
      fuse_frames(stack,
                  asked,
                  map.provenance,
                  map.classes,
                  [&](std::size_t /*done*/, std::size_t /*total*/) { return !stop(); }));
  if (report.num_detections == 0) print_nothing_detected(asked);
  return std::optional(std::move(report));
}

ExitCode report_skipped(const std::optional<SensedStackReport>& sensed) {
  ExitCode worst = ExitCode::kDone;
  if (!sensed) return worst;
  for (const Error& skipped : sensed->skipped) {
    worst = std::max(worst, report(Finding{Severity::kWarning, skipped}));
  }
  return worst;
}

}  // namespace hypermap::app
