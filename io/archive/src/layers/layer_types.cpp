// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/layer_types.hpp"

#include "hypermap/io/archive/grid_stack_layer.hpp"
#include "hypermap/io/archive/supercell_layer.hpp"

namespace hypermap {

LayerRegistry archive_layer_types() {
  LayerRegistry types;
  // Their names are plain and differ: neither can be refused.
  (void)types.add(GridStackLayer(), GridStackLayer::load);
  (void)types.add(SupercellLayer(), SupercellLayer::load);
  return types;
}

}  // namespace hypermap
