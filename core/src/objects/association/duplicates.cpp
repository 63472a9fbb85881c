// SPDX-License-Identifier: BSD-3-Clause
#include "duplicates.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>

namespace hypermap {
namespace {

/// Whether two objects that overlap like one are not to be merged: a detector showed them beside
/// each other, and they are not one surface. One frame suffices where one of them is new.
bool frames_refute_merge(const Object& a,
                         const Object& b,
                         const Overlap& c,
                         const AssignmentOptions& options) {
  if (std::min(c.share_of_first, c.share_of_second) >= options.one_surface_share) return false;
  const bool is_new = std::min(a.num_observations, b.num_observations) <= options.apart_frames;
  const std::size_t least = is_new ? 1 : options.apart_frames;
  return num_common_frames(a.observation_log, b.observation_log) >= least;
}

/// Parts that hide each other are never detected in one frame, and one is in view of a detection of
/// the other in no more frames, by this visible share: where one of them was cut out wrongly.
constexpr std::size_t kMostFramesTogether = 2;
constexpr double kLeastVisibleShare = 0.1;
/// Both are real by this probability: what wrong segments left here and there does not add up.
constexpr Probability kLeastReal(0.5);
/// And what they make together is not much larger than the larger one, by its diagonal.
constexpr double kMostGrowth = 1.45;

/// Whether two objects are parts of one that were never in view together. Requires: they touch.
bool are_hidden_parts(const Object& a, const Object& b, const AssignmentOptions& options) {
  if (options.hidden_part_detections == 0 ||
      std::min(a.num_observations, b.num_observations) < options.hidden_part_detections)
    return false;
  const auto best_of_a = best_detected_class(a);
  const auto best_of_b = best_detected_class(b);
  if (!best_of_a || !best_of_b || best_of_a->id != best_of_b->id) return false;
  const double larger_m = std::max(a.box.extent().norm(), b.box.extent().norm());
  if (bounding_box(a.box, b.box).extent().norm() > kMostGrowth * larger_m) return false;
  if (std::min(real_probability(a), real_probability(b)) < kLeastReal) return false;
  if (absence_run(a.observation_log).looks > 0 || absence_run(b.observation_log).looks > 0)
    return false;
  if (num_common_frames(a.observation_log, b.observation_log) > 0) return false;
  const auto together =
      num_frames_in_view_together(a.observation_log, b.observation_log, kLeastVisibleShare);
  // The newest frame's misses are not noted yet: of n frames with a detection n - 1 may have one.
  return together && *together <= kMostFramesTogether &&
         *together + 2 <= options.hidden_part_detections;
}

/// What `merged` of two objects requires; maps that were merged may have objects of two kinds.
bool have_same_options(const Object& a, const Object& b) {
  return a.belief.options() == b.belief.options() &&
         a.histogram.options() == b.histogram.options() && a.points.options() == b.points.options();
}

/// The first neighbour that is a duplicate of `id`.
std::optional<ObjectId> duplicate_of(ObjectId id,
                                     const AssociationRun& run,
                                     PointSetCache& point_sets) {
  const AssignmentOptions& options = run.options.assignment;
  const Box around = grown(run.objects.at(id).box, 2.0 * options.near_m);
  for (const ObjectId other : run.objects.query(around)) {
    if (other == id || !have_same_options(run.objects.at(id), run.objects.at(other))) continue;
    if (are_hidden_parts(run.objects.at(id), run.objects.at(other), options)) return other;
    const Overlap c = measure_overlap(point_sets.of(id), point_sets.of(other), options.near_m);
    if (is_same_object(c, options, options.merge_factor) &&
        !frames_refute_merge(run.objects.at(id), run.objects.at(other), c, options)) {
      return other;
    }
  }
  return std::nullopt;
}

}  // namespace

const PointSet& PointSetCache::of(ObjectId id) {
  const auto it = point_sets_.find(id);
  if (it != point_sets_.end()) return it->second;
  return point_sets_.emplace(id, point_set_of(objects_.at(id), near_m_)).first->second;
}

void merge_duplicates(AssociationRun& run, PointSetCache& point_sets, std::set<ObjectId> changed) {
  for (const ObjectId id : changed) point_sets.forget(id);
  while (!changed.empty()) {
    const ObjectId id = *changed.begin();
    changed.erase(changed.begin());
    if (!run.objects.contains(id)) continue;
    if (const auto duplicate = duplicate_of(id, run, point_sets)) {
      const ObjectId into = run.merge(id, *duplicate);
      point_sets.forget(id);
      point_sets.forget(*duplicate);
      changed.insert(into);
    }
  }
}

}  // namespace hypermap
