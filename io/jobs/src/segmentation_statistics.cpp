// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/jobs/segmentation_statistics.hpp"

#include "hypermap/core/segmentation/segmentation_trace.hpp"
#include "hypermap/io/codec/bounded_json.hpp"
#include "hypermap/io/codec/json_text.hpp"

#include <algorithm>

namespace hypermap {
namespace {

/// What was measured of one step.
struct StepSamples {
  std::string name;
  std::vector<double> seconds;
  std::vector<double> points;
};

StepSamples& samples_of(std::vector<StepSamples>& steps, const std::string& name) {
  const auto found = std::ranges::find(steps, name, &StepSamples::name);
  if (found != steps.end()) return *found;
  return steps.emplace_back(StepSamples{name, {}, {}});
}

std::string five_json(const FiveNumbers& numbers) {
  return json_object({{"min", json_number(numbers.min)},
                      {"lower", json_number(numbers.lower)},
                      {"median", json_number(numbers.median)},
                      {"upper", json_number(numbers.upper)},
                      {"max", json_number(numbers.max)}});
}

}  // namespace

Result<SegmentationStatistics> segmentation_statistics(const DatasetReader& dataset,
                                                       const GeometricSegmentationOptions& options,
                                                       const JobProgress& progress) {
  SegmentationStatistics statistics;
  std::vector<StepSamples> steps;
  std::vector<double> whole;
  for (std::size_t i = 0; i < dataset.size(); ++i) {
    if (progress && !progress(i, dataset.size())) {
      return fail(ErrorCode::kInterrupted, "the segmentation was ended");
    }
    const auto frame = dataset.read(i);
    ++(frame ? statistics.num_frames : statistics.num_skipped);
    if (!frame) continue;
    for (const Detection& detection : frame->detections) {
      const SegmentationTrace trace = trace_segmentation(*frame, detection, options);
      ++statistics.num_detections;
      statistics.num_segments += trace.segment ? 1U : 0U;
      double seconds = 0.0;
      for (const SegmentationStep& step : trace.steps) {
        StepSamples& samples = samples_of(steps, step.name);
        samples.seconds.push_back(step.seconds);
        samples.points.push_back(static_cast<double>(step.num_points));
        seconds += step.seconds;
      }
      whole.push_back(seconds);
    }
  }
  for (const StepSamples& samples : steps) {
    statistics.steps.push_back({.name = samples.name,
                                .num_detections = samples.seconds.size(),
                                .seconds = five_numbers(samples.seconds),
                                .points = five_numbers(samples.points)});
  }
  statistics.seconds = five_numbers(whole);
  return statistics;
}

std::string to_json(const SegmentationStatistics& statistics) {
  const std::string steps = json_array(statistics.steps, [](const StepStatistics& step) {
    return json_object({{"name", json_quoted(step.name)},
                        {"detections", std::to_string(step.num_detections)},
                        {"seconds", five_json(step.seconds)},
                        {"points", five_json(step.points)}});
  });
  return json_object({{"frames", std::to_string(statistics.num_frames)},
                      {"frames_skipped", std::to_string(statistics.num_skipped)},
                      {"detections", std::to_string(statistics.num_detections)},
                      {"segments", std::to_string(statistics.num_segments)},
                      {"seconds", five_json(statistics.seconds)},
                      {"steps", steps}});
}

}  // namespace hypermap
