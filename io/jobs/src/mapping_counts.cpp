// SPDX-License-Identifier: BSD-3-Clause
#include "mapping_counts.hpp"

#include <algorithm>

namespace hypermap {

void count(const PoseCorrection& pose, PoseCounts& counts) {
  switch (pose.outcome) {
    case PoseOutcome::kGiven:
      return;
    case PoseOutcome::kTooFewPoints:
      ++counts.num_too_few_points;
      return;
    case PoseOutcome::kAmbiguous:
      ++counts.num_ambiguous;
      return;
    case PoseOutcome::kTooLarge:
      ++counts.num_too_large;
      return;
    case PoseOutcome::kNoBetter:
      ++counts.num_no_better;
      return;
    case PoseOutcome::kRefined:
      break;
  }
  const auto share = 1.0 / static_cast<double>(++counts.num_refined);
  counts.mean_translation_m += share * (pose.translation_m - counts.mean_translation_m);
  counts.mean_rotation_rad += share * (pose.rotation_rad - counts.mean_rotation_rad);
  counts.max_translation_m = std::max(counts.max_translation_m, pose.translation_m);
  counts.max_rotation_rad = std::max(counts.max_rotation_rad, pose.rotation_rad);
}

void count(const FrameReport& frame, MappingReport& report) {
  count(frame.pose, report.poses);
  ++report.num_frames;
  report.num_detections += frame.num_detections;
  report.num_filtered += frame.num_transient;
  report.num_segments += frame.num_segments;
  report.num_visibility_skipped += frame.visibility_evaluated ? 0U : 1U;
  report.points.num_hits += frame.integration.num_hits;
  report.points.num_beyond_range += frame.integration.num_beyond_range;
  report.points.num_not_measured += frame.integration.num_not_measured;
  report.points.num_not_finite += frame.integration.num_not_finite;
  report.points.num_outside_volume += frame.integration.num_outside_volume;
  report.points.num_transient += frame.integration.num_transient;
  report.seconds.smooth += frame.seconds.smooth;
  report.seconds.refine += frame.seconds.refine;
  report.seconds.segment += frame.seconds.segment;
  report.seconds.associate += frame.seconds.associate;
  report.seconds.integrate += frame.seconds.integrate;
  report.seconds.visibility += frame.seconds.visibility;
  report.frame_times.add(FrameStage::kSmooth, frame.seconds.smooth);
  report.frame_times.add(FrameStage::kRefine, frame.seconds.refine);
  report.frame_times.add(FrameStage::kSegment, frame.seconds.segment);
  report.frame_times.add(FrameStage::kAssociate, frame.seconds.associate);
  report.frame_times.add(FrameStage::kIntegrate, frame.seconds.integrate);
  report.frame_times.add(FrameStage::kVisibility, frame.seconds.visibility);
}

}  // namespace hypermap
