// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/object_relations.hpp"

#include "hypermap/core/places/vocabulary_rules.hpp"
#include "hypermap/io/archive/map_layers.hpp"

#include <utility>

namespace hypermap {

RelationGraph archive_relations(const MapArchive& archive, RelationOptions options) {
  if (!options.voxel_m && archive.octree) options.voxel_m = archive.octree->resolution_m();
  return find_relations(archive.objects,
                        archive.classes,
                        confirmed_ids_of(archive),
                        with_vocabulary(std::move(options), archive.vocabulary));
}

std::string called(const MapArchive& archive, ObjectId id) {
  const auto best = best_class(archive.objects.at(id));
  const std::string name = best ? archive.classes.name(best->id) : "unknown";
  return name + " " + std::to_string(id.value);
}

}  // namespace hypermap
