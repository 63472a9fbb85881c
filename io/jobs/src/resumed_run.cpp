// SPDX-License-Identifier: BSD-3-Clause
#include "resumed_run.hpp"

#include "appended_input.hpp"
#include "run_settings.hpp"

#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

constexpr const char* kOption = "--resume";

Unexpected in_checkpoint(Error error, const MappingJob& job) {
  if (error.file.empty()) error.file = checkpoint_path(job.output).string();
  return Unexpected(std::move(error));
}

Unexpected differs(std::string what, std::string field) {
  return fail(ErrorCode::kInvalidArgument, std::move(what), std::move(field));
}

Result<void> refuse_other_text(const std::string& now,
                               const std::string& before,
                               const std::string& field) {
  if (now == before) return {};
  return differs(
      "is " + printable(now) + ", must be that of the run to go on with, " + printable(before),
      field);
}

/// The newest run of the map and the one before: what both can tell before a frame is mapped.
Result<void> refuse_other_provenance(const Provenance& now, const Provenance& before) {
  HYPERMAP_TRY(refuse_other_text(now.tool, before.tool, "version"));
  HYPERMAP_TRY(refuse_other_text(now.input, before.input, "input"));
  HYPERMAP_TRY(refuse_other_settings(now.options, before.options));
  HYPERMAP_TRY(refuse_other_text(now.world, before.world, "world"));
  if (now.map_from_input.isometry().matrix() == before.map_from_input.isometry().matrix())
    return {};
  return differs("the input's world lies elsewhere in the map than in the run to go on with",
                 "map_from_input");
}

/// Whether the map that a run was appended to is still the one at `output`.
Result<void> refuse_other_map(const MappingRun& run, const SavedRun& saved) {
  auto expected = run.previous ? run.previous->provenance : std::vector<Provenance>{};
  add_run(expected, saved.map.provenance.back());
  if (expected == saved.map.provenance) return {};
  return differs(
      "the map at --output has other runs than the one that the run to go on with was appended to",
      "--append");
}

Result<void> refuse_other_frame(MappingRun& run, const NotedFrame& noted) {
  const std::string name = printable(run.dataset->frame_name(noted.position));
  HYPERMAP_ASSIGN_OR_RETURN(RgbdFrame frame, run.dataset->read(noted.position));
  HYPERMAP_TRY(add_earlier_detections(run, noted.position, frame));
  if (frame_hash(frame) == noted.hash) return {};
  return differs("frame " + name +
                     " has another stamp, camera, pose, depth or detections than in the run to go "
                     "on with",
                 "input");
}

/// Finds out at which frames before the checkpoint the detector looked. Cost: reads them where that
/// depends on their poses.
void repeat_looks(MappingRun& run, std::size_t num_positions) {
  if (!run.detector) return;
  run.earlier_looks.assign(num_positions, false);
  for (std::size_t i = 0; i < num_positions; ++i) {
    if (!run.looks.needs_poses()) {
      run.earlier_looks[i] = run.looks.take(i, {});
    } else if (const auto frame = run.dataset->read(i)) {
      run.earlier_looks[i] = takes_look(run, i, *frame);
    }
  }
}

Result<void> compare_runs(MappingRun& run, const MappingJob& job, const SavedRun& saved) {
  HYPERMAP_TRY(refuse_other_settings(run.settings, saved.checkpoint.settings));
  HYPERMAP_TRY(refuse_other_provenance(provenance_of(run, job), saved.map.provenance.back()));
  HYPERMAP_TRY(refuse_other_map(run, saved));
  if (!(run.classes == saved.map.classes)) {
    return differs("the input has other classes than in the run to go on with", "classes");
  }
  if (!(run.detectors == saved.map.detectors)) {
    return differs("the input has other detectors than in the run to go on with", "detectors");
  }
  const RunCheckpoint& checkpoint = saved.checkpoint;
  if (checkpoint.num_positions > run.dataset->size()) {
    return differs("has " + std::to_string(run.dataset->size()) + " frames, the run had done " +
                       std::to_string(checkpoint.num_positions),
                   "input");
  }
  repeat_looks(run, checkpoint.num_positions);
  HYPERMAP_TRY(refuse_other_frame(run, checkpoint.first));
  return refuse_other_frame(run, checkpoint.last);
}

}  // namespace

Result<SavedRun> load_saved_run(const MappingJob& job) {
  const auto path = checkpoint_path(job.output);
  std::error_code unreadable;
  if (!std::filesystem::exists(path, unreadable) && !unreadable) {
    return in_checkpoint({.code = ErrorCode::kNotFound,
                          .what = "there is no checkpoint to go on from; a run with "
                                  "--checkpoint-every leaves one when it is interrupted",
                          .field = kOption},
                         job);
  }
  HYPERMAP_ASSIGN_OR_RETURN(auto loaded,
                            load_archive(path, job.limits, archive_layer_types(), job.stop));
  MapArchive& map = loaded.value;
  if (map.checkpoint.kind == ValueKind::kNull || !map.octree || map.provenance.empty()) {
    return in_checkpoint({.code = ErrorCode::kUnsupported,
                          .what = "is no checkpoint: it does not say how far its run had come",
                          .field = kOption},
                         job);
  }
  HYPERMAP_ASSIGN_OR_RETURN(auto checkpoint, parse_run_checkpoint(map.checkpoint, path.string()));
  return SavedRun{.map = std::move(map), .checkpoint = std::move(checkpoint)};
}

Result<void> refuse_other_run(MappingRun& run, const MappingJob& job, const SavedRun& saved) {
  auto compared = compare_runs(run, job, saved);
  if (!compared) return in_checkpoint(std::move(compared).error(), job);
  return {};
}

void take_over(MappingRun& run, const SavedRun& saved, MappingReport& report) {
  const RunCheckpoint& checkpoint = saved.checkpoint;
  const Provenance& newest = saved.map.provenance.back();
  run.fingerprint = InputFingerprint(newest.input_hash, newest.first_frame_hash);
  run.next_frame_index = newest.next_frame_index;
  run.first_stamp = newest.first_stamp;
  run.last_stamp = newest.last_stamp;
  run.num_resumed_positions = checkpoint.num_positions;
  run.views = BestViews(saved.map.views);
  run.first = checkpoint.first;
  run.last = checkpoint.last;
  run.skipped_positions = checkpoint.skipped_positions;
  run.checkpoint_of = run.dataset->frame_name(checkpoint.last.position);
  std::vector<Finding> findings = std::move(report.findings);
  std::string up = std::move(report.up);
  std::string registration = std::move(report.registration);
  const NetworkForm network_form = report.network_form;
  report = checkpoint.report;
  report.network_form = network_form;
  report.findings = std::move(findings);
  report.up = std::move(up);
  report.registration = std::move(registration);
  report.num_resumed = report.num_frames;
}

}  // namespace hypermap
