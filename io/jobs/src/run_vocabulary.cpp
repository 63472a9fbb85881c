// SPDX-License-Identifier: BSD-3-Clause
#include "run_vocabulary.hpp"

#include "hypermap/core/places/place_prior.hpp"
#include "hypermap/core/places/vocabulary_rules.hpp"
#include "named_classes.hpp"

#include <iterator>
#include <memory>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

void move_to_end(std::vector<Finding>& findings, std::vector<Finding>& more) {
  std::move(more.begin(), more.end(), std::back_inserter(findings));
}

}  // namespace

ClassVocabulary vocabulary_of(const MappingRun& run, const MappingJob& job) {
  if (job.vocabulary) return *job.vocabulary;
  return run.previous ? run.previous->vocabulary : ClassVocabulary();
}

Result<SemanticMapperOptions> understood_options(const MappingRun& run,
                                                 const MappingJob& job,
                                                 MappingReport& report) {
  SemanticMapperOptions options = job.mapper;
  const ClassVocabulary vocabulary = vocabulary_of(run, job);
  HYPERMAP_ASSIGN_OR_RETURN(
      auto transient,
      named_classes(
          options.objects.transient_class_names, "transient_classes", run.classes, vocabulary));
  HYPERMAP_ASSIGN_OR_RETURN(
      auto wanted,
      named_classes(options.wanted_class_names, "wanted_classes", run.classes, vocabulary));
  move_to_end(report.findings, transient.findings);
  move_to_end(report.findings, wanted.findings);
  options.objects.transient_class_names = std::move(transient.names);
  options.wanted_class_names = std::move(wanted.names);
  return options;
}

Result<void> set_prior_source(const MappingRun& run,
                              const MappingJob& job,
                              SemanticMapper& mapper) {
  if (job.mapper.prior.source == ClassPriorKind::kNone) return {};
  if (!job.place_rules) {
    return fail(ErrorCode::kInvalidArgument, "needs rules of what belongs where", "prior.source");
  }
  HYPERMAP_ASSIGN_OR_RETURN(
      auto prior,
      PlacePrior::create(with_vocabulary(*job.place_rules, vocabulary_of(run, job)),
                         job.mapper.prior));
  mapper.set_prior_source(std::make_shared<const PlacePrior>(std::move(prior)));
  return {};
}

}  // namespace hypermap
