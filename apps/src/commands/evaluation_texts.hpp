// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// An evaluation as text: tables for people, JSON for programs.
#pragma once

#include "hypermap/io/jobs/evaluation_job.hpp"
#include "hypermap/io/jobs/listed_evaluation_job.hpp"

#include <string>

namespace hypermap::app {

[[nodiscard]] std::string json_text_of(const EvaluationOutcome& outcome);
[[nodiscard]] std::string table_text_of(const EvaluationOutcome& outcome);

/// `options` are those of the comparison: the tolerances are part of the text.
[[nodiscard]] std::string json_text_of(const ListedEvaluation& outcome,
                                       const InstanceComparisonOptions& options);
[[nodiscard]] std::string table_text_of(const ListedEvaluation& outcome,
                                        const InstanceComparisonOptions& options);

}  // namespace hypermap::app
