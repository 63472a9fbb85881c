// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/objects/confirmation.hpp"

#include "objects/association/overlap.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <unordered_map>
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
    miss(Condition::kNotGone,
         absence_run(object.observation_log).looks,
         gone_rule_for(object.observation_log.num_detections(), options.gone).looks);
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

/// Objects in whose place nothing stronger stands.
class OwnPlaces {
 public:
  OwnPlaces(const ObjectMap& objects, const ConfirmationOptions& options)
      : objects_(objects), options_(options) {}

  /// The strongest of them in whose place the object lies, too. None: it has a place of its own.
  /// Points are compared of objects alone whose boxes meet.
  [[nodiscard]] const Object* stronger_than(const Object& object) {
    std::vector<std::size_t> met;
    for (const ObjectId id : objects_.query(object.box)) {
      if (const auto rank = rank_of_.find(id.value); rank != rank_of_.end())
        met.push_back(rank->second);
    }
    std::sort(met.begin(), met.end());
    for (const std::size_t rank : met) {
      const Object& stronger = *by_rank_[rank];
      if (is_same_place(points_of(object), points_of(stronger), options_) &&
          !stood_beside_in_most_frames(object, stronger, options_))
        return &stronger;
    }
    return nullptr;
  }

  /// Requires: not stronger than those added before.
  void add(const Object& object) {
    rank_of_.emplace(object.id.value, by_rank_.size());
    by_rank_.push_back(&object);
  }

 private:
  const PointSet& points_of(const Object& object) {
    const auto [place, is_new] = points_.try_emplace(object.id.value);
    if (is_new) place->second = point_set_of(object, kNearM);
    return place->second;
  }

  const ObjectMap& objects_;
  const ConfirmationOptions& options_;
  std::vector<const Object*> by_rank_;
  std::unordered_map<std::uint32_t, std::size_t> rank_of_;
  std::unordered_map<std::uint32_t, PointSet> points_;
};

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
  OwnPlaces places(objects, options);
  for (const Candidate& candidate : candidates) {
    if (const Object* stronger = places.stronger_than(*candidate.object)) {
      results[candidate.result].missed.push_back(
          {.condition = Condition::kOwnPlace, .stronger = stronger->id});
    } else {
      places.add(*candidate.object);
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
