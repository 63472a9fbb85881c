// SPDX-License-Identifier: BSD-3-Clause
#include "command.hpp"
#include "dataset_arguments.hpp"
#include "hypermap/core/base/count_text.hpp"
#include "hypermap/io/jobs/combiner_job.hpp"
#include "number_lists.hpp"
#include "outputs.hpp"
#include "progress.hpp"
#include "tables.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace hypermap::app {
namespace {

struct CombineArguments {
  DatasetArguments dataset;
  CombinerJob job;
  DetectionFiles detections;
};

Result<CombinerJobReport> run(const CombineArguments& arguments, const std::string& progress_when) {
  CombinerJob job = arguments.job;
  job.input = arguments.dataset.input;
  HYPERMAP_ASSIGN_OR_RETURN(job.dataset, arguments.dataset.options());
  arguments.detections.put_into(job.dataset);
  Progress progress("reading", progress_when);
  return train_combiner_job(
      job, [&](std::size_t done, std::size_t total) { return progress.update(done, total); });
}

ExitCode print(const CombinerJobReport& done, const CombineArguments& arguments) {
  Table table({"named by", "right", "of", "share"});
  for (const NamingScore& score : done.scores) {
    const double share = score.num_named == 0 ? 0.0
                                              : static_cast<double>(score.num_right) /
                                                    static_cast<double>(score.num_named);
    table.add({printable(score.name),
               std::to_string(score.num_right),
               std::to_string(score.num_named),
               fixed(share, 3)});
  }
  std::printf("%s", table.text().c_str());
  std::printf(
      "%zu classes learnt from %s in %s; the table counts %s of every fifth frame, which "
      "were held out; %s without a label; written to %s\n",
      done.classes.size(),
      count_text(done.num_examples, "example").c_str(),
      count_text(done.num_frames, "frame").c_str(),
      count_text(done.num_held_out, "example").c_str(),
      count_text(done.num_unlabelled, "detection").c_str(),
      arguments.job.output.c_str());
  ExitCode worst = ExitCode::kDone;
  for (const Error& skipped : done.skipped)
    worst = std::max(worst, report(Finding{Severity::kWarning, skipped}));
  for (const Finding& finding : done.findings) worst = std::max(worst, report(finding));
  return worst;
}

}  // namespace

void add_combine_command(CLI::App& program, const CommonOptions& common, Action& action) {
  auto arguments = std::make_shared<CombineArguments>();
  CLI::App& command = *program.add_subcommand(
      "combine", "Learn from labelled frames how to combine detectors, for map --combiner");
  arguments->dataset.add_to(command);
  arguments->detections.add_to(command).required();
  command
      .add_option("--labels",
                  arguments->job.labels,
                  "detections file of what is there: boxes with their true classes")
      ->required();
  command.add_option("--output", arguments->job.output, "JSON file to write")->required();
  command
      .add_option("--min-overlap",
                  arguments->job.min_overlap,
                  "boxes that overlap so much (intersection over union) are of one thing")
      ->check(number_in(0.1, 1.0))
      ->capture_default_str();
  show_examples(command,
                {"hypermap combine --input lab --detections yolo.jsonl --detections ssd.jsonl "
                 "--labels true.jsonl --output combiner.json"});
  command.callback([arguments, &common, &action] {
    arguments->detections.keep_to_files();
    std::vector<std::filesystem::path> read{arguments->dataset.input,
                                            arguments->dataset.description.value_or(""),
                                            arguments->dataset.classes.value_or(""),
                                            arguments->job.labels};
    const auto& detections = arguments->detections.files;
    read.insert(read.end(), detections.begin(), detections.end());
    keep_apart("--output", arguments->job.output, read);
    action = [arguments, &common] {
      const auto done = run(*arguments, common.progress);
      return done ? print(*done, *arguments) : report(done.error());
    };
  });
}

}  // namespace hypermap::app
