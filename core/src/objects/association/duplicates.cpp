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

/// Both are real by this probability: what wrong segments left here and there does not add up.
constexpr Probability kLeastReal(0.5);

/// Whether two objects of one class, seen so often, can be parts of one at all. Requires: they
/// touch.
bool may_be_parts(const Object& a, const Object& b, const AssignmentOptions& options) {
  if (options.hidden_part_detections == 0 ||
      std::min(a.num_observations, b.num_observations) < options.hidden_part_detections)
    return false;
  const auto best_of_a = best_detected_class(a);
  const auto best_of_b = best_detected_class(b);
  return best_of_a && best_of_b && best_of_a->id == best_of_b->id &&
         std::min(real_probability(a), real_probability(b)) >= kLeastReal &&
         absence_run(a.observation_log).looks == 0 && absence_run(b.observation_log).looks == 0;
}

/// The frames that had both in view by this visible share of each; none when some are forgotten.
std::optional<DetectionsInView> all_in_view(const Object& a, const Object& b, double share) {
  const auto seen = detections_in_view(a.observation_log, b.observation_log, share);
  return seen && seen->is_complete ? seen : std::nullopt;
}

/// Whether two parts were never in view together: they are never detected in one frame, and one is
/// in view of a detection of the other in no more frames than where one was cut out wrongly. What
/// they make together is not much larger than the larger one, by its diagonal.
bool hide_each_other(const Object& a, const Object& b, const AssignmentOptions& options) {
  constexpr double kLeastVisibleShare = 0.1;
  constexpr std::size_t kMostFrames = 2;
  constexpr double kMostGrowth = 1.45;
  const double larger_m = std::max(a.box.extent().norm(), b.box.extent().norm());
  if (bounding_box(a.box, b.box).extent().norm() > kMostGrowth * larger_m) return false;
  const auto seen = all_in_view(a, b, kLeastVisibleShare);
  // The newest frame's misses are not noted yet: of n frames with a detection n - 1 may have one.
  return seen && seen->of_both == 0 && seen->of_any() <= kMostFrames &&
         seen->of_any() + 2 <= options.hidden_part_detections;
}

/// Whether each detection shows one of two parts that are in view together, most of each: far fewer
/// frames detect both than if they were two things, by which wrong segments are left over. So of a
/// chair at a table whose back alone is seen from behind. The larger one holds most of the box
/// around both, and the other is no small thing beside it or in it.
bool exclude_each_other(const Object& a, const Object& b, const AssignmentOptions& options) {
  constexpr double kLeastVisibleShare = 0.5;
  constexpr double kMostGrowth = 1.45;  // Of the volume: 2 and more of equal things side by side.
  constexpr double kLeastExpected = 6.0;
  constexpr double kMostShareOfExpected = 0.3;
  const auto [smaller_m, larger_m] = std::minmax({a.box.extent().norm(), b.box.extent().norm()});
  const double larger_m3 = std::max(a.box.extent().prod(), b.box.extent().prod());
  if (smaller_m < options.part_diagonal * larger_m ||
      bounding_box(a.box, b.box).extent().prod() > kMostGrowth * larger_m3)
    return false;
  const auto seen = all_in_view(a, b, kLeastVisibleShare);
  if (!seen) return false;
  const double expected = seen->expected_of_both();
  return expected >= kLeastExpected &&
         static_cast<double>(seen->of_both) <= kMostShareOfExpected * expected;
}

/// Whether two objects are parts of one. Requires: they touch.
bool are_parts_of_one(const Object& a, const Object& b, const AssignmentOptions& options) {
  return may_be_parts(a, b, options) &&
         (hide_each_other(a, b, options) || exclude_each_other(a, b, options));
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
    if (are_parts_of_one(run.objects.at(id), run.objects.at(other), options)) return other;
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
