// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/jobs/map_many_job.hpp"

#include "hypermap/core/base/caught.hpp"
#include "hypermap/core/base/stop_watch.hpp"
#include "hypermap/io/codec/atomic_file.hpp"
#include "hypermap/io/codec/byte_source.hpp"
#include "many_parts.hpp"

#include <algorithm>
#include <limits>
#include <set>
#include <system_error>
#include <utility>

namespace hypermap {
namespace {

namespace fs = std::filesystem;

Result<void> make_part_folder(const fs::path& folder) {
  std::error_code failed;
  fs::create_directory(folder, failed);
  if (!failed) return {};
  return Unexpected(Error{.code = ErrorCode::kIo,
                          .what = "cannot be made: " + failed.message(),
                          .file = folder.string()});
}

/// What can be told before the first frame.
Result<void> prepare(const MapManyJob& job, const ManyParts& parts) {
  if (job.sequences.empty()) {
    return fail(ErrorCode::kInvalidArgument, "must be one or more, are 0", "sequences");
  }
  HYPERMAP_TRY(validate(job.mapping.mapper));
  HYPERMAP_TRY(check_target(job.output));
  HYPERMAP_TRY(make_part_folder(job.parts));
  return make_part_folder(parts.merging_folder());
}

/// Runs tasks by the crew and counts them on.
class CountedCrew {
 public:
  CountedCrew(WorkCrew& crew, ManyParts& parts, const JobProgress& progress, std::size_t total)
      : crew_(crew), parts_(parts), progress_(progress), total_(total) {}

  Result<std::vector<TaskOutcome>> run(std::span<const CrewTask> tasks, MapManyReport& report) {
    const auto work = [this](std::size_t number) { return parts_.do_task(number); };
    bool goes_on = true;
    const auto done = [&](const TaskOutcome& outcome) {
      const bool is_interrupted = outcome.error && outcome.error->code == ErrorCode::kInterrupted;
      goes_on = goes_on && !is_interrupted && (!progress_ || progress_(++num_done_, total_));
      return goes_on;
    };
    HYPERMAP_ASSIGN_OR_RETURN(auto outcomes, crew_.run(tasks, work, done));
    report.workers.resize(crew_.num_workers());
    for (const TaskOutcome& outcome : outcomes) count(outcome, report.workers[outcome.worker]);
    if (!goes_on) return interrupted();
    return outcomes;
  }
  /// Tasks that need not be done.
  void skip(std::size_t num_tasks) { num_done_ += num_tasks; }

 private:
  static void count(const TaskOutcome& outcome, WorkerReport& worker) {
    ++worker.num_tasks;
    worker.busy_s += outcome.wall_s;
    worker.peak_rss_bytes = std::max(worker.peak_rss_bytes, outcome.peak_rss_bytes);
  }

  WorkCrew& crew_;
  ManyParts& parts_;
  const JobProgress& progress_;
  std::size_t total_;
  std::size_t num_done_ = 0;
};

/// What became of each sequence, as its record tells.
Result<void> describe_sequences(const MapManyJob& job,
                                const ManyParts& parts,
                                std::span<const TaskOutcome> outcomes,
                                MapManyReport& report) {
  for (const TaskOutcome& outcome : outcomes) {
    const PartFiles files = parts.part_files(outcome.number);
    MappedSequence sequence{.name = job.sequences[outcome.number].name,
                            .part = files.part,
                            .note = outcome.note,
                            .error = outcome.error};
    if (!outcome.error) {
      HYPERMAP_ASSIGN_OR_RETURN(PartRecord record, read_part_record(files.record));
      sequence.counts = record.counts;
      sequence.findings = std::move(record.findings);
    }
    report.sequences.push_back(std::move(sequence));
  }
  return {};
}

/// Merges that must be made so that the whole is there: where a map stands, what it was made of is
/// not needed.
std::vector<CrewTask> needed_merges(const ManyParts& parts,
                                    const ManyPlan& plan,
                                    std::size_t num_sequences) {
  std::set<std::size_t> needed;
  std::vector<std::size_t> asked{plan.nodes.size() - 1};
  while (!asked.empty()) {
    const std::size_t index = asked.back();
    asked.pop_back();
    const MergeNode& node = plan.nodes[index];
    if (!parts.must_make(plan, node)) continue;
    needed.insert(index);
    for (const auto& half : {node.left, node.right}) {
      if (half) asked.push_back(*half);
    }
  }
  std::vector<CrewTask> tasks;
  tasks.reserve(needed.size());
  for (const std::size_t index : needed) {
    CrewTask task{.number = num_sequences + index};
    for (const auto& half : {plan.nodes[index].left, plan.nodes[index].right}) {
      if (half && needed.contains(*half)) task.needs.push_back(num_sequences + *half);
    }
    tasks.push_back(std::move(task));
  }
  return tasks;
}

/// The whole of a single sequence is its part, of more that of the last merge.
Result<void> put_in_place(const fs::path& map, const fs::path& output) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::string bytes,
                            read_file(map, std::numeric_limits<std::uint64_t>::max()));
  return write_file_atomically(output, bytes);
}

