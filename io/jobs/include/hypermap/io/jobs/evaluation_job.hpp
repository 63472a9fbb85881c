// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How good an archive is, measured against one that is right, and whether better than another.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/evaluation/calibration.hpp"
#include "hypermap/core/evaluation/compared_plan.hpp"
#include "hypermap/core/evaluation/map_comparison.hpp"
#include "hypermap/core/evaluation/map_evaluation.hpp"
#include "hypermap/core/evaluation/relation_evaluation.hpp"
#include "hypermap/core/evaluation/voxel_evaluation.hpp"
#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/projection/grids/grid_agreement.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hypermap {

struct MapAndTruth {
  std::filesystem::path map;
  std::filesystem::path truth;
};

struct EvaluationJob {
  std::filesystem::path map;
  std::filesystem::path truth;
  std::optional<std::filesystem::path> against = std::nullopt;  ///< Another map of the same place.
  std::vector<MapAndTruth> also = {};  ///< Further pairs, for the calibration alone.
  std::string layer = "semantic";      ///< Semantic layer in each archive.
  /// Its classes are what they ask for (asked_names).
  EvaluationOptions options = {};
  /// What names of classes mean in all archives; none: what the map says, else what the truth does.
  std::optional<ClassVocabulary> vocabulary = std::nullopt;
  CalibrationOptions calibration = {};
  ArchiveLimits limits = {};  ///< Of each archive.
  StopCheck stop = {};        ///< Ends the loading of any with kInterrupted.
};

/// What the voxels say; a mean is none where there is nothing to average.
struct VoxelOutcome {
  VoxelEvaluation labels = {};
  /// Mean over the truths that count of the share of what was seen of their surface.
  std::optional<double> surface_covered = std::nullopt;
};

/// One object of the map, what it says of itself, and which true object it is.
struct ObjectOutcome {
  std::uint64_t id = 0;
  std::string class_name = {};
  bool is_confirmed = false;
  double real_probability = 0.0;              ///< That it exists.
  double best_class_probability = 0.0;        ///< That it is of its class.
  std::optional<std::uint64_t> true_id = {};  ///< None: it is false, or a duplicate.
  std::string true_class_name = {};           ///< Empty without one.
};

/// One true object, and what both metrics say of it. Values of a match are none without one.
struct TrueObjectOutcome {
  std::uint64_t id = 0;
  std::string class_name = {};
  bool counts = false;                            ///< One to one; the thesis metric counts all.
  std::optional<std::uint64_t> matched_id = {};   ///< In the map's layer.
  std::optional<double> distance_m = {};          ///< Of the match: between centroids.
  double jaccard_in_place = 0.0;                  ///< 0 without a match.
  std::optional<double> box_iou = {};             ///< Of a match whose boxes are both known.
  std::optional<double> off_height_m = {};        ///< Of these: the middle of the map's box above.
  std::optional<double> nearest_distance_m = {};  ///< Thesis: none when the map lacks the class.
  std::optional<double> aligned_jaccard = {};     ///< Thesis: the same.
};

struct EvaluationOutcome {
  EvaluationReport report = {};
  /// Of the classes that are evaluated, in the order of `report.truths`.
  std::vector<TrueObjectOutcome> truths = {};
  std::optional<MapComparison> against =
      std::nullopt;  ///< The map against the other one, when there is one.
  std::optional<VoxelOutcome> voxels = std::nullopt;
  /// Of the layers `occupancy`; none where either side lacks it or they lie in different frames.
  std::optional<GridAgreement> occupancy = std::nullopt;
  std::string why_no_voxels = {};  ///< Why there is no `voxels`; empty when there is.
  /// The truth tells how often each object was named rightly, so rarely seen ones are excluded.
  bool knows_frames_named = false;
  CalibrationReport best_class = {};  ///< P(best class) of the map's confirmed objects.
  CalibrationReport real = {};        ///< P(real) of all its objects.
  /// What stands on, in, under and beside what; none without true surfaces and objects of the map.
  std::optional<RelationEvaluation> relations = std::nullopt;
  std::vector<ObjectOutcome> objects = {};  ///< Of the map alone, tentative ones too, by id.
  ComparedPlan plan = {};                   ///< Both from above, for a picture.
};

/// Maps and truths are archives, bare configurations, or semantic YAML files, which have no other
/// part and lie in the frame of the other side.
/// Errors: those of load_archive, read_semantic_layer, validate(EvaluationOptions) and
/// validate(CalibrationOptions); kNotFound when an archive lacks the layer, or when neither the map
/// nor the truth has an object of a class asked for; kUnsupported when the layer is no semantic
/// one, or in another frame than that of the truth. Boundary: classes that are asked for restrict
/// the one-to-one and thesis metrics; voxels and calibration are of all classes.
[[nodiscard]] Result<EvaluationOutcome> run_evaluation(const EvaluationJob& job);

}  // namespace hypermap
