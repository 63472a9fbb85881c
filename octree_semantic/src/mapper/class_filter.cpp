// SPDX-License-Identifier: BSD-3-Clause
// Which classes reach the map, and which do not stay.
#include "hypermap/octree_semantic/mapper/semantic_mapper.hpp"

#include <algorithm>
#include <iterator>

namespace hypermap {

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