/// Makes the merges that do not stand.
Result<void> make_merges(const MapManyJob& job,
                         ManyParts& parts,
                         const ManyPlan& plan,
                         CountedCrew& crew,
                         MapManyReport& report) {
  const auto tasks = needed_merges(parts, plan, job.sequences.size());
  crew.skip(plan.nodes.size() - tasks.size());
  HYPERMAP_ASSIGN_OR_RETURN(const auto outcomes, crew.run(tasks, report));
  for (const TaskOutcome& outcome : outcomes) {
    if (outcome.error) return Unexpected(*outcome.error);
  }
  report.num_merges = tasks.size();
  return {};
}

/// Nothing that can fail comes after the output is put in its place.
Result<void> merge_parts(const MapManyJob& job,
                         ManyParts& parts,
                         CountedCrew& crew,
                         MapManyReport& report) {
  if (job.sequences.size() == 1) {
    HYPERMAP_TRY(put_in_place(parts.part_files(0).part, job.output));
    report.merged = report.sequences.front().counts;
    return {};
  }
  HYPERMAP_ASSIGN_OR_RETURN(const ManyPlan* plan, parts.plan());
  const bool is_there = parts.is_in_place(*plan);
  if (!is_there) HYPERMAP_TRY(make_merges(job, parts, *plan, crew, report));
  const PartFiles whole = parts.node_files(plan->nodes.back());
  HYPERMAP_ASSIGN_OR_RETURN(PartRecord record, read_part_record(whole.record));
  if (!is_there) HYPERMAP_TRY(put_in_place(whole.part, job.output));
  report.merged = record.counts;
  for (const MappedSequence& sequence : report.sequences) {
    report.merged->frames += sequence.counts.frames;
    report.merged->skipped += sequence.counts.skipped;
  }
  report.findings = std::move(record.findings);
  return {};
}

/// Files of ours that are needed no more.
std::vector<fs::path> superseded_files(const MapManyJob& job, const ManyParts& parts) {
  const std::size_t num_maps = job.sequences.size();
  std::vector<fs::path> files;
  for (const MergeNode& node : merge_tree(num_maps)) {
    const PartFiles made = parts.node_files(node);
    const bool is_whole = node.end - node.begin == num_maps;
    files.push_back(made.part);
    if (!is_whole || !job.keeps_parts) files.push_back(made.record);
  }
  if (job.keeps_parts) return files;
  for (std::size_t i = 0; i < num_maps; ++i) {
    files.push_back(parts.part_files(i).record);
    files.push_back(parts.part_files(i).part);
  }
  files.push_back(parts.merging_folder());
  files.push_back(job.parts);
  return files;
}

/// The folders only when nothing of others lies in them.
void clear_away(const MapManyJob& job, const ManyParts& parts, MapManyReport& report) {
  for (const fs::path& path : superseded_files(job, parts)) {
    std::error_code failed;
    fs::remove(path, failed);
    if (!failed || failed == std::errc::directory_not_empty) continue;
    report.findings.push_back(to_string({.code = ErrorCode::kIo,
                                         .what = "cannot be removed: " + failed.message(),
                                         .file = path.string()}));
  }
}

Result<MapManyReport> map_and_merge(const MapManyJob& job,
                                    WorkCrew& crew,
                                    const JobProgress& progress) {
  StopWatch watch;
  ManyParts parts(job);
  HYPERMAP_TRY(prepare(job, parts));
  const std::size_t num_sequences = job.sequences.size();
  CountedCrew counted(crew, parts, progress, 2 * num_sequences - 1);
  std::vector<CrewTask> tasks(num_sequences);
  for (std::size_t i = 0; i < num_sequences; ++i) tasks[i].number = i;
  MapManyReport report;
  HYPERMAP_ASSIGN_OR_RETURN(const auto outcomes, counted.run(tasks, report));
  HYPERMAP_TRY(describe_sequences(job, parts, outcomes, report));
  const bool is_whole = std::ranges::none_of(
      report.sequences, [](const MappedSequence& sequence) { return sequence.error.has_value(); });
  if (is_whole) {
    HYPERMAP_TRY(merge_parts(job, parts, counted, report));
    clear_away(job, parts, report);
  }
  report.wall_s = watch.elapsed_s();
  return report;
}

}  // namespace

Result<MapManyReport> run_map_many(const MapManyJob& job,
                                   WorkCrew& crew,
                                   const JobProgress& progress) {
  return guarded(
      ErrorCode::kUnavailable, "the map", [&] { return map_and_merge(job, crew, progress); });
}

}  // namespace hypermap
