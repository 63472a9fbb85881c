// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/jobs/mapping_job.hpp"

#include "appended_input.hpp"
#include "frame_stream.hpp"
#include "hypermap/core/base/caught.hpp"
#include "hypermap/core/base/stop_watch.hpp"
#include "map_rescue.hpp"
#include "mapped_frame.hpp"
#include "mapping_counts.hpp"
#include "mapping_run.hpp"
#include "outlying_regions.hpp"
#include "peak_memory.hpp"
#include "refined_frames.hpp"

#include <algorithm>
#include <iterator>
#include <new>
#include <system_error>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

/// What is wrong with one frame, named; what is wrong with the machine ends the job.
bool spares_other_frames(const Error& error) {
  return error.code != ErrorCode::kOutOfMemory && error.code != ErrorCode::kUnavailable;
}

Error about(Error error, const std::string& frame_name) {
  if (error.file.empty()) error.file = frame_name;
  return error;
}

/// An absent file is the dataset's fault, kNotFound.
bool is_systems_fault(const Error& error) {
  return error.code == ErrorCode::kIo;
}

/// Refuses a map of too few frames as soon as it is sure to be one.
/// Errors: kIo when the system took one of them, else kLimit.
Result<void> check_losses(const MappingReport& report, const MappingJob& job, std::size_t total) {
  const auto allowed = job.max_skipped_share * static_cast<double>(total);
  const bool is_any_left = report.skipped.size() < total;
  if (is_any_left && static_cast<double>(report.skipped.size()) <= allowed) return {};
  const auto worst = std::find_if(report.skipped.begin(), report.skipped.end(), is_systems_fault);
  const bool is_systems = worst != report.skipped.end();
  Error error{.code = is_systems ? ErrorCode::kIo : ErrorCode::kLimit,
              .what = std::to_string(report.skipped.size()) + " of " + std::to_string(total) +
                      " frames could not be used, more than the share of " +
                      std::to_string(job.max_skipped_share) + " that is allowed",
              .file = job.input.string()};
  if (is_systems) error.what += "; the system failed: " + to_string(*worst);
  if (!is_systems && !report.skipped.empty())
    error.what += "; the first: " + to_string(report.skipped.front());
  return Unexpected(std::move(error));
}

SaveOptions save_options(const MappingJob& job) {
  return {.limits = job.limits, .num_threads = job.mapper.num_threads};
}

/// Derives the layers, saves all to `path` and returns what became of the layers.
Result<DerivedLayers> save_map(MapArchive& archive,
                               const std::filesystem::path& path,
                               const MappingJob& job,
                               MappingSeconds& seconds) {
  StopWatch watch;
  HYPERMAP_ASSIGN_OR_RETURN(DerivedLayers derived,
                            derive_layers(archive, job.mapper.objects, job.layers));
  seconds.project += watch.lap();
  HYPERMAP_TRY(save_archive(archive, path, save_options(job)));
  seconds.write += watch.lap();
  return derived;
}

/// What is to be said of the layers.
std::vector<Finding> findings_of_layers(const DerivedLayers& derived,
                                        const MappingRun& run,
                                        const MappingJob& job) {
  if (derived.outlying.empty()) return findings_of(derived, {}, *run.dataset, job.output);
  return findings_of(derived, all_places(run), *run.dataset, job.output);
}

/// What is thrown ends no run without its map being rescued.
template <class Work>
auto guarded_run(const Work& work) -> decltype(work()) {
  return guarded(ErrorCode::kUnavailable, "the map", work);
}

/// The run goes on whatever becomes of it; the first failure is said. `num_positions`: frames of
/// the input that were mapped or skipped.
void save_checkpoint(MappingRun& run,
                     const MappingJob& job,
                     MappingReport& report,
                     std::size_t num_positions) {
  const std::string frame_name = run.dataset->frame_name(num_positions - 1);
  const auto saved = guarded_run([&] {
    MapArchive archive = map_of(run, job);
    archive.checkpoint = to_tree({.num_positions = num_positions,
                                  .first = run.first,
                                  .last = run.last,
                                  .skipped_positions = run.skipped_positions,
                                  .report = report,
                                  .settings = run.settings});
    return save_map(archive, checkpoint_path(job.output), job, report.seconds);
  });
  if (saved) {
    run.checkpoint_of = frame_name;
  } else if (!run.checkpoint_failed) {
    run.checkpoint_failed = true;
    Error error = about(saved.error(), checkpoint_path(job.output).string());
    error.what = "no checkpoint after " + printable(frame_name) + ": " + error.what;
    report.findings.push_back({Severity::kWarning, std::move(error)});
  }
}

/// Where refinement begins: the poses of frames after a checkpoint depend on those before it.
std::size_t first_position(const MappingRun& run, const MappingJob& job) {
  const bool is_refined = job.mapper.refinement.rule != PoseRefinementRule::kNone;
  return is_refined ? 0 : run.num_resumed_positions;
}

/// A frame before the checkpoint: the map has it at this pose, if it has it.
Result<void> count_resumed(const MappingRun& run,
                           std::size_t position,
                           const Result<PosedFrame>& posed,
                           MappingReport& report) {
  const bool is_skipped = std::ranges::binary_search(run.skipped_positions, position);
  if (posed && !is_skipped) count(posed->correction, report.poses);
  const bool is_lost = !posed && (!is_skipped || !spares_other_frames(posed.error()));
  return is_lost ? Unexpected(about(posed.error(), run.dataset->frame_name(position)))
                 : Result<void>();
}

