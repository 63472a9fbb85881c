// SPDX-License-Identifier: BSD-3-Clause
#include "exported_objects.hpp"

#include "hypermap/io/archive/map_layers.hpp"
#include "hypermap/projection/layers/semantic_layer.hpp"

namespace hypermap {
namespace {

double confidence_of(const Object& object, const SemanticLayer* semantic) {
  const SemanticObject* shape = semantic == nullptr ? nullptr : semantic->find(object.id.value);
  const auto said = shape == nullptr ? std::nullopt : confidence_of(*shape);
  return said ? *said : object_confidence(object).value();
}

}  // namespace

Result<std::vector<ExportedObject>> exported_objects(const MapArchive& archive,
                                                     const ExportRequest& request) {
  HYPERMAP_ASSIGN_OR_RETURN(const auto wanted, wanted_classes(archive, request));
  const auto* semantic = archive.hypermap.find_as<SemanticLayer>(kSemanticLayer);
  std::vector<ExportedObject> exported;
  for (const Object* object : confirmed_objects_of(archive)) {
    const auto best = best_class(*object);
    if (wanted && (!best || !wanted->contains(best->id))) continue;
    exported.push_back({.object = object,
                        .class_id = best ? std::optional(best->id) : std::nullopt,
                        .class_name = best ? archive.classes.name(best->id) : "unknown",
                        .confidence = confidence_of(*object, semantic)});
  }
  return exported;
}

}  // namespace hypermap
