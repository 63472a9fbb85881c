// SPDX-License-Identifier: BSD-3-Clause
#include "place_amounts.hpp"

#include "hypermap/core/objects/object_beliefs.hpp"
#include "hypermap/io/archive/map_layers.hpp"
#include "hypermap/projection/layers/semantic_layer.hpp"

#include <vector>

namespace hypermap {

ClassAmounts amounts_of(const MapArchive& archive, std::span<const std::uint64_t> shape_ids) {
  const auto* shapes = archive.hypermap.find_as<SemanticLayer>(kSemanticLayer);
  std::vector<ObjectBeliefs> beliefs;
  ClassAmounts named;
  for (const std::uint64_t id : shape_ids) {
    const Object* object = archive.objects.find(ObjectId{static_cast<std::uint32_t>(id)});
    if (object != nullptr) {
      beliefs.push_back(object_beliefs(*object));
    } else {
      named[canonical_class_name(shapes->find(id)->name)] += 1.0;
    }
  }
  ClassAmounts amounts = class_amounts(beliefs, archive.classes);
  for (const auto& [name, amount] : named) amounts[name] += amount;
  ClassAmounts of_classes;
  for (const auto& [name, amount] : amounts) {
    of_classes[archive.vocabulary.class_of(name)] += amount;
  }
  return of_classes;
}

}  // namespace hypermap
