// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What names of classes mean while a map is made.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/jobs/mapping_job.hpp"
#include "mapping_run.hpp"

namespace hypermap {

/// What the job says, else the map that the run goes on from.
[[nodiscard]] ClassVocabulary vocabulary_of(const MappingRun& run, const MappingJob& job);

/// The options of the mapper with the classes that they ask for; what names none is a finding of
/// the report. Errors: those of named_classes.
[[nodiscard]] Result<SemanticMapperOptions> understood_options(const MappingRun& run,
                                                               const MappingJob& job,
                                                               MappingReport& report);

/// Tells the mapper what belongs where, if its options want that. Errors: kInvalidArgument without
/// rules; those of PlacePrior::create.
[[nodiscard]] Result<void> set_prior_source(const MappingRun& run,
                                            const MappingJob& job,
                                            SemanticMapper& mapper);

}  // namespace hypermap
