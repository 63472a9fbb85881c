// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "export_parts.hpp"

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

}  // namespace hypermap
