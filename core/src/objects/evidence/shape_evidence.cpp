// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/objects/shape_evidence.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <string>
#include <utility>

namespace hypermap {
namespace {

double corner_area(const Ring& ring, std::size_t i) {
  const std::size_t n = ring.size();
  const Eigen::Vector2d a = ring[i] - ring[(i + n - 1) % n];
  const Eigen::Vector2d b = ring[(i + 1) % n] - ring[i];
  return a.x() * b.y() - a.y() * b.x();
}

/// Leaves out corners, those that enclose least area first.
void simplify(Ring& ring, std::size_t max_corners) {
  while (ring.size() > max_corners) {
    std::size_t least = 0;
    for (std::size_t i = 1; i < ring.size(); ++i) {
      if (corner_area(ring, i) < corner_area(ring, least)) least = i;
    }
    ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(least));
  }
}

}  // namespace

Result<ShapeEvidence> ShapeEvidence::from_state(ShapeEvidenceState state) {
  if (state.shapes.size() > kMaxShapes || state.shapes.size() > state.num_seen) {
    return fail(ErrorCode::kInvalidArgument,
                "must be at most " + std::to_string(kMaxShapes) + " and at most those seen, are " +
                    std::to_string(state.shapes.size()),
                "shapes");
  }
  if (!state.centroid_sum.allFinite()) {
    return fail(ErrorCode::kInvalidArgument, "must be finite", "shapes.centroid_sum");
  }
  if ((state.num_seen > 0) != state.hull.has_value()) {
    return fail(
        ErrorCode::kInvalidArgument, "must be there exactly when shapes were seen", "shapes.hull");
  }
  ShapeEvidence evidence;
  evidence.state_ = std::move(state);
  return evidence;
}

void ShapeEvidence::add(const Polygon& shape) {
  state_.shapes.push_back(shape);
  state_.centroid_sum += centroid(shape);
  ++state_.num_seen;
  widen_hull(shape);
  if (state_.shapes.size() > kMaxShapes) drop_farthest();
}

void ShapeEvidence::merge(const ShapeEvidence& other) {
  if (other.empty()) return;
  state_.shapes.insert(state_.shapes.end(), other.state_.shapes.begin(), other.state_.shapes.end());
  state_.centroid_sum += other.state_.centroid_sum;
  state_.num_seen += other.state_.num_seen;
  widen_hull(*other.state_.hull);
  while (state_.shapes.size() > kMaxShapes) drop_farthest();
}

std::optional<Polygon> ShapeEvidence::best() const {
  if (state_.shapes.empty()) return std::nullopt;
  const Eigen::Vector2d mean = mean_centroid();
  const auto distance = [&](const Polygon& p) { return (centroid(p) - mean).squaredNorm(); };
  return *std::min_element(
      state_.shapes.begin(), state_.shapes.end(), [&](const Polygon& a, const Polygon& b) {
        return distance(a) < distance(b);
      });
}

Eigen::Vector2d ShapeEvidence::mean_centroid() const {
  return state_.centroid_sum / static_cast<double>(state_.num_seen);
}

void ShapeEvidence::widen_hull(const Polygon& shape) {
  Ring points = shape.outer;
  if (state_.hull) {
    points.insert(points.end(), state_.hull->outer.begin(), state_.hull->outer.end());
  }
  auto hull = convex_hull(points);
  if (!hull) return;  // cannot be: a valid shape spans an area
  simplify(hull->outer, kMaxHullVertices);
  state_.hull = std::move(*hull);
}

void ShapeEvidence::drop_farthest() {
  const Eigen::Vector2d mean = mean_centroid();
  const auto farthest = std::max_element(
      state_.shapes.begin(), state_.shapes.end(), [&](const Polygon& a, const Polygon& b) {
        return (centroid(a) - mean).squaredNorm() < (centroid(b) - mean).squaredNorm();
      });
  state_.shapes.erase(farthest);
}

}  // namespace hypermap
