// SPDX-License-Identifier: BSD-3-Clause
#include "choices.hpp"
#include "command.hpp"
#include "data_dir.hpp"
#include "hypermap/io/simulator/scene_file.hpp"
#include "hypermap/io/simulator/simulator.hpp"
#include "option_flags.hpp"
#include "progress.hpp"

#include <CLI/Validators.hpp>

#include <cstdio>
#include <memory>

namespace hypermap::app {
namespace {

struct SimulateArguments {
  std::string scene = "laboratory";
  std::string output;
  std::string detector = "noisy";
  SimulationOptions simulation;
};

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
  std::printf("%zu frames and %zu detections of %zu objects in %s\n",
              report.num_frames,
              report.num_detections,
              report.objects.size(),
              output.c_str());
  std::printf("%zu objects count in evaluations; not counted:\n", num_counted);
  for (const SimulatedTruth& truth : report.objects) {
    if (truth.exclusion_reason.empty()) continue;
    std::printf(
        "  %-16s %s\n", printable(truth.name).c_str(), printable(truth.exclusion_reason).c_str());
  }
}

}  // namespace

void add_simulate_command(CLI::App& program, const CommonOptions& common, Action& action) {
  auto arguments = std::make_shared<SimulateArguments>();
  const OptionTable& table = option_table(arguments->simulation);
  CLI::App& command = *program.add_subcommand(
      "simulate", "Render a posed RGB-D sequence of a furnished scene, with detections and truth");
  command.add_option("--scene", arguments->scene, "laboratory, floor, or a scene file")
      ->capture_default_str();
  command.add_option("--output", arguments->output, "folder to make: a TUM RGB-D dataset")
      ->required();
  command.add_option("--frames", arguments->simulation.num_frames, "frames along the camera's way")
      ->check(value_of_field(table, "num_frames"))
      ->capture_default_str();
  command.add_option("--seed", arguments->simulation.seed, "of arrangement, noise and detector")
      ->check(CLI::NonNegativeNumber.description("at least 0"))
      ->capture_default_str();
  command.add_option("--detector", arguments->detector, "how well it sees")
      ->transform(one_of({"perfect", "noisy"}))
      ->capture_default_str();
  command
      .add_option("--pose-noise", arguments->simulation.pose_noise, "drift of the recorded poses")
      ->check(value_of_field(table, "pose_noise"))
      ->capture_default_str();
  command.add_option("--threads", arguments->simulation.num_threads, "0: one for each core")
      ->check(value_of_field(table, "num_threads"))
      ->capture_default_str();
  show_examples(command, {"hypermap simulate --scene laboratory --frames 200 --output lab"});
  command.callback([arguments, &common, &action] {
    action = [arguments, &common] {
      arguments->simulation.detector.noisy = arguments->detector == "noisy";
      const auto report_or_error = run(*arguments, common.progress);
      if (!report_or_error) return report(report_or_error.error());
      print(*report_or_error, arguments->output);
      return ExitCode::kDone;
    };
  });
}

}  // namespace hypermap::app
