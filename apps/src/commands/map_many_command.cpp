// SPDX-License-Identifier: BSD-3-Clause
#include "command.hpp"
#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/io/jobs/map_many_job.hpp"
#include "hypermap/io/jobs/map_many_ranks.hpp"
#include "load_arguments.hpp"
#include "map_many_text.hpp"
#include "mapping_arguments.hpp"
#include "outputs.hpp"
#include "progress.hpp"
#include "rank_program.hpp"

#include <CLI/Validators.hpp>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace hypermap::app {
namespace {

constexpr const char* kMapSuffix = ".hmap";

struct MapManyArguments {
  std::string list;
  std::string output;
  MappingArguments mapping;
  int num_jobs = 0;
  bool by_ranks = false;
  bool keeps_parts = false;
  bool in_order = false;
  bool force = false;
  bool json = false;

  /// Whether --output is the merged map itself, not a folder for it and its parts.
  [[nodiscard]] bool writes_file() const {
    return is_spelling_of(std::filesystem::path(output).extension().string(), kMapSuffix);
  }
};

/// How many sequences at once, so that each has a thread. A network's threads are those of the
/// process, which no two may set.
int num_workers(const MapManyArguments& arguments, std::size_t num_sequences) {
  if (arguments.mapping.model) return 1;
  const int threads = arguments.mapping.threads();
  const int wanted = arguments.num_jobs > 0 ? arguments.num_jobs : threads;
  const auto most = static_cast<int>(std::min<std::size_t>(num_sequences, 256));
  return std::clamp(wanted, 1, std::max(most, 1));
}

Result<void> make_output_folder(const MapManyArguments& arguments) {
  if (arguments.writes_file()) return {};
  std::error_code failed;
  std::filesystem::create_directories(arguments.output, failed);
  if (!failed) return {};
  return Unexpected(Error{.code = ErrorCode::kIo,
                          .what = "cannot be made: " + failed.message(),
                          .file = arguments.output});
}

/// Of a rank the threads are its own; unless it is told, one.
Result<MapManyJob> many_job_of(const MapManyArguments& arguments, bool is_rank) {
  const std::filesystem::path output = arguments.output;
  const bool writes_file = arguments.writes_file();
  MapManyJob job{
      .output = writes_file ? output : output / "map.hmap",
      .parts = writes_file ? std::filesystem::path(output.string() + ".parts") : output / "parts",
      .keeps_parts = arguments.keeps_parts || !writes_file,
      .force = arguments.force,
      .in_order = arguments.in_order};
  HYPERMAP_ASSIGN_OR_RETURN(job.sequences, read_sequence_list(arguments.list));
  HYPERMAP_ASSIGN_OR_RETURN(job.mapping, arguments.mapping.job());
  if (is_rank) job.mapping.mapper.num_threads = std::max(arguments.mapping.num_threads, 1);
  job.mapping.stop = stop_when_interrupted();
  HYPERMAP_TRY(make_output_folder(arguments));
  return job;
}

ExitCode report_text(const std::string& about, const std::string& text) {
  const std::string what = about.empty() ? text : "sequence " + about + ": " + text;
  return report(Finding{.error = {.what = what}});
}

/// Says what became of it, each failure in a line, and gives the worst of all.
ExitCode report_many(const MapManyReport& done, bool is_strict) {
  ExitCode worst = ExitCode::kDone;
  for (const MappedSequence& sequence : done.sequences) {
    for (const std::string& finding : sequence.findings) {
      worst = std::max(worst, report_text(printable(sequence.name), finding));
    }
  }
  for (const std::string& finding : done.findings)
    worst = std::max(worst, report_text("", finding));
  if (is_strict && worst == ExitCode::kFindings) worst = ExitCode::kRefused;
  for (const MappedSequence& sequence : done.sequences) {
    if (!sequence.error) continue;
    Error error = *sequence.error;
    error.what += " (of sequence " + printable(sequence.name) + ")";
    worst = std::max(worst, report(error));
  }
  return worst;
}

/// By threads of this program.
Result<std::optional<MapManyReport>> run_here(const Result<MapManyJob>& job,
                                              const MapManyArguments& arguments,
                                              const JobProgress& progress) {
  if (!job) return Unexpected(job.error());
  MapManyJob shared = *job;
  const int workers = num_workers(arguments, shared.sequences.size());
  shared.mapping.mapper.num_threads = std::max(arguments.mapping.threads() / workers, 1);
  ThreadCrew crew(static_cast<std::size_t>(workers));
  HYPERMAP_ASSIGN_OR_RETURN(MapManyReport report, run_map_many(shared, crew, progress));
  return std::optional(std::move(report));
}

ExitCode run_map_many_command(const MapManyArguments& arguments,
                              const CommonOptions& common,
                              MessagePort* ranks) {
  const auto job = many_job_of(arguments, ranks != nullptr);
  Result<std::optional<MapManyReport>> done;
  {
    Progress progress("sequences and merges", common.progress);
    const JobProgress tell = [&](std::size_t num_done, std::size_t total) {
      return progress.update(num_done, total);
    };
    done = ranks == nullptr ? run_here(job, arguments, tell)
                            : run_map_many_by_ranks(job, *ranks, tell);
  }
  if (!done) return report(done.error());
  if (!*done) return ExitCode::kDone;  // rank 0 tells of it
  const ExitCode worst = report_many(**done, arguments.mapping.strict);
  arguments.json ? print_map_many_json(**done, *job) : print_map_many(**done, *job);
  return worst;
}

void add_options_of_many(CLI::App& command, MapManyArguments& arguments) {
  command.add_option("list", arguments.list, "YAML file that lists the sequences (docs/MANY.md)")
      ->required();
  command
      .add_option("--output",
                  arguments.output,
                  "archive of the merged map (.hmap), or a folder for map.hmap and the parts")
      ->required();
  auto* jobs =
      command
          .add_option(
              "--jobs",
              arguments.num_jobs,
              "sequences at once, which share --threads; each holds two maps at most; 0: as many "
              "as threads, with --model one")
          ->check(CLI::Range(0, 256).description("0 .. 256"))
          ->capture_default_str();
  command
      .add_flag("--ranks",
                arguments.by_ranks,
                "under mpirun: all ranks do the work, one sequence or merge at a time each, with "
                "--threads (1) of its own; they see the same files")
      ->excludes(jobs);
  command.add_flag("--keep-parts",
                   arguments.keeps_parts,
                   "keep OUTPUT.parts, with a map of each sequence, when all is done");
  command.add_flag("--force",
                   arguments.force,
                   "map and merge all anew, also what an earlier run of the same made");
  command.add_flag("--in-order",
                   arguments.in_order,
                   "the sequences were recorded one after the other as they are listed, whatever "
                   "their stamps say: what a later one saw empty is gone");
  arguments.mapping.dataset.add_reading_to(command);
  arguments.mapping.add_to(command);
  command.add_flag("--json", arguments.json, "one JSON document");
  arguments.mapping.load.add_to(command);
}

}  // namespace

void add_map_many_command(CLI::App& program,
                          const CommonOptions& common,
                          MessagePort* ranks,
                          Action& action) {
  auto arguments = std::make_shared<MapManyArguments>();
  CLI::App& command = *program.add_subcommand(
      "map-many", "Many sequences, mapped side by side and merged; goes on where it was ended");
  add_options_of_many(command, *arguments);
  show_examples(command,
                {"hypermap map-many rooms.yaml --output building.hmap",
                 "hypermap map-many rooms.yaml --output building --jobs 4 --resolution 0.05",
                 "mpirun -n 16 hypermap map-many rooms.yaml --output building --ranks"});
  command.callback([arguments, &common, ranks, &action] {
    arguments->mapping.keep_to_rules();
    std::vector<std::filesystem::path> read = arguments->mapping.files_read();
    read.emplace_back(arguments->list);
    keep_apart("--output", arguments->output, read);
    keep_out_of_datasets("--output", arguments->output);
    action = [arguments, &common, ranks] {
      if (arguments->by_ranks && ranks == nullptr) return report(become_rank().error());
      return run_map_many_command(*arguments, common, ranks);
    };
  });
}

}  // namespace hypermap::app
