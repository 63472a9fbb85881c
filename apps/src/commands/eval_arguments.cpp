// SPDX-License-Identifier: BSD-3-Clause
#include "eval_arguments.hpp"

namespace hypermap::app {
namespace {

std::optional<NamingFrames> naming_frames_of(const EvalArguments& arguments) {
  if (!arguments.input) return std::nullopt;
  NamingFrames frames{.input = *arguments.input};
  if (arguments.description) frames.dataset.description = *arguments.description;
  frames.dataset.detections.assign(arguments.detections.begin(), arguments.detections.end());
  return frames;
}

/// With what all jobs have in common: what names mean, and what reading may cost.
template <class Job>
Result<Job> completed(Job job, const EvalArguments& arguments) {
  HYPERMAP_ASSIGN_OR_RETURN(job.vocabulary, arguments.class_names.given());
  job.limits = arguments.load.limits;
  job.stop = stop_when_interrupted();
  return job;
}

}  // namespace

std::vector<std::filesystem::path> inputs_of(const EvalArguments& arguments) {
  std::vector<std::filesystem::path> inputs{arguments.against.value_or(""),
                                            arguments.cloud.label_names.value_or(""),
                                            arguments.class_names.file};
  inputs.insert(inputs.end(), arguments.maps.begin(), arguments.maps.end());
  inputs.insert(inputs.end(), arguments.truths.begin(), arguments.truths.end());
  for (const auto& [map, truth] : arguments.also) {
    inputs.emplace_back(map);
    inputs.emplace_back(truth);
  }
  return inputs;
}

Result<EvaluationJob> job_of(const EvalArguments& arguments) {
  EvaluationJob job{
      .map = arguments.maps.front(), .truth = arguments.truths.front(), .layer = arguments.layer};
  if (arguments.against) job.against = *arguments.against;
  for (const auto& [map, truth] : arguments.also) job.also.push_back({map, truth});
  job.options.classes = arguments.classes;
  return completed(std::move(job), arguments);
}

Result<CloudEvaluationJob> cloud_job_of(const EvalArguments& arguments) {
  return completed(
      CloudEvaluationJob{.map = arguments.maps.front(), .cloud = arguments.truths.front()},
      arguments);
}

Result<ListedEvaluationJob> listed_job_of(const EvalArguments& arguments) {
  ListedEvaluationJob job{
      .map = arguments.maps.front(), .truth = arguments.truths.front(), .layer = arguments.layer};
  job.frames = naming_frames_of(arguments);
  return completed(std::move(job), arguments);
}

Result<RatesJob> rates_job_of(const EvalArguments& arguments) {
  RatesJob job{.frames = naming_frames_of(arguments), .layer = arguments.layer};
  job.maps.assign(arguments.maps.begin(), arguments.maps.end());
  job.truths.assign(arguments.truths.begin(), arguments.truths.end());
  job.options.classes = arguments.classes;
  return completed(std::move(job), arguments);
}

Result<void> check_options_of_runs(const EvalArguments& arguments) {
  if (arguments.maps.size() == 1 && arguments.truths.size() == 1) return {};
  for (const auto& [is_given, option] :
       {std::pair(arguments.against.has_value(), "--against"),
        std::pair(!arguments.also.empty(), "--also"),
        std::pair(arguments.reliability.has_value(), "--reliability"),
        std::pair(arguments.image.has_value(), "--image")}) {
    if (is_given) return fail(ErrorCode::kInvalidArgument, "needs a single map", option);
  }
  return {};
}

Result<void> check_options_of(const EvalArguments& arguments, FileKind truth) {
  const auto refused = [](const char* option, const char* needed) {
    return fail(ErrorCode::kInvalidArgument, std::string("needs ") + needed + " as truth", option);
  };
  const bool is_list = truth == FileKind::kTruth;
  const bool is_cloud = truth == FileKind::kCloud;
  if (!is_cloud && arguments.cloud.label_names) return refused("--labels", "a cloud");
  if (!is_cloud && arguments.cloud.placement) return refused("--transform", "a cloud");
  if (!is_list && arguments.input) return refused("--input", "a list of things");
  if (!is_list && !is_cloud) return {};
  constexpr const char* kArchive = "an archive";
  if (arguments.against) return refused("--against", kArchive);
  if (!arguments.also.empty()) return refused("--also", kArchive);
  if (!arguments.classes.empty()) return refused("--classes", kArchive);
  if (arguments.reliability) return refused("--reliability", kArchive);
  if (arguments.image) return refused("--image", kArchive);
  return {};
}

}  // namespace hypermap::app
