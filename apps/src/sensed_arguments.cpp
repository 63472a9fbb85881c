// SPDX-License-Identifier: BSD-3-Clause
#include "sensed_arguments.hpp"

#include "load_arguments.hpp"
#include "number_lists.hpp"
#include "option_flags.hpp"
#include "stack_arguments.hpp"

#include <CLI/Validators.hpp>

#include <algorithm>

namespace hypermap::app {
namespace {

FrameSensor parse_sensor(const std::string& text) {
  const std::size_t mark = text.rfind('=');
  const auto names = frame_sensor_names();
  const auto name = std::ranges::find(names, text.substr(0, mark));
  const auto weight =
      mark == std::string::npos ? std::optional(1.0) : finite_number(text.substr(mark + 1));
  if (name != names.end() && weight) {
    return {.kind = static_cast<FrameSensorKind>(name - names.begin()), .weight = *weight};
  }
  throw CLI::ValidationError(
      "--sensor",
      "must be depth or detections, or one of them with =WEIGHT, is '" + printable(text) + "'");
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
  CLI::Option* register_option =
      command
          .add_option("--register",
                      reference,
                      "layer of the stack that each frame's depth is registered to before it is "
                      "fused")
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
}

Result<std::optional<SensedStackReport>> SensedArguments::fuse_into(GridStack& stack,
                                                                    const MapArchive& map) const {
  if (dataset.input.empty()) return std::optional<SensedStackReport>();
  SensedStackJob asked = job;
  asked.input = dataset.input;
  HYPERMAP_ASSIGN_OR_RETURN(asked.dataset, dataset.options());
  asked.dataset.read_color = false;
  if (reference) asked.reference = full_layer_name(stack.options(), *reference);
  const StopCheck stop = stop_when_interrupted();
  HYPERMAP_ASSIGN_OR_RETURN(
      SensedStackReport report,
      fuse_frames(stack,
                  asked,
                  map.provenance,
                  map.classes,
                  [&](std::size_t /*done*/, std::size_t /*total*/) { return !stop(); }));
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
