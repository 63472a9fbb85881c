// SPDX-License-Identifier: BSD-3-Clause
// Which classes reach the map, and which do not stay.
#include "hypermap/core/vocabulary/asked_names.hpp"
#include "hypermap/octree_semantic/mapper/semantic_mapper.hpp"

#include <algorithm>
#include <iterator>

namespace hypermap {
namespace {

/// Errors: as asked_classes, naming the field.
Result<std::vector<ClassId>> ids_of(std::span<const std::string> names,
                                    const ClassRegistry& classes,
                                    const char* field) {
  auto ids = asked_classes(classes, {}, names);
  if (!ids) ids.error().field = field;
  return ids;
}

}  // namespace

Result<SemanticMapper::ClassFilter> SemanticMapper::ClassFilter::create(
    const SemanticMapperOptions& options, const ClassRegistry& classes) {
  ClassFilter filter;
  HYPERMAP_ASSIGN_OR_RETURN(
      filter.transient,
      ids_of(transient_names(options.objects, classes), classes, "objects.transient_class_names"));
  HYPERMAP_ASSIGN_OR_RETURN(filter.wanted,
                            ids_of(options.wanted_class_names, classes, "wanted_class_names"));
  std::erase_if(filter.transient,
                [&](ClassId id) { return std::ranges::binary_search(filter.wanted, id); });
  return filter;
}

bool SemanticMapper::ClassFilter::accepts(std::span<const ClassEvidence> class_scores) const {
  const auto best = best_class(class_scores);
  if (!best) return true;
  return !is_transient(class_scores) &&
         (wanted.empty() || std::ranges::binary_search(wanted, best->id));
}

bool SemanticMapper::ClassFilter::is_transient(std::span<const ClassEvidence> class_scores) const {
  const auto best = best_class(class_scores);
  return best && std::ranges::binary_search(transient, best->id);
}

std::vector<const Detection*> SemanticMapper::take_transient(
    std::vector<const Detection*>& detections) const {
  const auto is_transient = [this](const Detection* d) {
    return class_filter_.is_transient(d->class_scores);
  };
  std::vector<const Detection*> transient;
  std::ranges::copy_if(detections, std::back_inserter(transient), is_transient);
  std::erase_if(detections, is_transient);
  return transient;
}

std::vector<Observation> SemanticMapper::take_transient(
    std::vector<Observation>& observations) const {
  const auto first = std::stable_partition(
      observations.begin(), observations.end(), [this](const Observation& observation) {
        return !class_filter_.is_transient(observation.class_scores);
      });
  std::vector<Observation> transient(std::make_move_iterator(first),
                                     std::make_move_iterator(observations.end()));
  observations.erase(first, observations.end());
  return transient;
}

}  // namespace hypermap
