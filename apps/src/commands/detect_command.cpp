// SPDX-License-Identifier: BSD-3-Clause
#include "command.hpp"
#include "dataset_arguments.hpp"
#include "hypermap/core/base/count_text.hpp"
#include "hypermap/io/jobs/detection_job.hpp"
#include "network_arguments.hpp"
#include "outputs.hpp"
#include "progress.hpp"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

namespace hypermap::app {
namespace {

struct DetectArguments {
  DatasetArguments dataset;
  NetworkArguments network;
  std::string model;
  std::string output;
  std::vector<std::string> kept_classes;
};

Result<DetectionJobReport> run(const DetectArguments& arguments, const std::string& progress_when) {
  DetectionJob job;
  job.input = arguments.dataset.input;
  job.model = arguments.model;
  job.output = arguments.output;
  HYPERMAP_ASSIGN_OR_RETURN(job.dataset, arguments.dataset.options());
  HYPERMAP_ASSIGN_OR_RETURN(job.detector, arguments.dataset.detector());
  HYPERMAP_ASSIGN_OR_RETURN(job.detector, arguments.network.applied_to(job.detector));
  job.wanted_class_names = arguments.kept_classes;
  Progress progress("detecting", progress_when);
  return run_detection(
      job, [&](std::size_t done, std::size_t total) { return progress.update(done, total); });
}

ExitCode print(const DetectionJobReport& done, const DetectArguments& arguments) {
  std::printf("%s in %s by a network of form %s, written to %s\n",
              count_text(done.num_detections, "detection").c_str(),
              count_text(done.num_frames, "frame").c_str(),
              std::string(name_of(done.network_form)).c_str(),
              arguments.output.c_str());
  if (done.num_filtered > 0)
    std::printf("%s of other classes left out\n",
                count_text(done.num_filtered, "detection").c_str());
  ExitCode worst = ExitCode::kDone;
  for (const Error& skipped : done.skipped)
    worst = std::max(worst, report(Finding{Severity::kWarning, skipped}));
  for (const Finding& finding : done.findings) worst = std::max(worst, report(finding));
  return worst;
}

}  // namespace

void add_detect_command(CLI::App& program, const CommonOptions& common, Action& action) {
  auto arguments = std::make_shared<DetectArguments>();
  CLI::App& command =
      *program.add_subcommand("detect", "Run a detector (ONNX) over a dataset's images");
  arguments->dataset.add_to(command);
  auto* model = command.add_option("--model", arguments->model, "network in ONNX form")->required();
  arguments->network.add_to(command, *model);
  command.add_option("--output", arguments->output, "COCO results; a line an image when .jsonl")
      ->required();
  add_keep_classes(command, arguments->kept_classes);
  show_examples(command,
                {"hypermap detect --input lab --model yolox_nano.onnx --output detections.jsonl"});
  command.callback([arguments, &common, &action] {
    keep_apart("--output",
               arguments->output,
               {arguments->dataset.input,
                arguments->model,
                arguments->dataset.description.value_or(""),
                arguments->dataset.classes.value_or("")},
               MayReplace::kDetections);
    action = [arguments, &common] {
      const auto done = run(*arguments, common.progress);
      return done ? print(*done, *arguments) : report(done.error());
    };
  });
}

}  // namespace hypermap::app
