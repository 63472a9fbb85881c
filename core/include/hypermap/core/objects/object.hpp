// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// One object in the map, with all that is believed about it and why.
///
/// Source: [smap] pseudocode 3.4 (thing), 3.5.2 to 3.5.5; [hypermap] 3.4.5 (semantic object).
#pragma once

#include "hypermap/core/base/ids.hpp"
#include "hypermap/core/base/log_odds.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/box.hpp"
#include "hypermap/core/geometry/occupancy_votes.hpp"
#include "hypermap/core/geometry/polygon.hpp"
#include "hypermap/core/objects/class_belief.hpp"
#include "hypermap/core/objects/class_prior.hpp"
#include "hypermap/core/objects/mean_embeddings.hpp"
#include "hypermap/core/objects/observation_log.hpp"
#include "hypermap/core/objects/shape_evidence.hpp"
#include "hypermap/core/objects/visibility_histogram.hpp"

#include <Eigen/Core>

#include <cstdint>
#include <optional>
#include <vector>

namespace hypermap {

struct OptionTable;

/// One object serves the models of both sources. A value: all of its state is here, so that it can
/// be copied, compared, stored and restored bit by bit. Frame: Map.
struct Object {
  ObjectId id;
  ClassBelief belief;
  /// What outside knowledge said of its class when it was last observed. Source: [smap] Eq. (3.17).
  ClassPrior prior;
  /// That it exists at all. Source: [hypermap] 3.4.5, a log probability.
  LogOdds existence;
  /// Sum of the log-odds of the box confidences, l_c. Source: [smap] Eq. (3.21).
  LogOdds box_confidence;
  Box box;
  Eigen::Vector3d centroid_in_map = Eigen::Vector3d::Zero();
  VisibilityHistogram histogram;
  ShapeEvidence shapes;
  OccupancyVotes points;
  ObservationLog observation_log;
  MeanEmbeddings embeddings;
  Stamp first_seen;
  Stamp last_seen;
  std::uint32_t num_observations = 0;
  /// From farther away it was never detected, so a detection is not expected.
  double farthest_detection_m = 0.0;

  friend bool operator==(const Object&, const Object&) = default;
};

/// The probability of each class, in ascending order of ids; sums to 1, empty without any evidence.
///
/// Tempering none: the belief's distribution. Views, ours: with s(c, v) the share of the detections
/// of view v (a bearing bin of the observation log) that named class c, and n(v) their number,
/// p(c) ~ (sum over v of sqrt(n(v)) s(c, v))^2, and 0.2 for all classes together that are in the
/// belief and were never named. So frames of one view do not erase what other views, or fewer of
/// its frames, say. Source: docs/EVALUATION.md, "Calibration". To that the object's prior is
/// applied once, as often as it was observed; under tempering none each observation bore it
/// ((3.17)). Boundary: without recorded detections, the belief's distribution. Cost: linear in
/// classes, and in summaries of the log times their logarithm.
[[nodiscard]] std::vector<ClassEvidence> class_distribution(const Object& object);

/// The same by its detections alone, without outside knowledge, wherever that can be told apart:
/// under tempering none it is the belief's.
[[nodiscard]] std::vector<ClassEvidence> detected_distribution(const Object& object);

/// The class that an object most likely is and its share of `class_distribution`: of equals the one
/// most believed in, then the lowest id. None without any evidence.
[[nodiscard]] std::optional<ClassEvidence> best_class(const Object& object);

/// The same of `detected_distribution`: what decides which observations are of one object.
[[nodiscard]] std::optional<ClassEvidence> best_detected_class(const Object& object);

/// Probability that a detected object is one real object, not a false alarm or a part of another:
/// logistic in how often, from how many directions it was detected, how visible it was when it was
/// not, and how often it was named otherwise than mostly. An object that is gone (GoneRule's
/// defaults) has the odds e^-looks at most.
///
/// Source: ours; the coefficients are fitted, see docs/EVALUATION.md, "Calibration".
/// Boundary: without recorded detections, the probability of its existence.
/// Cost: linear in the log's summaries.
[[nodiscard]] Probability real_probability(const Object& object);

/// How sure an object is.
enum class ConfidenceRule {
  kRealAndClass,  ///< P(real) times that of its best class. Ours.
  kWeighted,      ///< (4 tp1 + tp2 + tp3) / 6. Source: [smap] Eq. (3.27), table D.2.
  kMultiplied,    ///< tp3 (4 tp1 + tp2) / 5. Source: [smap] chapter 6, future work.
};

struct ObjectConfidenceOptions {
  ConfidenceRule rule = ConfidenceRule::kRealAndClass;
  friend bool operator==(const ObjectConfidenceOptions&, const ObjectConfidenceOptions&) = default;
};
[[nodiscard]] const OptionTable& option_table(const ObjectConfidenceOptions& options);

/// How sure the map is of an object. Rules weighted and multiplied: tp1 = probability of the best
/// class, tp2 = that of the box, tp3 = confidence of the visibility histogram.
///
/// Source: [smap] Eq. (3.27), table D.2. Boundary: tp1, and that of real and class, is 0 when no
/// class was ever named.
[[nodiscard]] Probability object_confidence(const Object& object,
                                            const ObjectConfidenceOptions& options = {});

/// Which of its shapes an object shows from above.
enum class ShapePolicy {
  kBest,    ///< The shape nearest to the mean centroid. Source: [hypermap] 3.4.5.
  kHull,    ///< Hull of all shapes. Source: [hypermap] 3.4.5.
  kVoxels,  ///< Hull of the points that its observations agree on. Ours.
};

/// What the object covers from above. Errors: kNotFound when it has no evidence of that kind.
[[nodiscard]] Result<Polygon> footprint(const Object& object,
                                        ShapePolicy policy = ShapePolicy::kVoxels);

/// Merges two duplicates: evidence adds up, lists concatenate, the older id
/// stays, the box is that of the agreed points.
///
/// Source: [hypermap] 3.4.5 (shape lists concatenate, existences add), capped at
/// `max_existence`.
/// Requires: equal options of belief, histogram and points.
[[nodiscard]] Object merged(const Object& a, const Object& b, LogOdds max_existence);

}  // namespace hypermap
