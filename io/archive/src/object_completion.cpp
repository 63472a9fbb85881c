// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/object_completion.hpp"

#include "hypermap/io/archive/map_layers.hpp"

namespace hypermap {

std::map<ObjectId, Box> completed_boxes(const MapArchive& archive) {
  const auto confirmed = confirmed_ids_of(archive);
  const UsualSizes usual = usual_sizes(archive.objects, confirmed);
  const KnownFree is_free = [&archive](const PointInMap& point) {
    if (!archive.octree) return false;
    const auto leaf = archive.octree->at(point);
    return leaf && !leaf->occupied;
  };
  std::map<ObjectId, Box> boxes;
  for (const ObjectId id : confirmed) {
    const auto box = completed_box(archive.objects.at(id), usual, is_free);
    if (box) boxes.emplace(id, *box);
  }
  return boxes;
}

}  // namespace hypermap
