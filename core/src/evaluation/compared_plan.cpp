// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/evaluation/compared_plan.hpp"

#include "hypermap/core/base/class_registry.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace hypermap {
namespace {

ComparedShape compared_shape(const ComparedObjects& from, std::size_t index, ComparedFate fate) {
  const EvaluatedObject& object = from.objects[index];
  return {.id = from.ids[index],
          .class_name = object.class_name,
          .footprint = object.footprint,
          .centroid = object.centroid,
          .fate = fate};
}

bool is_compared(const EvaluatedObject& object, const EvaluationOptions& options) {
  const auto is_its = [&](const std::string& name) {
    return is_spelling_of(name, object.class_name);
  };
  return options.classes.empty() || std::ranges::any_of(options.classes, is_its);
}

bool holds(const std::vector<std::size_t>& ascending, std::size_t index) {
  return std::binary_search(ascending.begin(), ascending.end(), index);
}

}  // namespace

ComparedPlan compared_plan(const ComparedObjects& map,
                           const ComparedObjects& truth,
                           const EvaluationReport& report,
                           const EvaluationOptions& options) {
  ComparedPlan plan;
  std::map<std::size_t, std::size_t> truth_of_object;  // both as indices
  for (const TruthResult& result : report.truths) {
    const bool counts = !truth.objects[result.truth_index].excluded;
    const bool is_matched = counts && result.matched_map_index;
    if (is_matched) truth_of_object[*result.matched_map_index] = plan.truths.size();
    plan.truths.push_back(compared_shape(truth,
                                         result.truth_index,
                                         is_matched ? ComparedFate::kMatched
                                         : counts   ? ComparedFate::kMissed
                                                    : ComparedFate::kApart));
  }
  std::vector<std::size_t> duplicates = report.duplicates;
  std::sort(duplicates.begin(), duplicates.end());
  for (std::size_t i = 0; i < map.objects.size(); ++i) {
    if (!is_compared(map.objects[i], options)) continue;
    const auto matched = truth_of_object.find(i);
    ComparedShape shape = compared_shape(map, i, ComparedFate::kApart);
    if (matched != truth_of_object.end()) {
      shape.fate = ComparedFate::kMatched;
      shape.partner = matched->second;
      plan.truths[matched->second].partner = plan.objects.size();
    } else if (holds(duplicates, i)) {
      shape.fate = ComparedFate::kDuplicate;
    } else if (holds(report.false_positives, i)) {
      shape.fate = ComparedFate::kFalse;
    }
    plan.objects.push_back(std::move(shape));
  }
  return plan;
}

std::size_t num_of(std::span<const ComparedShape> shapes, ComparedFate fate) {
  return static_cast<std::size_t>(std::ranges::count(shapes, fate, &ComparedShape::fate));
}

}  // namespace hypermap
