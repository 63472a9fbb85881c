// SPDX-License-Identifier: BSD-3-Clause
#include "mapping_text.hpp"

#include "hypermap/core/base/count_text.hpp"
#include "hypermap/io/archive/archive_floor.hpp"

#include <cstddef>
#include <cstdio>
#include <numbers>

namespace hypermap::app {
namespace {

void print(const PoseCounts& poses) {
  constexpr double kDegrees = 180.0 / std::numbers::pi;
  const std::size_t num_given =
      poses.num_too_few_points + poses.num_ambiguous + poses.num_too_large + poses.num_no_better;
  std::printf(
      "%s refined, by %.1f mm and %.2f degrees on the mean, %.1f mm and %.2f degrees "
      "at most; %zu used as given\n",
      count_text(poses.num_refined, "pose").c_str(),
      poses.mean_translation_m * 1000.0,
      poses.mean_rotation_rad * kDegrees,
      poses.max_translation_m * 1000.0,
      poses.max_rotation_rad * kDegrees,
      num_given);
}

}  // namespace

void print_mapping_report(const MappingReport& report, const MappingJob& job) {
  std::printf("%s, %s, ",
              count_text(report.num_frames, "frame").c_str(),
              count_text(report.num_detections, "detection").c_str());
  if (report.num_filtered > 0)
    std::printf("%zu of them left out by their class, ", report.num_filtered);
  std::printf("%zu of them found in the depth\n", report.num_segments);
  if (job.model && report.num_looks < report.num_frames)
    std::printf("the network looked at %zu of the frames\n", report.num_looks);
  if (report.num_resumed > 0)
    std::printf("went on after the %s of the checkpoint\n",
                count_text(report.num_resumed, "frame").c_str());
  if (job.mapper.refinement.rule != PoseRefinementRule::kNone) print(report.poses);
  if (!report.up.empty()) std::printf("up: %s\n", report.up.c_str());
  if (report.floor != MapFloor{}) {
    std::printf("floor: %s; heights are over it\n", text_of(report.floor).c_str());
  }
  if (!report.registration.empty()) std::printf("depth: %s\n", report.registration.c_str());
  std::printf("%s (and %zu tentative), %zu occupied and %zu free voxels\n",
              count_text(report.num_objects, "object").c_str(),
              report.num_tentative,
              report.leaves.occupied,
              report.leaves.free);
  std::printf("%.1f s, %.1f frames a second; written to %s\n",
              report.seconds.wall,
              static_cast<double>(report.num_frames - report.num_resumed) / report.seconds.wall,
              job.output.c_str());
}

}  // namespace hypermap::app
