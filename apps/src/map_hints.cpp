// SPDX-License-Identifier: BSD-3-Clause
#include "map_hints.hpp"

#include "command.hpp"
#include "dataset_arguments.hpp"

#include <cstdio>
#include <filesystem>
#include <string>
#include <system_error>

namespace hypermap::app {
namespace {

/// Says before the work what takes longer than a camera's next frame does.
void warn_of_slow_options(const MappingJob& job) {
  if (job.mapper.objects.segmentation.policy != SegmentationPolicy::kRegionGrowing) return;
  std::fprintf(
      stderr,
      "map: segmentation by region growing takes a tenth of a second or more for each frame\n");
}

bool is_checkpoint_there(const MappingJob& job) {
  std::error_code unreadable;
  return std::filesystem::is_regular_file(checkpoint_path(job.output), unreadable);
}

/// Says before the work what becomes of the checkpoint of a run that was interrupted.
void warn_of_old_checkpoint(const MappingJob& job) {
  if (job.resume || !is_checkpoint_there(job)) return;
  std::fprintf(stderr,
               "map: %s of an earlier run is there: --resume would go on from it; %s\n",
               printable(checkpoint_path(job.output).string(), 500).c_str(),
               job.checkpoint_every > 0 ? "the first checkpoint of this run replaces it"
                                        : "this run leaves it");
}

}  // namespace

void print_hints_before(const MappingJob& job) {
  warn_of_slow_options(job);
  warn_of_old_checkpoint(job);
}

void print_hint_at_resuming(const Error& error, const MappingJob& job) {
  const bool is_saving = job.resume || job.checkpoint_every > 0;
  if (exit_code_of(error) != ExitCode::kSystem || !is_saving || !is_checkpoint_there(job)) return;
  std::fprintf(stderr,
               "map: --resume goes on from %s\n",
               printable(checkpoint_path(job.output).string(), 500).c_str());
}

void print_hints_after(const MappingReport& report, const MappingJob& job) {
  if (job.model || report.num_detections > 0) return;
  if (!job.dataset.detections.empty()) {
    std::fprintf(stderr, "map: the files of --detections name nothing in the frames mapped\n");
    return;
  }
  std::fprintf(stderr,
               "map: nothing was detected: --detections FILE or --model FILE names objects\n");
  for (const std::string& name : unused_detections(job.input)) {
    std::fprintf(
        stderr, "map: not used: %s in the input; --detections names it\n", printable(name).c_str());
  }
}

}  // namespace hypermap::app
