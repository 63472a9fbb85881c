// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/objects/object.hpp"

#include <algorithm>
#include <utility>

namespace hypermap {
namespace {

/// A belief saturates after few observations, so that without weights two of them would say as much
/// as sixty. The one with fewer observations counts in proportion.
ClassBelief merged_belief(const Object& a, const Object& b) {
  const Object& larger = a.num_observations >= b.num_observations ? a : b;
  const Object& smaller = &larger == &a ? b : a;
  const double most = std::max<double>(1.0, larger.num_observations);
  ClassBelief belief = larger.belief;
  belief.merge(smaller.belief, smaller.num_observations / most);
  return belief;
}

}  // namespace

Result<Polygon> footprint(const Object& object, ShapePolicy policy) {
  if (policy == ShapePolicy::kVoxels) return object.points.footprint();
  std::optional<Polygon> shape =
      policy == ShapePolicy::kBest ? object.shapes.best() : object.shapes.hull();
  if (!shape) return fail(ErrorCode::kNotFound, "the object has no shapes");
  return *std::move(shape);
}

Object merged(const Object& a, const Object& b, LogOdds max_existence) {
  const Object& younger = b.id < a.id ? a : b;
  Object out = b.id < a.id ? b : a;
  out.belief = merged_belief(out, younger);
  if (younger.num_observations > out.num_observations) out.prior = younger.prior;
  out.existence = std::min(out.existence + younger.existence, max_existence);
  out.box_confidence = std::max(a.box_confidence, b.box_confidence);
  out.histogram.merge(younger.histogram);
  out.shapes.merge(younger.shapes);
  out.points.merge(younger.points);
  out.observation_log.merge(younger.observation_log);
  out.embeddings.merge(younger.embeddings);
  out.box = out.points.agreed_box().value_or(bounding_box(a.box, b.box));
  out.centroid_in_map = out.box.centre();
  out.first_seen = std::min(a.first_seen, b.first_seen);
  out.last_seen = std::max(a.last_seen, b.last_seen);
  out.num_observations += younger.num_observations;
  out.farthest_detection_m = std::max(a.farthest_detection_m, b.farthest_detection_m);
  return out;
}

}  // namespace hypermap
