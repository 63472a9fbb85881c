// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/objects/confirmation.hpp"

#include "objects/association/overlap.hpp"

#include <algorithm>
#include <tuple>
#include <vector>

namespace hypermap {
namespace {

constexpr double kNearM = 0.025;

bool is_confirmed(const Object& object, const ConfirmationOptions& options) {
  if (options.min_existence && !(object.existence > *options.min_existence)) return false;
  if (options.min_confidence &&
      object_confidence(object, options.confidence) < *options.min_confidence) {
    return false;
  }
  if (options.min_real_probability && real_probability(object) < *options.min_real_probability) {
    return false;
  }
  return object.num_observations >= options.min_observations && object.belief.best().has_value() &&
         !is_gone(object.observation_log, options.gone);
}

/// More often seen first, then more existence, then the older one.
bool is_stronger(const Object& a, const Object& b) {
  return std::tuple(a.num_observations, a.existence, b.id) >
         std::tuple(b.num_observations, b.existence, a.id);
}

/// Whether a detector showed them beside each other in most frames that show the weaker one.
bool stood_beside_in_most_frames(const Object& weaker,
                                 const Object& stronger,
                                 const ConfirmationOptions& options) {
  const std::size_t apart = num_common_frames(weaker.observation_log, stronger.observation_log);
  return apart >= options.apart_frames &&
         static_cast<double>(apart) >= options.apart_share * weaker.num_observations;
}

/// True when `weaker` lies on the points of `stronger`, or the reverse, and is of like size.
bool is_same_place(const PointSet& weaker,
                   const PointSet& stronger,
                   const ConfirmationOptions& options) {
  if (!weaker.box.intersects(stronger.box)) return false;
  const Overlap c = measure_overlap(weaker, stronger, kNearM);
  return std::max(c.share_of_first, c.share_of_second) >= options.same_place_share &&
         c.diagonal_ratio >= options.same_place_diagonal;
}

}  // namespace

std::vector<ObjectId> confirmed_objects(const ObjectMap& objects,
                                        const ConfirmationOptions& options) {
  std::vector<const Object*> candidates;
  for (const Object& object : objects.objects()) {
    if (is_confirmed(object, options)) candidates.push_back(&object);
  }
  std::sort(candidates.begin(), candidates.end(), [](const Object* a, const Object* b) {
    return is_stronger(*a, *b);
  });
  std::vector<ObjectId> ids;
  struct Taken {
    const Object* object;
    PointSet points;
  };
  std::vector<Taken> taken;
  for (const Object* object : candidates) {
    PointSet point_set = point_set_of(*object, kNearM);
    const bool is_duplicate =
        options.one_per_place &&
        std::any_of(taken.begin(), taken.end(), [&](const Taken& stronger) {
          return is_same_place(point_set, stronger.points, options) &&
                 !stood_beside_in_most_frames(*object, *stronger.object, options);
        });
    if (is_duplicate) continue;
    ids.push_back(object->id);
    taken.push_back({object, std::move(point_set)});
  }
  std::sort(ids.begin(), ids.end());
  return ids;
}

}  // namespace hypermap
