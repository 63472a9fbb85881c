// SPDX-License-Identifier: BSD-3-Clause
#include "ranked_matches.hpp"

#include "hypermap/core/objects/assignment.hpp"

#include <algorithm>
#include <iterator>

namespace hypermap {
namespace {

bool is_before(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
}

/// The indices in an order that does not depend on that in which they are given, but among equal
/// places.
template <class Placed>
std::vector<std::size_t> by_place(std::vector<std::size_t> indices,
                                  const std::vector<Placed>& placed) {
  std::stable_sort(indices.begin(), indices.end(), [&placed](std::size_t a, std::size_t b) {
    return is_before(placed[a].place, placed[b].place);
  });
  return indices;
}

/// What an overlap lacks to 1; kForbiddenPair below `least`.
double overlap_cost(const RatedObject& object, const RatedTruth& truth, double least) {
  if (!object.box || !truth.box) return kForbiddenPair;
  const double overlap = intersection_over_union(*object.box, *truth.box);
  if (overlap >= least) return 1.0 - overlap;
  return kForbiddenPair;
}

/// The partner of the only object: the first of the cheapest.
std::vector<std::pair<std::size_t, std::size_t>> best_match(const RatedRun& run,
                                                            std::size_t object,
                                                            const std::vector<std::size_t>& truths,
                                                            MatchCriterion criterion) {
  std::optional<std::size_t> best;
  double least = kForbiddenPair;
  for (const std::size_t t : truths) {
    const double cost = pair_cost(run.objects[object], run.truths[t], criterion);
    if (!(cost < least)) continue;
    least = cost;
    best = t;
  }
  if (!best) return {};
  return {{object, *best}};
}

/// Takes what is matched from both sides.
void remove_matched(const std::vector<std::pair<std::size_t, std::size_t>>& matches,
                    std::vector<std::size_t>& objects,
                    std::vector<std::size_t>& truths) {
  for (const auto& [o, t] : matches) {
    std::erase(objects, o);
    std::erase(truths, t);
  }
}

}  // namespace

double pair_cost(const RatedObject& object, const RatedTruth& truth, MatchCriterion criterion) {
  const auto& names = truth.class_names;
  if (std::find(names.begin(), names.end(), object.class_name) == names.end())
    return kForbiddenPair;
  switch (criterion) {
    case MatchCriterion::kDistance: {
      const double distance_m = (object.place - truth.place).norm();
      if (distance_m <= truth.gate_m) return distance_m;
      return kForbiddenPair;
    }
    case MatchCriterion::kOverlap25:
      return overlap_cost(object, truth, 0.25);
    case MatchCriterion::kOverlap50:
      return overlap_cost(object, truth, 0.5);
  }
  return kForbiddenPair;
}

std::vector<std::pair<std::size_t, std::size_t>> best_matches(const RatedRun& run,
                                                              const MatchSides& sides,
                                                              MatchCriterion criterion) {
  if (sides.objects.empty() || sides.truths.empty()) return {};
  const std::vector<std::size_t> objects = by_place(sides.objects, run.objects);
  const std::vector<std::size_t> truths = by_place(sides.truths, run.truths);
  if (objects.size() == 1) return best_match(run, objects.front(), truths, criterion);
  Eigen::MatrixXd costs(static_cast<Eigen::Index>(objects.size()),
                        static_cast<Eigen::Index>(truths.size()));
  for (Eigen::Index i = 0; i < costs.rows(); ++i) {
    for (Eigen::Index k = 0; k < costs.cols(); ++k)
      costs(i, k) = pair_cost(run.objects[objects[static_cast<std::size_t>(i)]],
                              run.truths[truths[static_cast<std::size_t>(k)]],
                              criterion);
  }
  const auto columns = assign(costs);
  std::vector<std::pair<std::size_t, std::size_t>> matches;
  matches.reserve(columns.size());
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (columns[i]) matches.emplace_back(objects[i], truths[*columns[i]]);
  }
  return matches;
}

std::vector<Prediction> ranked_predictions(const RatedRun& run,
                                           const RankedSides& sides,
                                           MatchCriterion criterion) {
  std::vector<std::size_t> ranked = sides.objects;
  ranked.insert(ranked.end(), sides.guests.begin(), sides.guests.end());
  std::sort(ranked.begin(), ranked.end(), [&run](std::size_t a, std::size_t b) {
    return *run.objects[a].confidence > *run.objects[b].confidence;
  });
  std::vector<std::size_t> counting;
  std::vector<std::size_t> apart = sides.foreign_truths;
  for (const std::size_t t : sides.truths) (run.truths[t].counts ? counting : apart).push_back(t);
  std::vector<Prediction> predictions;
  predictions.reserve(ranked.size());
  for (auto first = ranked.begin(); first != ranked.end();) {
    const double confidence = *run.objects[*first].confidence;
    const auto last = std::find_if(first, ranked.end(), [&](std::size_t o) {
      return *run.objects[o].confidence < confidence;
    });
    std::vector<std::size_t> left(first, last);
    const auto right = best_matches(run, {left, counting}, criterion);
    remove_matched(right, left, counting);
    for (const MatchCriterion at : {criterion, MatchCriterion::kDistance})
      remove_matched(best_matches(run, {left, apart}, at), left, apart);
    for (const std::size_t guest : sides.guests) std::erase(left, guest);
    predictions.insert(predictions.end(), right.size(), {confidence, true});
    predictions.insert(predictions.end(), left.size(), {confidence, false});
    first = last;
  }
  return predictions;
}

}  // namespace hypermap
