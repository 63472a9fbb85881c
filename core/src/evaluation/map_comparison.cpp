// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/evaluation/map_comparison.hpp"

#include <algorithm>
#include <string>
#include <vector>

namespace hypermap {
namespace {

bool is_of_same_truth(const EvaluationReport& first, const EvaluationReport& second) {
  return std::equal(first.truths.begin(),
                    first.truths.end(),
                    second.truths.begin(),
                    second.truths.end(),
                    [](const auto& a, const auto& b) { return a.truth_index == b.truth_index; });
}

}  // namespace

Result<MapComparison> compare(const EvaluationReport& first, const EvaluationReport& second) {
  if (!is_of_same_truth(first, second)) {
    return fail(ErrorCode::kInvalidArgument,
                "reports must be of the same truths, are of " +
                    std::to_string(first.truths.size()) + " and " +
                    std::to_string(second.truths.size()));
  }
  std::vector<double> first_jaccard;
  std::vector<double> second_jaccard;
  std::vector<double> first_distance_m;
  std::vector<double> second_distance_m;
  for (std::size_t i = 0; i < first.truths.size(); ++i) {
    const TruthResult& a = first.truths[i];
    const TruthResult& b = second.truths[i];
    if (!a.nearest_map_index || !b.nearest_map_index) continue;
    first_jaccard.push_back(a.aligned_jaccard);
    second_jaccard.push_back(b.aligned_jaccard);
    first_distance_m.push_back(a.nearest_distance_m);
    second_distance_m.push_back(b.nearest_distance_m);
  }
  // Is the first map's Jaccard index greater, is the second map's distance greater?
  HYPERMAP_ASSIGN_OR_RETURN(const auto jaccard, wilcoxon_one_sided(first_jaccard, second_jaccard));
  HYPERMAP_ASSIGN_OR_RETURN(const auto distance,
                            wilcoxon_one_sided(second_distance_m, first_distance_m));
  return MapComparison{jaccard, distance};
}

}  // namespace hypermap
