// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Rates, average precision and position errors of one map or of several runs.
///
/// Source: [smap] chapter 5, appendices B and E.1; docs/EVALUATION.md, "Rates".
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/evaluation/instance_comparison.hpp"
#include "hypermap/core/evaluation/map_evaluation.hpp"
#include "hypermap/core/evaluation/run_rates.hpp"
#include "hypermap/core/evaluation/run_tables.hpp"
#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/io/jobs/listed_evaluation_job.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hypermap {

struct RatesJob {
  std::vector<std::filesystem::path> maps = {};  ///< A run each.
  /// One for all maps, or one for each; archives, lists (listed_instances_file.hpp), or some of
  /// both.
  std::vector<std::filesystem::path> truths = {};
  std::optional<NamingFrames> frames = std::nullopt;  ///< Of the one list that all maps share.
  std::string layer = "semantic";                     ///< Semantic layer in each archive.
  EvaluationOptions options = {};                     ///< Against archives.
  InstanceComparisonOptions comparison = {};          ///< Against lists.
  /// What names of classes mean; none: as the map says, else the truth.
  std::optional<ClassVocabulary> vocabulary = std::nullopt;
  ArchiveLimits limits = {};  ///< Of each archive.
  StopCheck stop = {};        ///< Ends loading and counting with kInterrupted.
};

struct RatesOutcome {
  std::vector<RunRates> runs = {};  ///< In the order of the maps.
  RunTables tables = {};
  std::vector<std::string> unknown = {};  ///< What cannot be told of these maps or truths, and why.
  std::vector<Finding> findings = {};
};

/// Errors: kInvalidArgument when there is no map or the truths are neither one nor as many as the
/// maps, when there are frames without a list that all maps share, or classes with a list; those
/// of run_evaluation and run_listed_evaluation. Boundary: against a list, or a truth without
/// surfaces, no fit of voxels is known; against a list none of shapes either.
[[nodiscard]] Result<RatesOutcome> run_rates_job(const RatesJob& job);

}  // namespace hypermap
