// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/objects/confirmation.hpp"

#include "objects/association/overlap.hpp"

#include <algorithm>
#include <cstddef>
#include <tuple>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

constexpr double kNearM = 0.025;

/// The conditions on the object alone that it misses.
std::vector<MissedCondition> missed_alone(const Object& object,
                                          const ConfirmationOptions& options) {
  std::vector<MissedCondition> missed;
  const auto miss = [&](Condition condition, double value, double limit) {
    missed.push_back({.condition = condition, .value = value, .limit = limit});
  };
  if (object.num_observations < options.min_observations)
    miss(Condition::kObservations, object.num_observations, options.min_observations);
  if (!object.belief.best()) miss(Condition::kClass, 0.0, 1.0);
  if (is_gone(object.observation_log, options.gone))
    miss(Condition::kNotGone, absence_run(object.observation_log).looks, options.gone.looks);
  if (const auto least = options.min_real_probability) {
    const Probability real = real_probability(object);
    if (real < *least) miss(Condition::kRealProbability, real.value(), least->value());
  }
  if (const auto least = options.min_existence; least && !(object.existence > *least))
    miss(Condition::kExistence, object.existence.value(), least->value());
  if (const auto least = options.min_confidence) {
    const Probability confidence = object_confidence(object, options.confidence);
    if (confidence < *least) miss(Condition::kConfidence, confidence.value(), least->value());
  }
  return missed;
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

std::vector<ConfirmationResult> confirmation_results(const ObjectMap& objects,
                                                     const ConfirmationOptions& options) {
  std::vector<ConfirmationResult> results;
  results.reserve(objects.objects().size());
  struct Candidate {
    const Object* object;
    std::size_t result;
  };
  std::vector<Candidate> candidates;
  for (const Object& object : objects.objects()) {
    results.push_back({object.id, missed_alone(object, options)});
    if (results.back().missed.empty()) candidates.push_back({&object, results.size() - 1});
  }
  if (!options.one_per_place) return results;
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    return is_stronger(*a.object, *b.object);
  });
  struct Taken {
    const Object* object;
    PointSet points;
  };
  std::vector<Taken> taken;
  for (const Candidate& candidate : candidates) {
    const Object& object = *candidate.object;
    PointSet points = point_set_of(object, kNearM);
    const auto stronger = std::find_if(taken.begin(), taken.end(), [&](const Taken& other) {
      return is_same_place(points, other.points, options) &&
             !stood_beside_in_most_frames(object, *other.object, options);
    });
    if (stronger == taken.end()) {
      taken.push_back({&object, std::move(points)});
    } else {
      results[candidate.result].missed.push_back(
          {.condition = Condition::kOwnPlace, .stronger = stronger->object->id});
    }
  }
  return results;
}

std::vector<ObjectId> confirmed_objects(const ObjectMap& objects,
                                        const ConfirmationOptions& options) {
  std::vector<ObjectId> ids;
  for (const ConfirmationResult& result : confirmation_results(objects, options)) {
    if (result.missed.empty()) ids.push_back(result.id);
  }
  return ids;
}

}  // namespace hypermap
