// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The rates of several runs together, by class, by run and by object, as tables.
///
/// Source: [smap] tables 5.1 and 5.2, appendix B, E.1; docs/EVALUATION.md, "Rates".
#pragma once

#include "hypermap/core/evaluation/average_precision.hpp"
#include "hypermap/core/evaluation/position_errors.hpp"
#include "hypermap/core/evaluation/run_rates.hpp"

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace hypermap {

/// A row of figures: of a class over all runs, of a run over all classes, or of all.
struct RateRow {
  BinaryCounts counts = {};
  /// By criterion; AP of a class, of several classes mAP. None without truths, or where objects
  /// cannot be ranked.
  std::array<std::optional<double>, kMatchCriteria.size()> average_precision = {};
  std::optional<double> box_iou = std::nullopt;  ///< Mean over the matches with two boxes.
  PositionErrorSummary position = {};            ///< Of the matches with two boxes.
};

struct ClassRow {
  RateRow rates = {};
  std::vector<PrecisionRecallPoint> curve = {};  ///< By distance; empty without truths.
};

/// Of a figure that runs have, over these runs.
struct OverRuns {
  std::size_t n = 0;  ///< Runs that have it.
  std::optional<double> mean = std::nullopt;
  std::optional<double> std = std::nullopt;  ///< Over n - 1; none of fewer than two.
  /// How far the mean's 95 % interval reaches to either side (student_interval.hpp); likewise.
  std::optional<double> half_width_95 = std::nullopt;

  /// Ends of that interval.
  [[nodiscard]] std::optional<double> low_95() const;
  [[nodiscard]] std::optional<double> high_95() const;
};

/// A figure of a run that has a mean over runs.
struct RunFigure {
  std::string key = {};  ///< For output: "precision" ...
  OverRuns over_runs = {};
};

/// One thing that runs have, or miss.
struct ObjectRow {
  std::string reference = {};
  std::string class_name = {};
  std::size_t num_counting = 0;  ///< Runs in whose truth it counts.
  std::size_t num_found = 0;     ///< Of these, those that have it.
  PositionErrorSummary position = {};
};

struct RunTables {
  std::map<std::string, ClassRow> classes = {};  ///< By canonical name, over all runs.
  RateRow all = {};                              ///< Counts summed, mAP over the classes.
  Classifications classifications = {};
  std::vector<RateRow> runs = {};                         ///< In the order of the runs.
  std::vector<Classifications> run_classifications = {};  ///< Likewise.
  std::vector<RunFit> run_fits = {};                      ///< Likewise.
  std::vector<RunFigure> figures = {};
  std::vector<ObjectRow> objects = {};  ///< In the order in which runs first have them.
  /// Of each object's mean error over its runs, an object an error. Source: [smap] table 5.2.
  PositionErrorSummary mean_errors = {};
};

/// AP of a class is that of the objects of all runs in one ranking. Things of several runs are one
/// when reference and class are.
/// Boundary: no runs give no rows. Cost: O(n log n) of all objects.
[[nodiscard]] RunTables run_tables(std::span<const RunRates> runs);

}  // namespace hypermap
