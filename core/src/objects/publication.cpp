// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/objects/publication.hpp"

#include "contact.hpp"

#include <algorithm>
#include <tuple>
#include <vector>

namespace hypermap {
namespace {

constexpr double kNearM = 0.025;

bool is_believed(const Object& object, const PublicationOptions& options) {
  if (options.min_existence && !(object.existence > *options.min_existence)) return false;
  if (options.min_confidence &&
      object_confidence(object, options.confidence) < *options.min_confidence) {
    return false;
  }
  return object.num_observations >= options.min_observations && object.belief.best().has_value();
}

/// More often seen first, then more existence, then the older one.
bool is_stronger(const Object& a, const Object& b) {
  return std::tuple(a.num_observations, a.existence, b.id) >
         std::tuple(b.num_observations, b.existence, a.id);
}

/// True when `weaker` lies on the points of `stronger`, or the reverse, and is of like size.
bool is_same_place(const Body& weaker, const Body& stronger, const PublicationOptions& options) {
  if (!weaker.box.intersects(stronger.box)) return false;
  const Contact c = contact(weaker, stronger, kNearM);
  return std::max(c.share_of_first, c.share_of_second) >= options.same_place_share &&
         c.diagonal_ratio >= options.same_place_diagonal;
}

}  // namespace

std::vector<ObjectId> published(const ObjectMap& objects, const PublicationOptions& options) {
  std::vector<const Object*> believed;
  for (const Object& object : objects.objects()) {
    if (is_believed(object, options)) believed.push_back(&object);
  }
  std::sort(believed.begin(), believed.end(), [](const Object* a, const Object* b) {
    return is_stronger(*a, *b);
  });
  std::vector<ObjectId> ids;
  std::vector<Body> taken;
  for (const Object* object : believed) {
    Body body = body_of(*object, kNearM);
    const bool is_double =
        options.one_per_place && std::any_of(taken.begin(), taken.end(), [&](const Body& stronger) {
          return is_same_place(body, stronger, options);
        });
    if (is_double) continue;
    ids.push_back(object->id);
    taken.push_back(std::move(body));
  }
  std::sort(ids.begin(), ids.end());
  return ids;
}

}  // namespace hypermap
