// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/layers/map_layer.hpp"

#include <string>

namespace hypermap {

Result<LayerContent> MapLayer::updated(const LayerContent& update) const {
  if (update->class_name() == class_name()) return update;
  return fail(ErrorCode::kInvalidArgument,
              "is of class " + printable(update->class_name(), 40) + ", the layer of class " +
                  printable(class_name(), 40),
              "update");
}

}  // namespace hypermap
