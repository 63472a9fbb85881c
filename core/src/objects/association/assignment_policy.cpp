// SPDX-License-Identifier: BSD-3-Clause
#include "duplicates.hpp"
#include "hypermap/core/objects/assignment.hpp"
#include "overlap.hpp"
#include "policies.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace hypermap {
namespace {

/// Boxes of two objects that touch have no more of the smaller one in common.
constexpr double kMostBoxShareApart = 0.5;

/// An observation and the objects that it may show.
struct Candidates {
  std::size_t observation = 0;
  PointSet seen;  ///< Of the observation.
  std::map<ObjectId, double> affinity_of;
};

std::vector<Candidates> find_candidates(AssociationRun& run, PointSetCache& point_sets) {
  const AssignmentOptions& options = run.options.assignment;
  std::vector<Candidates> all;
  for (std::size_t i = 0; i < run.observations.size(); ++i) {
    if (run.is_transient(i)) continue;
    Candidates& candidates =
        all.emplace_back(Candidates{i, point_set_of(run.observations[i], options.near_m), {}});
    const Box around = grown(candidates.seen.box, 2.0 * options.near_m);
    for (const ObjectId id : run.objects.query(around)) {
      const Overlap c = measure_overlap(candidates.seen, point_sets.of(id), options.near_m);
      if (is_same_object(c, options)) candidates.affinity_of[id] = affinity(c);
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

ObjectId best_candidate(const Candidates& candidates) {
  const auto it =
      std::max_element(candidates.affinity_of.begin(),
                       candidates.affinity_of.end(),
                       [](const auto& a, const auto& b) { return a.second < b.second; });
  return it->first;
}

/// Whether an observation shows another object than the observations that took its candidates:
/// depth has them beside each other.
bool shows_another(const AssignmentOptions& options,
                   const std::vector<Candidates>& all,
                   const std::vector<std::optional<ObjectId>>& matches,
                   std::size_t which) {
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!matches[i] || !all[which].affinity_of.contains(*matches[i])) continue;
    const Overlap c = measure_overlap(all[which].seen, all[i].seen, options.near_m);
    const bool is_beside = std::max(c.share_of_first, c.share_of_second) <= options.apart_share &&
                           c.box_share <= kMostBoxShareApart;
    if (!is_beside) return false;
  }
  return true;
}

}  // namespace

void associate_by_assignment(AssociationRun& run) {
  PointSetCache point_sets(run.objects, run.options.assignment.near_m);
  const std::vector<Candidates> all = find_candidates(run, point_sets);
  const auto matches = best_matches(all);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::size_t observation = all[i].observation;
    if (matches[i]) {
      run.match(observation, *matches[i]);
    } else if (all[i].affinity_of.empty() ||
               shows_another(run.options.assignment, all, matches, i)) {
      run.create(observation);
    } else {  // its object was shown better by another observation of this frame
      run.report.object_of_observation[observation] = best_candidate(all[i]);
      ++run.report.num_repeated;
    }
  }
  std::set<ObjectId> changed(run.report.created.begin(), run.report.created.end());
  changed.insert(run.report.matched.begin(), run.report.matched.end());
  merge_duplicates(run, point_sets, std::move(changed));
  settle_contested_cells(run);
}

}  // namespace hypermap
