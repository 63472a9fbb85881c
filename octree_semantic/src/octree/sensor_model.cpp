// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/octree_semantic/octree/sensor_model.hpp"

namespace hypermap {

Result<SensorModel> SensorModel::create(const SensorModelOptions& options) {
  HYPERMAP_TRY(validate(options));
  return SensorModel{.hit = to_milli(LogOdds::of(options.hit)),
                     .miss = to_milli(LogOdds::of(options.miss)),
                     .clamp_min = to_milli(LogOdds::of(options.clamp_min)),
                     .clamp_max = to_milli(LogOdds::of(options.clamp_max)),
                     .occupied_from = to_milli(LogOdds::of(options.occupied_from))};
}

}  // namespace hypermap
