// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How good an archive is, measured against one that is right, and whether better than another.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/evaluation/map_comparison.hpp"
#include "hypermap/core/evaluation/map_evaluation.hpp"
#include "hypermap/io/archive/map_archive.hpp"

#include <filesystem>
#include <optional>
#include <string>

namespace hypermap {

struct EvaluationJob {
  std::filesystem::path map;
  std::filesystem::path truth;
  std::optional<std::filesystem::path> against = std::nullopt;  ///< Another map of the same place.
  std::string layer = "semantic";                               ///< Semantic layer in each archive.
  EvaluationOptions options = {};
  ArchiveLimits limits = {};  ///< Of each archive.
  StopCheck stop = {};        ///< Ends the loading of any with kInterrupted.
};

struct EvaluationOutcome {
  EvaluationReport report;
  std::optional<MapComparison> against;  ///< The map against the other one, when there is one.
};

/// Errors: those of load_archive and validate(EvaluationOptions); kNotFound when an archive lacks
/// the layer, or when neither the map nor the truth has an object of a class asked for;
/// kUnsupported when the layer is no semantic one, or in another frame than that of the truth.
[[nodiscard]] Result<EvaluationOutcome> run_evaluation(const EvaluationJob& job);

}  // namespace hypermap
