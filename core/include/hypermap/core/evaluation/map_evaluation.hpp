// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How good a map of objects is, measured against the truth.
///
/// Source: [hypermap] 5.2.1 (the thesis metric); docs/EVALUATION.md (one to one).
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/box.hpp"
#include "hypermap/core/geometry/polygon.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace hypermap {

struct OptionTable;

/// An object as evaluation sees it, of whatever kind of archive.
struct EvaluatedObject {
  std::string class_name;
  Eigen::Vector2d centroid = Eigen::Vector2d::Zero();
  Polygon footprint;
  bool excluded = false;  ///< Truth only: never visible well enough, or of a class that the
                          ///< detector does not know.
  /// Largest side, height included; the footprint's largest side when not known (0).
  double size_m = 0.0;
  std::optional<Box> box = std::nullopt;
  bool is_nameable = true;  ///< Truth only: the detector has a word for the class.
  /// Truth only: frames in which a detection named it rightly; none in an older truth.
  std::optional<std::size_t> frames_named = std::nullopt;
  /// Truth only: share of the footprint over which the camera saw its surface.
  std::optional<double> seen_footprint_share = std::nullopt;
};

struct EvaluationOptions {
  double gate_m = 0.5;                    ///< Farther centroids do not match. docs/EVALUATION.md
  double small_gate_m = 0.25;             ///< The same for small truths.
  double small_size_m = 0.3;              ///< Truths with all sides below this are small.
  double min_judged_area_m2 = 0.04;       ///< Smaller footprints are averaged apart.
  double min_seen_share = 0.5;            ///< Of a footprint that counts as seen.
  std::vector<std::string> classes = {};  ///< Only these, after aliases; all when empty.
};

/// Errors: kInvalidArgument naming the field: gates and sizes finite and > 0, area >= 0,
/// share 0 .. 1.
[[nodiscard]] Result<void> validate(const EvaluationOptions& options);
[[nodiscard]] const OptionTable& option_table(const EvaluationOptions& options);

/// The thesis metric: nearest map object of the same class for each truth, which may serve several.
/// Source: [hypermap] 5.2.1. Means are none when `n` is 0.
struct NearestMetric {
  std::size_t n = 0;                 ///< Truths whose class occurs in the map.
  std::size_t num_truth = 0;         ///< All truths, those without a class in the map included.
  std::optional<double> distance_m;  ///< Mean distance of the centroids.
  std::optional<double> jaccard;     ///< Mean Jaccard index after moving the centroids together.
};

/// One-to-one assignment. Ratios and means are none when they would divide by 0.
struct OneToOneMetric {
  std::size_t num_truth = 0;  ///< Excluded ones left out.
  std::size_t num_map = 0;    ///< Those matched to excluded truths left out.
  std::size_t matched = 0;
  std::size_t excluded = 0;     ///< Truths that do not count.
  std::size_t rarely_seen = 0;  ///< Of these, those that the detector could name.
  std::size_t duplicates = 0;   ///< False positives beyond the first object of a truth.
  std::optional<double> precision;
  std::optional<double> recall;
  std::optional<double> f1;
  std::optional<double> distance_m;  ///< Mean over the matches.
  std::optional<double>
      jaccard_in_place;        ///< Mean over truths of at least the judged area; 0 if missed.
  std::size_t num_judged = 0;  ///< How many those are.
  std::optional<double> small_jaccard_in_place;  ///< Mean over the smaller ones.
  std::size_t num_small = 0;
  std::optional<double> worst_jaccard_in_place;  ///< Least over truths of at least that area.
  /// Mean over those of them of which half the footprint and more was seen.
  std::optional<double> seen_jaccard_in_place;
  std::size_t num_seen = 0;
  std::optional<double> footprint_covered;  ///< Mean share of true footprints; 0 if missed.
  std::optional<double> box_iou;            ///< Mean over the matches whose boxes are both known.
  std::size_t num_boxes = 0;
};

struct ClassMetrics {
  NearestMetric nearest;
  OneToOneMetric one_to_one;
};

/// The result of one truth; the pairs of a Wilcoxon test come from here.
struct TruthResult {
  std::size_t truth_index = 0;
  std::optional<std::size_t> matched_map_index;  ///< One to one.
  double matched_distance_m = 0.0;               ///< 0 when not matched.
  double jaccard_in_place = 0.0;                 ///< 0 when not matched.
  double footprint_covered = 0.0;                ///< Share of its area; 0 when not matched.
  std::optional<double> box_iou;                 ///< Of a match whose boxes are both known.
  std::optional<std::size_t> nearest_map_index;  ///< Of the thesis metric.
  double nearest_distance_m = 0.0;
  double aligned_jaccard = 0.0;
};

struct EvaluationReport {
  ClassMetrics all;
  std::map<std::string, ClassMetrics> classes;  ///< By canonical name.
  std::vector<TruthResult> truths;              ///< In the order of `truth`, chosen classes only.
  std::vector<std::size_t> false_positives;     ///< Indices into `map`, ascending.
  std::vector<std::size_t> duplicates;          ///< Those of them that are duplicates.
};

/// Compares a map with the truth. Classes are compared by canonical_class_name. The thesis metric
/// counts excluded truths too when their class occurs in the map, as the thesis does.
///
/// Requires: validate(options), valid footprints.
/// A duplicate is a false positive that lies within the gate of a true object, or within half the
/// longest horizontal side of it, and is not the first there: another is matched, or is nearer.
///
/// Boundary: a distance of exactly the gate matches. Map objects near an excluded truth of their
/// class are neither right nor wrong.
/// Cost: O(n^3) per class.
[[nodiscard]] EvaluationReport evaluate(std::span<const EvaluatedObject> map,
                                        std::span<const EvaluatedObject> truth,
                                        const EvaluationOptions& options = {});

}  // namespace hypermap
