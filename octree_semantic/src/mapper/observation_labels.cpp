// SPDX-License-Identifier: BSD-3-Clause
#include "mapper/observation_labels.hpp"

#include <cstddef>
#include <utility>

namespace hypermap {

std::vector<PixelLabels> observation_labels(std::vector<Observation> observations,
                                            const AssociationReport& association) {
  std::vector<PixelLabels> labels;
  labels.reserve(observations.size());
  for (std::size_t i = 0; i < observations.size(); ++i) {
    labels.push_back({.object = association.object_of_observation[i],
                      .class_scores = std::move(observations[i].class_scores),
                      .pixel_indices = std::move(observations[i].segment.pixel_indices)});
  }
  return labels;
}

}  // namespace hypermap
