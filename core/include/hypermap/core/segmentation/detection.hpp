// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What a detector said about one image.
///
/// Source: [smap] Eq. (3.1) to (3.4).
#pragma once

#include "hypermap/core/base/ids.hpp"
#include "hypermap/core/base/image.hpp"
#include "hypermap/core/base/log_odds.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/segmentation/embedding.hpp"

#include <optional>
#include <span>
#include <vector>

namespace hypermap {

/// Axis-aligned box in the image. Edges are continuous; pixel (u, v) covers [u, u+1) x [v, v+1).
struct PixelBox {
  double u_min_px = 0.0;
  double v_min_px = 0.0;
  double u_max_px = 0.0;
  double v_max_px = 0.0;

  [[nodiscard]] double width_px() const noexcept { return u_max_px - u_min_px; }
  [[nodiscard]] double height_px() const noexcept { return v_max_px - v_min_px; }
  friend bool operator==(const PixelBox&, const PixelBox&) = default;
};

/// Area of the intersection over area of the union; 0 when both areas are 0.
[[nodiscard]] double intersection_over_union(const PixelBox& a, const PixelBox& b) noexcept;

/// One class and how strongly a detector believes in it.
struct ClassEvidence {
  ClassId id;
  Probability probability;
  friend bool operator==(const ClassEvidence&, const ClassEvidence&) = default;
};

/// One detected object in one image.
struct Detection {
  PixelBox box_px;
  /// Probability of each class that the detector knows, sorted by id, summing to 1.
  std::vector<ClassEvidence> class_scores;
  /// The detector's own score of the detection, objectness included.
  Probability score;
  DetectorId detector;
  /// Pixels of the object in the size of the image, when the detector gives them. One without a
  /// pixel finds nothing; readers and detectors take such a mask for none.
  std::optional<MaskImage> mask;
  /// How it looks to image networks, a model each; mostly none.
  std::vector<Embedding> embeddings = {};

  friend bool operator==(const Detection&, const Detection&) = default;
};

/// Errors: kInvalidArgument naming the field: a box that is not finite or inside out, a score
/// outside [0, 1], class scores that are none, outside [0, 1], not ascending by id below 65,535 or
/// whose sum is off 1 by more than 1e-3; kInvalidArgument and kLimit of its embeddings. The mask is
/// judged with its image, see validate(RgbdFrame).
[[nodiscard]] Result<void> validate(const Detection& detection);

/// Of class scores alone.
[[nodiscard]] Result<void> validate_class_scores(std::span<const ClassEvidence> scores);

/// The most probable class; the lowest id of equals. None when there are no scores.
[[nodiscard]] std::optional<ClassEvidence> best_class(std::span<const ClassEvidence> scores);

/// A full class vector for a detector that gives one class and one score: the score stands for its
/// class and the rest is spread evenly over the other `known` classes.
///
/// Boundary: when `known` is only this class, it gets 1. Result sorted by id, sums to 1.
/// Requires: `known` contains `id`, has no id twice.
[[nodiscard]] std::vector<ClassEvidence> spread_score(ClassId id,
                                                      Probability score,
                                                      std::span<const ClassId> known);

/// Scaled to sum 1 and sorted by id. Errors: kInvalidArgument when the sum is 0 or an id occurs
/// twice.
[[nodiscard]] Result<std::vector<ClassEvidence>> normalized(std::vector<ClassEvidence> scores);

/// `known` and the models of the detections' embeddings. Errors: those of EmbeddingDimensions::add,
/// field `detections[i].embeddings`. Cost: no allocation when neither has any.
[[nodiscard]] Result<EmbeddingDimensions> with_embeddings_of(std::span<const Detection> detections,
                                                             EmbeddingDimensions known);

}  // namespace hypermap
