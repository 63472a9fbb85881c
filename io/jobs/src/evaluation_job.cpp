// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/jobs/evaluation_job.hpp"

#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/core/base/nearest_name.hpp"
#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/projection/layers/evaluated_objects.hpp"

#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace hypermap {
namespace {

/// The objects of a layer and the frame in which they are given.
struct EvaluatedLayer {
  std::vector<EvaluatedObject> objects;
  std::string frame_id;
};

Result<EvaluatedLayer> load_evaluated(const std::filesystem::path& path, const EvaluationJob& job) {
  HYPERMAP_ASSIGN_OR_RETURN(const auto loaded, load_archive(path, job.limits, {}, job.stop));
  const auto found = loaded.value.hypermap.at(job.layer);
  if (!found) return Unexpected(with_source(found.error(), {path.string()}));
  const auto* semantic = (*found)->content.as<SemanticLayer>();
  if (semantic == nullptr) {
    return Unexpected(
        Error{ErrorCode::kUnsupported, "is no semantic layer", path.string(), job.layer});
  }
  return EvaluatedLayer{evaluated_objects(*semantic), (*found)->info.frame_id};
}

/// The objects of a map's layer. Errors: kUnsupported when its frame is not that of the truth.
Result<std::vector<EvaluatedObject>> load_in_frame(const std::filesystem::path& path,
                                                   const EvaluationJob& job,
                                                   const std::string& frame_id) {
  HYPERMAP_ASSIGN_OR_RETURN(EvaluatedLayer loaded, load_evaluated(path, job));
  if (loaded.frame_id == frame_id) return std::move(loaded.objects);
  return Unexpected(Error{.code = ErrorCode::kUnsupported,
                          .what = "is in frame " + printable(loaded.frame_id) +
                                  ", must be in that of the truth: " + printable(frame_id),
                          .file = path.string(),
                          .field = job.layer});
}

Result<void> check_classes(const EvaluationReport& report,
                           const EvaluationOptions& options,
                           std::span<const EvaluatedObject> truth) {
  for (const std::string& name : options.classes) {
    if (report.classes.contains(canonical_class_name(name))) continue;
    std::vector<std::string> known;
    known.reserve(truth.size());
    for (const EvaluatedObject& object : truth) known.push_back(object.class_name);
    return fail(ErrorCode::kNotFound,
                "neither the map nor the truth has an object of class '" + printable(name) + "'" +
                    did_you_mean(name, known),
                "classes");
  }
  return {};
}

}  // namespace

Result<EvaluationOutcome> run_evaluation(const EvaluationJob& job) {
  HYPERMAP_TRY(validate(job.options));
  HYPERMAP_ASSIGN_OR_RETURN(const auto truth, load_evaluated(job.truth, job));
  HYPERMAP_ASSIGN_OR_RETURN(const auto map, load_in_frame(job.map, job, truth.frame_id));
  EvaluationOutcome outcome{.report = evaluate(map, truth.objects, job.options),
                            .against = std::nullopt};
  HYPERMAP_TRY(check_classes(outcome.report, job.options, truth.objects));
  if (job.against) {
    HYPERMAP_ASSIGN_OR_RETURN(const auto other, load_in_frame(*job.against, job, truth.frame_id));
    HYPERMAP_ASSIGN_OR_RETURN(outcome.against,
                              compare(outcome.report, evaluate(other, truth.objects, job.options)));
  }
  return outcome;
}

}  // namespace hypermap
