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