Result<void> map_frames(MappingRun& run,
                        const MappingJob& job,
                        MappingReport& report,
                        const JobProgress& progress) {
  const std::size_t begin = first_position(run, job);
  const std::size_t total = run.dataset->size();
  const auto prepare = [&run](std::size_t position) { return prepare_frame(run, position); };
  const auto left_out = [&run](const RgbdFrame& frame) {
    return run.mapper->transient_pixels(frame.camera, frame.detections);
  };
  FrameStream stream(prepare, begin, total, job.mapper.num_threads > 1);
  RefinedFrames frames(stream, total - begin, job.mapper, left_out);
  for (std::size_t i = begin; i < total; ++i) {
    auto frame = frames.next();
    if (i < run.num_resumed_positions) {
      HYPERMAP_TRY(count_resumed(run, i, frame, report));
      if (progress && !progress(i + 1, total)) return interrupted();
      continue;
    }
    const double wait_s = frame ? frame->wait_s : 0.0;
    const double refine_s = frame ? frame->refine_s : 0.0;
    report.seconds.wait += wait_s;
    StopWatch watch;
    const auto done = map_frame(run, i, std::move(frame), job, report);
    if (done) {
      report.frame_times.add(FrameStage::kWait, wait_s);
      report.frame_times.add(FrameStage::kFrame, wait_s + refine_s + watch.lap());
      count(*done, report);
    } else if (spares_other_frames(done.error())) {
      report.skipped.push_back(about(done.error(), run.dataset->frame_name(i)));
      run.skipped_positions.push_back(i);
      HYPERMAP_TRY(check_losses(report, job, total));
    } else {
      return Unexpected(about(done.error(), run.dataset->frame_name(i)));
    }
    const bool is_due = done && job.checkpoint_every > 0 && i + 1 < total &&
                        report.num_frames % job.checkpoint_every == 0;
    if (is_due) save_checkpoint(run, job, report, i + 1);
    if (progress && !progress(i + 1, total)) return interrupted();
  }
  return {};
}

/// Views were asked for, and no frame had what they are made of.
void note_absent_color(const MappingRun& run, const MappingJob& job, MappingReport& report) {
  if (!job.keep_views || run.views.saw_color() || report.num_frames == report.num_resumed) return;
  report.findings.push_back({Severity::kWarning,
                             {.code = ErrorCode::kNotFound,
                              .what = "no frame has a colour image: there is no view of any object",
                              .file = job.input.string(),
                              .field = "views"}});
}

/// The error, and where the newest checkpoint is.
Error naming_checkpoint(Error error, const MappingRun& run, const MappingJob& job) {
  if (!run.checkpoint_of) return error;
  error.what += "; the map up to " + printable(*run.checkpoint_of) + " is in " +
                printable(checkpoint_path(job.output).string(), 500);
  return error;
}

/// Why the run ended before its last frame, and where what it mapped is, if anywhere. Who
/// interrupts it wants nothing written, nor is a map of too few frames.
Error ended_early(Error error,
                  const MappingRun& run,
                  const MappingJob& job,
                  const MappingReport& report) {
  if (!spares_other_frames(error) && report.num_frames > report.num_resumed) {
    error = with_rescue(std::move(error), map_of(run, job), job.output, save_options(job));
  }
  return naming_checkpoint(std::move(error), run, job);
}

/// The saved map supersedes its checkpoints.
void remove_checkpoint(const MappingJob& job, MappingReport& report) {
  std::error_code failed;
  const bool is_there = std::filesystem::is_regular_file(checkpoint_path(job.output), failed);
  if ((job.checkpoint_every == 0 && !job.resume) || !is_there) return;
  std::filesystem::remove(checkpoint_path(job.output), failed);
  if (!failed) return;
  report.findings.push_back({Severity::kWarning,
                             {.code = ErrorCode::kIo,
                              .what = "cannot be removed: " + failed.message(),
                              .file = checkpoint_path(job.output).string()}});
}

void describe(const MapArchive& archive, const MappingJob& job, MappingReport& report) {
  const auto confirmed = confirmed_objects(archive.objects, job.mapper.objects.confirmation);
  report.num_objects = confirmed.size();
  report.num_tentative = archive.objects.size() - confirmed.size();
  report.leaves = archive.octree->num_leaves();
  report.floor = archive.floor;
  report.num_threads = job.mapper.num_threads;
  report.peak_rss_bytes = peak_rss_bytes();
}

}  // namespace

std::filesystem::path checkpoint_path(const std::filesystem::path& output) {
  return output.string() + ".checkpoint";
}

std::filesystem::path rescue_path(const std::filesystem::path& output) {
  return output.string() + ".rescue";
}

Result<MappingReport> run_mapping(const MappingJob& job, const JobProgress& progress) {
  MappingReport report;
  StopWatch whole;
  HYPERMAP_ASSIGN_OR_RETURN(MappingRun run, open_run(job, report));
  auto mapped = guarded_run([&] { return map_frames(run, job, report, progress); });
  if (!mapped) return Unexpected(ended_early(std::move(mapped).error(), run, job, report));
  if (run.previous && !job.force) {
    HYPERMAP_TRY(refuse_input_hash(run.fingerprint.text(), run.previous->provenance));
  }
  MapArchive archive = map_of(run, job);
  auto derived = guarded_run([&] { return save_map(archive, job.output, job, report.seconds); });
  if (!derived) {
    Error error = with_rescue(std::move(derived).error(), archive, job.output, save_options(job));
    return Unexpected(naming_checkpoint(std::move(error), run, job));
  }
  auto findings = findings_of_layers(*derived, run, job);
  std::move(findings.begin(), findings.end(), std::back_inserter(report.findings));
  note_absent_color(run, job, report);
  remove_checkpoint(job, report);
  describe(archive, job, report);
  report.seconds.wall = whole.lap();
  return report;
}

}  // namespace hypermap
