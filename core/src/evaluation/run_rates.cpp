// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/evaluation/run_rates.hpp"

#include "ranked_matches.hpp"

#include <algorithm>
#include <set>

namespace hypermap {
namespace {

/// The objects and truths of one class: see RankedSides; `guests` are not filled before
/// `add_guests`.
std::map<std::string, RankedSides> sides_by_class(const RatedRun& run) {
  std::map<std::string, RankedSides> sides;
  for (std::size_t o = 0; o < run.objects.size(); ++o) {
    if (!run.objects[o].is_apart) sides[run.objects[o].class_name].objects.push_back(o);
  }
  for (std::size_t t = 0; t < run.truths.size(); ++t) {
    const auto& names = run.truths[t].class_names;
    for (std::size_t i = 0; i < names.size(); ++i)
      (i == 0 ? sides[names[i]].truths : sides[names[i]].foreign_truths).push_back(t);
  }
  return sides;
}

void add_guests(const RatedRun& run, std::map<std::string, RankedSides>& sides) {
  for (auto& [name, of_class] : sides) {
    std::set<std::string> admitted;
    for (const std::size_t t : of_class.truths) {
      const auto& names = run.truths[t].class_names;
      admitted.insert(names.begin() + 1, names.end());
    }
    for (const std::string& other : admitted) {
      const auto& guests = sides.at(other).objects;
      of_class.guests.insert(of_class.guests.end(), guests.begin(), guests.end());
    }
  }
}

/// Objects that are the one of a truth.
std::vector<bool> found_objects(const RatedRun& run) {
  std::vector<bool> is_found(run.objects.size(), false);
  for (const RatedTruth& truth : run.truths) {
    if (truth.object) is_found[*truth.object] = true;
  }
  return is_found;
}

bool is_false(const RatedObject& object, bool is_found) {
  return object.is_confirmed && !object.is_apart && !is_found;
}

std::vector<FalseObject> false_objects(const RatedRun& run, const std::vector<bool>& is_found) {
  std::vector<FalseObject> out;
  for (std::size_t o = 0; o < run.objects.size(); ++o) {
    const RatedObject& object = run.objects[o];
    if (!is_false(object, is_found[o])) continue;
    out.push_back({.object_id = object.id,
                   .class_name = object.class_name,
                   .place = object.place,
                   .confidence = object.confidence});
  }
  return out;
}

std::size_t num_rejected(const RatedRun& run, const RankedSides& sides) {
  MatchSides left;
  for (const std::size_t o : sides.objects) {
    if (!run.objects[o].is_confirmed) left.objects.push_back(o);
  }
  for (const auto* truths : {&sides.truths, &sides.foreign_truths}) {
    for (const std::size_t t : *truths) {
      if (!run.truths[t].object) left.truths.push_back(t);
    }
  }
  const std::size_t num_tentative = left.objects.size();
  return num_tentative - best_matches(run, left, MatchCriterion::kDistance).size();
}

BinaryCounts counts_of(const RatedRun& run,
                       const RankedSides& sides,
                       const std::vector<bool>& is_found) {
  BinaryCounts counts;
  for (const std::size_t t : sides.truths) {
    if (!run.truths[t].counts) continue;
    ++(run.truths[t].object ? counts.true_positives : counts.false_negatives);
  }
  for (const std::size_t o : sides.objects) {
    counts.false_positives += is_false(run.objects[o], is_found[o]) ? 1U : 0U;
  }
  counts.true_negatives = std::nullopt;
  if (run.has_tentative) counts.true_negatives = num_rejected(run, sides);
  return counts;
}

TruthRun truth_run(const RatedRun& run, const RatedTruth& truth) {
  TruthRun result{
      .reference = truth.reference,
      .class_name = truth.class_names.empty() ? std::string() : truth.class_names.front(),
      .counts = truth.counts,
      .true_centre = truth.centre};
  if (!truth.object) return result;
  const RatedObject& object = run.objects[*truth.object];
  result.object_id = object.id;
  result.centre = object.centre;
  if (truth.centre && object.centre) result.error_m = *truth.centre - *object.centre;
  if (truth.box && object.box) result.overlap = intersection_over_union(*object.box, *truth.box);
  return result;
}

bool can_be_ranked(const RatedRun& run) {
  return std::all_of(run.objects.begin(), run.objects.end(), [](const RatedObject& object) {
    return object.confidence.has_value();
  });
}

}  // namespace

std::optional<double> Classifications::accuracy() const {
  if (num_all == 0) return std::nullopt;
  return static_cast<double>(num_right) / static_cast<double>(num_all);
}

Classifications& Classifications::operator+=(const Classifications& other) {
  num_all += other.num_all;
  num_right += other.num_right;
  return *this;
}

std::string_view key_of(MatchCriterion criterion) {
  constexpr std::array<std::string_view, kMatchCriteria.size()> kKeys{"gate", "iou25", "iou50"};
  return kKeys[static_cast<std::size_t>(criterion)];
}

RunRates run_rates(const RatedRun& run) {
  RunRates rates{.classifications = run.classifications,
                 .has_confidences = can_be_ranked(run),
                 .fit = run.fit};
  const std::vector<bool> is_found = found_objects(run);
  rates.truths.reserve(run.truths.size());
  for (const RatedTruth& truth : run.truths) rates.truths.push_back(truth_run(run, truth));
  rates.false_objects = false_objects(run, is_found);
  auto by_class = sides_by_class(run);
  add_guests(run, by_class);
  for (const auto& [name, sides] : by_class) {
    ClassRun& of_class = rates.classes[name];
    of_class.counts = counts_of(run, sides, is_found);
    for (const std::size_t t : sides.truths) {
      if (!run.truths[t].counts) continue;
      if (rates.truths[t].error_m) of_class.errors_m.push_back(*rates.truths[t].error_m);
      if (rates.truths[t].overlap) of_class.overlaps.push_back(*rates.truths[t].overlap);
    }
    if (!rates.has_confidences) continue;
    for (const MatchCriterion criterion : kMatchCriteria) {
      of_class.ranked[static_cast<std::size_t>(criterion)] =
          ranked_predictions(run, sides, criterion);
    }
  }
  return rates;
}

}  // namespace hypermap
