// SPDX-License-Identifier: BSD-3-Clause
#include "mapper/observation_labels.hpp"

#include <algorithm>
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

std::vector<DetectedObject> detected_objects(std::span<const Observation> observations,
                                             const AssociationReport& association) {
  std::vector<DetectedObject> detected;
  detected.reserve(observations.size());
  for (std::size_t i = 0; i < observations.size(); ++i) {
    const ObjectId id = association.object_of_observation[i];
    if (id == kNoObject) continue;
    detected.push_back({.id = id,
                        .box_px = observations[i].box_px,
                        .num_pixels = observations[i].segment.pixel_indices.size(),
                        .score = observations[i].score});
  }
  return detected;
}

std::vector<ObjectId> ids_of_detected(const AssociationReport& association) {
  auto seen = association.object_of_observation;
  std::erase(seen, kNoObject);
  std::ranges::sort(seen);
  seen.erase(std::unique(seen.begin(), seen.end()), seen.end());
  return seen;
}

}  // namespace hypermap
