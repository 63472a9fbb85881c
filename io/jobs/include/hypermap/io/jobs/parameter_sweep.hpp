// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How the quality of maps depends on options: each combination of values, over sequences whose
/// truth is known.
///
/// Source: [smap] F.5 (parameter tuning). Deviation: measured against a truth, not looked at.
#pragma once

#include "hypermap/core/base/job_progress.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/places/place_classifier.hpp"
#include "hypermap/io/dataset/dataset_reader.hpp"
#include "hypermap/io/options/options_file.hpp"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap {

/// An option and the values that it takes, as texts of an options file.
struct SweepAxis {
  std::string option;
  std::vector<std::string> values;
  friend bool operator==(const SweepAxis&, const SweepAxis&) = default;
};

/// "OPTION=a,b,c". Errors: kInvalidArgument for a text without option or values, or with one value
/// twice; those of check_option, with the nearest name.
[[nodiscard]] Result<SweepAxis> parse_sweep_axis(std::string_view text);

/// What is mapped with each combination, and the archive that says what is right.
struct SweptSequence {
  std::string name;
  std::filesystem::path input;
  std::filesystem::path truth;
  DatasetOptions dataset = {};
};

struct SweepJob {
  std::vector<SweepAxis> axes = {};
  std::vector<SweptSequence> sequences = {};
  MapOptions options = {};  ///< What the axes do not say.
  /// For the combinations whose `prior.source` is places, and those of `stacking.rule` trained.
  std::optional<PlaceRules> place_rules = {};
  std::optional<std::filesystem::path> combiner = {};
  std::filesystem::path folder =
      {};  ///< One map at a time lies here, and goes once it is evaluated.
};

/// Shares and metres of one map (see run_evaluation), or means and worst of several; none where
/// there is nothing to divide.
struct SweepScores {
  std::optional<double> f1 = {};
  std::optional<double> precision = {};
  std::optional<double> recall = {};
  std::optional<double> jaccard = {};  ///< In place.
  std::optional<double> label_precision = {};
  std::optional<double> label_recall = {};
  std::optional<double> distance_m = {};  ///< Worst: the largest; of all else the least.
  friend bool operator==(const SweepScores&, const SweepScores&) = default;
};

/// One combination.
struct SweepPoint {
  std::vector<std::string> values;  ///< In the order of the axes.
  std::vector<SweepScores> runs;    ///< In the order of the sequences.
  SweepScores mean = {};
  SweepScores worst = {};
};

struct SweepReport {
  std::vector<SweepAxis> axes;
  std::vector<std::string> sequences;  ///< Their names.
  std::vector<SweepPoint> points;      ///< The last axis varies first.
};

inline constexpr std::size_t kMaxSweepRuns = 10'000;

/// Maps each sequence with each combination of values and evaluates the map; progress counts maps.
///
/// All combinations are tried as options before the first map. Errors: kInvalidArgument without
/// axes or sequences, for an option that two axes have, for an option `prior.*` while there is no
/// `prior.source`, for a combination that needs rules of
/// places or a combiner and has none, and for more than kMaxSweepRuns maps; those of with_option,
/// run_mapping and run_evaluation, naming the combination; kInterrupted. On an error the folder has
/// no map. Cost: maps and evaluations one after the other; a map takes
/// `options`' threads.
[[nodiscard]] Result<SweepReport> run_sweep(const SweepJob& job, const JobProgress& progress = {});

/// Mean over the runs that have a value, and the worst of them.
[[nodiscard]] SweepScores mean_of(const std::vector<SweepScores>& runs);
[[nodiscard]] SweepScores worst_of(const std::vector<SweepScores>& runs);

/// One JSON document: `axes` [{`option`, `values`}], `sequences` [names], `points` [{`values`,
/// `mean`, `worst`, `runs` [...]}], of scores `f1`, `precision`, `recall`, `jaccard`,
/// `label_precision`, `label_recall`, `distance_m`, numbers or null.
[[nodiscard]] std::string to_json(const SweepReport& report);

}  // namespace hypermap
