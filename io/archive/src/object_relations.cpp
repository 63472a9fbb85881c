// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/object_relations.hpp"

#include "hypermap/core/objects/object_beliefs.hpp"
#include "hypermap/core/places/vocabulary_rules.hpp"
#include "hypermap/io/archive/map_layers.hpp"

#include <utility>

namespace hypermap {

RelationGraph archive_relations(const MapArchive& archive, RelationOptions options) {
  if (!options.voxel_m && archive.octree) options.voxel_m = archive.octree->resolution_m();
  if (!options.floor_m) options.floor_m = archive.floor.height_m;
  return find_relations(archive.objects,
                        archive.classes,
                        confirmed_ids_of(archive),
                        with_vocabulary(std::move(options), archive.vocabulary));
}

std::string called(const MapArchive& archive, ObjectId id) {
  return best_class_name(archive.objects.at(id), archive.classes) + " " + std::to_string(id.value);
}

}  // namespace hypermap
