// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The shapes in which an object was seen from above, and the one that it most likely has.
///
/// Source: [hypermap] 3.4.5.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/polygon.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace hypermap {

/// Everything that a ShapeEvidence remembers, for storing it.
struct ShapeEvidenceState {
  std::vector<Polygon> shapes;  ///< The kept shapes, in the order of their arrival.
  std::uint64_t num_seen = 0;   ///< All shapes ever added, dropped ones included.
  Eigen::Vector2d centroid_sum = Eigen::Vector2d::Zero();  ///< Of the centroids of all of them.
  std::optional<Polygon> hull;                             ///< Convex hull of all of them.
  friend bool operator==(const ShapeEvidenceState&, const ShapeEvidenceState&) = default;
};

/// A bounded list of shapes that keeps what both policies of the source need.
///
/// Deviation: the source keeps all shapes. Here the mean centroid and the hull count all of them,
/// while of the shapes themselves the 24 nearest to the mean centroid stay: only they can become
/// the best one. Up to 24 shapes nothing differs. Memory: flat.
class ShapeEvidence {
 public:
  static constexpr std::size_t kMaxShapes = 24;
  /// A hull of more vertices loses those that matter least.
  static constexpr std::size_t kMaxHullVertices = 64;

  ShapeEvidence() = default;
  /// Errors: kInvalidArgument: more shapes than are kept or than were seen, a sum that is not
  /// finite, or shapes without a hull.
  [[nodiscard]] static Result<ShapeEvidence> from_state(ShapeEvidenceState state);

  /// Requires: a valid polygon.
  void add(const Polygon& shape);
  /// Lists concatenate. Source: [hypermap] 3.4.5.
  void merge(const ShapeEvidence& other);

  /// The kept shape whose centroid is closest to the mean centroid; the earliest of equals.
  /// Source: [hypermap] 3.4.5, policy `best`. None when empty.
  [[nodiscard]] std::optional<Polygon> best() const;
  /// Convex hull of all shapes. Source: [hypermap] 3.4.5, policy `hull`. None when empty.
  [[nodiscard]] const std::optional<Polygon>& hull() const noexcept { return state_.hull; }

  /// Of the centroids of all shapes ever added. Requires: !empty().
  [[nodiscard]] Eigen::Vector2d mean_centroid() const;
  [[nodiscard]] bool empty() const noexcept { return state_.num_seen == 0; }
  [[nodiscard]] const ShapeEvidenceState& state() const noexcept { return state_; }
  friend bool operator==(const ShapeEvidence&, const ShapeEvidence&) = default;

 private:
  void widen_hull(const Polygon& shape);
  void drop_farthest();

  ShapeEvidenceState state_;
};

}  // namespace hypermap
