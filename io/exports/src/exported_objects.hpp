// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "export_parts.hpp"
#include "hypermap/projection/layers/semantic_layer.hpp"

#include <optional>
#include <string>
#include <vector>

namespace hypermap {

/// A confirmed object and what a map says of it.
struct ExportedObject {
  const Object* object = nullptr;   ///< Never null; of the archive.
  std::optional<ClassId> class_id;  ///< Its best class; none without any evidence.
  std::string class_name;           ///< Of that class, else `unknown`.
  double confidence = 0.0;          ///< Of the layer `semantic`, else `object_confidence`.
};

/// The confirmed objects of the classes that were asked for, ascending by id.
/// Valid as long as the archive is not changed. Errors: those of wanted_classes.
[[nodiscard]] Result<std::vector<ExportedObject>> exported_objects(const MapArchive& archive,
                                                                   const ExportRequest& request);

/// The shapes of a layer whose names are asked for, ascending by id; all when nothing is.
/// Errors: those of wanted_names, of which the map's classes and the names of shapes are known.
[[nodiscard]] Result<std::vector<const SemanticObject*>> exported_shapes(
    const MapArchive& archive, const SemanticLayer& layer, const std::vector<std::string>& classes);

/// The object of the 3D map under the shape's number; null when the map does not know one: only the
/// layer that shows these objects, in their frame, names them so.
[[nodiscard]] const Object* object_of(const SemanticObject& shape,
                                      const Layer& layer,
                                      const MapArchive& archive);

}  // namespace hypermap
