// SPDX-License-Identifier: BSD-3-Clause
#include "contact.hpp"
#include "hypermap/core/objects/assignment.hpp"
#include "policies.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace hypermap {
namespace {

/// Bodies of objects, each made once as long as the object stays as it is.
class BodyCache {
 public:
  BodyCache(const ObjectMap& objects, double near_m) : objects_(objects), near_m_(near_m) {}

  const Body& of(ObjectId id) {
    const auto it = bodies_.find(id);
    if (it != bodies_.end()) return it->second;
    return bodies_.emplace(id, body_of(objects_.at(id), near_m_)).first->second;
  }
  void forget(ObjectId id) { bodies_.erase(id); }

 private:
  const ObjectMap& objects_;
  double near_m_;
  std::map<ObjectId, Body> bodies_;
};

/// An observation and the objects that it may show.
struct Candidates {
  std::size_t observation = 0;
  std::map<ObjectId, double> affinity_of;
};

std::vector<Candidates> find_candidates(AssociationRun& run, BodyCache& bodies) {
  const AssignmentOptions& options = run.options.assignment;
  std::vector<Candidates> all;
  for (std::size_t i = 0; i < run.observations.size(); ++i) {
    if (!run.is_lasting(i)) continue;
    Candidates& candidates = all.emplace_back(Candidates{i, {}});
    const Body seen = body_of(run.observations[i], options.near_m);
    for (const ObjectId id : run.objects.query(grown(seen.box, 2.0 * options.near_m))) {
      const Contact c = contact(seen, bodies.of(id), options.near_m);
      if (is_same_thing(c, options)) candidates.affinity_of[id] = affinity(c);
    }
  }
  return all;
}

/// One to one with the largest sum of affinities. Each observation may also stay alone, at no
/// gain, so that a strong match is never given up for two weak ones.
std::vector<std::optional<ObjectId>> best_matches(const std::vector<Candidates>& all) {
  std::set<ObjectId> wanted;
  for (const Candidates& c : all) {
    for (const auto& [id, gain] : c.affinity_of) wanted.insert(id);
  }
  const std::vector<ObjectId> ids(wanted.begin(), wanted.end());
  const auto num_rows = static_cast<Eigen::Index>(all.size());
  const auto num_ids = static_cast<Eigen::Index>(ids.size());
  Eigen::MatrixXd costs = Eigen::MatrixXd::Constant(num_rows, num_ids + num_rows, kForbiddenPair);
  for (Eigen::Index row = 0; row < num_rows; ++row) {
    const auto& gains = all[static_cast<std::size_t>(row)].affinity_of;
    for (Eigen::Index column = 0; column < num_ids; ++column) {
      const auto gain = gains.find(ids[static_cast<std::size_t>(column)]);
      if (gain != gains.end()) costs(row, column) = -gain->second;
    }
    costs(row, num_ids + row) = 0.0;
  }
  std::vector<std::optional<ObjectId>> out;
  for (const auto& column : assign(costs)) {
    const bool is_object = column && *column < ids.size();
    out.push_back(is_object ? std::optional(ids[*column]) : std::nullopt);
  }
  return out;
}

ObjectId favourite(const Candidates& candidates) {
  const auto it =
      std::max_element(candidates.affinity_of.begin(),
                       candidates.affinity_of.end(),
                       [](const auto& a, const auto& b) { return a.second < b.second; });
  return it->first;
}

/// The first neighbour of `id` that came to be the same thing.
std::optional<ObjectId> twin_of(ObjectId id, const AssociationRun& run, BodyCache& bodies) {
  const AssignmentOptions& options = run.options.assignment;
  const Box around = grown(run.objects.at(id).box, 2.0 * options.near_m);
  for (const ObjectId other : run.objects.query(around)) {
    if (other == id) continue;
    const Contact c = contact(bodies.of(id), bodies.of(other), options.near_m);
    if (is_same_thing(c, options, options.merge_factor)) return other;
  }
  return std::nullopt;
}

/// Objects that were touched by this frame are merged with those that they came to overlap.
void merge_twins(AssociationRun& run, BodyCache& bodies) {
  std::set<ObjectId> open(run.report.created.begin(), run.report.created.end());
  open.insert(run.report.matched.begin(), run.report.matched.end());
  for (const ObjectId id : open) bodies.forget(id);
  while (!open.empty()) {
    const ObjectId id = *open.begin();
    open.erase(open.begin());
    if (!run.objects.contains(id)) continue;
    if (const auto twin = twin_of(id, run, bodies)) {
      const ObjectId into = run.merge(id, *twin);
      bodies.forget(id);
      bodies.forget(*twin);
      open.insert(into);
    }
  }
}

}  // namespace

void associate_by_assignment(AssociationRun& run) {
  BodyCache bodies(run.objects, run.options.assignment.near_m);
  const std::vector<Candidates> all = find_candidates(run, bodies);
  const auto matches = best_matches(all);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::size_t observation = all[i].observation;
    if (matches[i]) {
      run.match(observation, *matches[i]);
    } else if (all[i].affinity_of.empty()) {
      run.create(observation);
    } else {  // its object was shown better by another observation of this frame
      run.report.object_of_observation[observation] = favourite(all[i]);
      ++run.report.num_repeated;
    }
  }
  merge_twins(run, bodies);
}

}  // namespace hypermap
