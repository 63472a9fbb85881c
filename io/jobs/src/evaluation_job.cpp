// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/jobs/evaluation_job.hpp"

#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/projection/layers/evaluated_objects.hpp"

#include <variant>
#include <vector>

namespace hypermap {
namespace {

Result<std::vector<EvaluatedObject>> load_evaluated(const std::filesystem::path& path,
                                                    const std::string& layer) {
  HYPERMAP_ASSIGN_OR_RETURN(const auto loaded, load_archive(path));
  const auto found = loaded.value.hypermap.at(layer);
  if (!found) return Unexpected(with_source(found.error(), {path.string()}));
  const auto* semantic = (*found)->content.as<SemanticLayer>();
  if (semantic == nullptr) {
    return Unexpected(Error{ErrorCode::kUnsupported, "is no semantic layer", path.string(), layer});
  }
  return evaluated_objects(*semantic);
}

Result<void> check_classes(const EvaluationReport& report, const EvaluationOptions& options) {
  for (const std::string& name : options.classes) {
    if (report.classes.contains(canonical_class_name(name))) continue;
    return fail(ErrorCode::kNotFound,
                "neither the map nor the truth has an object of class '" + printable(name) + "'",
                "classes");
  }
  return {};
}

}  // namespace

Result<EvaluationOutcome> run_evaluation(const EvaluationJob& job) {
  HYPERMAP_TRY(validate(job.options));
  HYPERMAP_ASSIGN_OR_RETURN(const auto truth, load_evaluated(job.truth, job.layer));
  HYPERMAP_ASSIGN_OR_RETURN(const auto map, load_evaluated(job.map, job.layer));
  EvaluationOutcome outcome{.report = evaluate(map, truth, job.options), .against = std::nullopt};
  HYPERMAP_TRY(check_classes(outcome.report, job.options));
  if (job.against) {
    HYPERMAP_ASSIGN_OR_RETURN(const auto other, load_evaluated(*job.against, job.layer));
    HYPERMAP_ASSIGN_OR_RETURN(outcome.against,
                              compare(outcome.report, evaluate(other, truth, job.options)));
  }
  return outcome;
}

}  // namespace hypermap
