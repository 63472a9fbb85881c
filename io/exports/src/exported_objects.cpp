// SPDX-License-Identifier: BSD-3-Clause
#include "exported_objects.hpp"

#include "hypermap/io/archive/map_layers.hpp"

#include <cstdint>
#include <limits>

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

Result<std::vector<const SemanticObject*>> exported_shapes(
    const MapArchive& archive,
    const SemanticLayer& layer,
    const std::vector<std::string>& classes) {
  std::vector<const SemanticObject*> shapes;
  shapes.reserve(layer.objects().size());
  for (const SemanticObject& shape : layer.objects()) shapes.push_back(&shape);
  if (classes.empty()) return shapes;
  std::vector<std::string> known(archive.classes.names().begin(), archive.classes.names().end());
  for (const SemanticObject* shape : shapes) known.push_back(shape->name);
  HYPERMAP_ASSIGN_OR_RETURN(const NameSelection names, wanted_names(archive, known, classes));
  std::erase_if(shapes, [&](const SemanticObject* shape) { return !names.contains(shape->name); });
  return shapes;
}

const Object* object_of(const SemanticObject& shape,
                        const Layer& layer,
                        const MapArchive& archive) {
  const bool is_shown =
      layer.info.name == kSemanticLayer && layer.info.frame_id == shown_frame_id(archive);
  if (!is_shown || shape.id > std::numeric_limits<std::uint32_t>::max()) return nullptr;
  return archive.objects.find(ObjectId{static_cast<std::uint32_t>(shape.id)});
}

}  // namespace hypermap
