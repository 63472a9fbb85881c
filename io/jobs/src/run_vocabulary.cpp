// SPDX-License-Identifier: BSD-3-Clause
#include "run_vocabulary.hpp"

#include "hypermap/core/objects/object_pipeline_options.hpp"
#include "hypermap/core/places/place_prior.hpp"
#include "hypermap/core/places/vocabulary_rules.hpp"
#include "named_classes.hpp"

#include <algorithm>
#include <iterator>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

void move_to_end(std::vector<Finding>& findings, std::vector<Finding>& more) {
  std::move(more.begin(), more.end(), std::back_inserter(findings));
}

/// The transient classes as they are called. Where the input does not have a class of the default,
/// people, that is nothing to tell.
Result<NamedClasses> transient_classes(const ObjectPipelineOptions& options,
                                       const ClassRegistry& classes,
                                       const ClassVocabulary& vocabulary) {
  std::vector<std::string> usual;
  std::vector<std::string> others;
  for (const std::string& name : options.transient_class_names)
    (is_transient_by_default(name) ? usual : others).push_back(name);
  HYPERMAP_ASSIGN_OR_RETURN(NamedClasses named,
                            named_classes(others, "transient_classes", classes, vocabulary));
  HYPERMAP_ASSIGN_OR_RETURN(const NamedClasses known,
                            named_classes(usual, "transient_classes", classes, vocabulary));
  std::ranges::copy_if(known.names, std::back_inserter(named.names), [&](const std::string& name) {
    return classes.find(name).has_value();
  });
  return named;
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
  HYPERMAP_ASSIGN_OR_RETURN(auto transient,
                            transient_classes(options.objects, run.classes, vocabulary));
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
