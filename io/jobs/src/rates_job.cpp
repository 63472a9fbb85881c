// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/jobs/rates_job.hpp"

#include "evaluated_archive.hpp"
#include "evaluated_voxels.hpp"
#include "hypermap/core/base/count_text.hpp"
#include "hypermap/io/archive/listed_instances_file.hpp"
#include "hypermap/io/codec/file_kind.hpp"
#include "listed_evaluation.hpp"
#include "rated_runs.hpp"

#include <algorithm>
#include <iterator>
#include <utility>
#include <variant>

namespace hypermap {
namespace {

/// A truth of either kind.
using LoadedTruth = std::variant<EvaluatedArchive, ListedInstances>;

EvaluatedSource source_of(const RatesJob& job) {
  return {.layer = job.layer, .limits = job.limits, .stop = job.stop};
}

bool is_list(const std::filesystem::path& truth) {
  return find_file_kind(truth) == FileKind::kTruth;
}

Result<void> check_job(const RatesJob& job) {
  HYPERMAP_TRY(validate(job.options));
  HYPERMAP_TRY(validate(job.comparison));
  if (job.maps.empty()) return fail(ErrorCode::kInvalidArgument, "must be at least one", "maps");
  if (job.truths.size() != 1 && job.truths.size() != job.maps.size()) {
    return fail(ErrorCode::kInvalidArgument,
                "must be one, or one for each of " + count_text(job.maps.size(), "map") + "; are " +
                    std::to_string(job.truths.size()),
                "truths");
  }
  const bool has_list = std::any_of(job.truths.begin(), job.truths.end(), is_list);
  if (job.frames && (!has_list || job.truths.size() > 1)) {
    return fail(
        ErrorCode::kInvalidArgument, "needs one list of things as truth of all maps", "frames");
  }
  if (has_list && !job.options.classes.empty())
    return fail(ErrorCode::kInvalidArgument, "needs archives as truths", "classes");
  return {};
}

Result<LoadedTruth> load_truth(const std::filesystem::path& path, const RatesJob& job) {
  if (is_list(path)) {
    HYPERMAP_ASSIGN_OR_RETURN(ListedInstances listed, load_listed_instances(path));
    return LoadedTruth(std::move(listed));
  }
  HYPERMAP_ASSIGN_OR_RETURN(EvaluatedArchive truth, load_evaluated(path, source_of(job)));
  return LoadedTruth(std::move(truth));
}

Result<RatedRun> rated_against_list(const std::filesystem::path& map_path,
                                    const std::filesystem::path& truth_path,
                                    const ListedInstances& listed,
                                    const RatesJob& job,
                                    std::vector<Finding>& findings) {
  HYPERMAP_ASSIGN_OR_RETURN(const EvaluatedArchive map, load_evaluated(map_path, source_of(job)));
  const ListedEvaluationJob one{.map = map_path,
                                .truth = truth_path,
                                .frames = job.frames,
                                .layer = job.layer,
                                .options = job.comparison,
                                .vocabulary = job.vocabulary,
                                .limits = job.limits,
                                .stop = job.stop};
  HYPERMAP_ASSIGN_OR_RETURN(ListedEvaluation evaluation, evaluate_listed(map, listed, one));
  std::move(evaluation.findings.begin(), evaluation.findings.end(), std::back_inserter(findings));
  return rated_run(map, evaluation, job.comparison);
}

Result<RatedRun> rated(const std::filesystem::path& map_path,
                       const std::filesystem::path& truth_path,
                       const LoadedTruth& truth,
                       const RatesJob& job,
                       std::vector<Finding>& findings) {
  if (const auto* listed = std::get_if<ListedInstances>(&truth))
    return rated_against_list(map_path, truth_path, *listed, job, findings);
  EvaluatedArchive understood_truth = std::get<EvaluatedArchive>(truth);
  HYPERMAP_ASSIGN_OR_RETURN(EvaluatedArchive map,
                            load_in_frame(map_path, source_of(job), understood_truth.frame_id));
  const ClassVocabulary vocabulary =
      vocabulary_of(job.vocabulary, map.archive, understood_truth.archive);
  understand(map, vocabulary);
  understand(understood_truth, vocabulary);
  HYPERMAP_ASSIGN_OR_RETURN(const EvaluationOptions options,
                            understood_options(job.options, map, understood_truth));
  RatedRun run = rated_run(map, understood_truth, options);
  if (why_no_voxels(map.archive, understood_truth.archive).empty()) {
    HYPERMAP_ASSIGN_OR_RETURN(const VoxelOutcome voxels,
                              evaluated_voxels(map, understood_truth, job.stop));
    run.fit.label_precision = voxels.labels.all.precision();
    run.fit.label_recall = voxels.labels.all.recall();
  }
  return run;
}

/// What one run cannot tell.
void note_unknown(const std::filesystem::path& map,
                  const RatedRun& run,
                  const RunRates& rates,
                  std::vector<std::string>& unknown) {
  const std::string name = printable(map.filename().string());
  if (!run.has_tentative)
    unknown.push_back(name +
                      " does not keep what it rejected: no true negatives, so no TNr, FPr "
                      "and ACC");
  if (!rates.has_confidences)
    unknown.push_back(name + " does not say how sure it is of its objects: no AP");
  const auto num_flat = std::count_if(run.truths.begin(), run.truths.end(), [](const auto& truth) {
    return truth.counts && !truth.box;
  });
  if (num_flat > 0) {
    unknown.push_back(count_text(static_cast<std::size_t>(num_flat), "thing") +
                      " of the truth of " + name +
                      " without a box: no overlap and no position in space");
  }
}

}  // namespace

Result<RatesOutcome> run_rates_job(const RatesJob& job) {
  HYPERMAP_TRY(check_job(job));
  RatesOutcome outcome;
  std::optional<LoadedTruth> truth;
  for (std::size_t i = 0; i < job.maps.size(); ++i) {
    const auto& truth_path = job.truths[std::min(i, job.truths.size() - 1)];
    const bool is_same = i > 0 && truth_path == job.truths[std::min(i - 1, job.truths.size() - 1)];
    if (!is_same) {
      HYPERMAP_ASSIGN_OR_RETURN(truth, load_truth(truth_path, job));
    }
    HYPERMAP_ASSIGN_OR_RETURN(const RatedRun run,
                              rated(job.maps[i], truth_path, *truth, job, outcome.findings));
    outcome.runs.push_back(run_rates(run));
    note_unknown(job.maps[i], run, outcome.runs.back(), outcome.unknown);
  }
  if (!job.frames && std::any_of(job.truths.begin(), job.truths.end(), is_list))
    outcome.unknown.emplace_back(
        "how often listed things were named: none is taken out as rarely seen (--input)");
  outcome.tables = run_tables(outcome.runs);
  return outcome;
}

}  // namespace hypermap
