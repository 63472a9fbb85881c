// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/octree_semantic/octree/sensor_model.hpp"

#include <string>

namespace hypermap {
namespace {

constexpr double kSmallest = 1e-6;

Unexpected refuse(const std::string& rule, Probability value, const std::string& field) {
  return fail(ErrorCode::kInvalidArgument, rule + ", is " + std::to_string(value.value()), field);
}

bool within(Probability p, double low, double high) {
  return p.value() >= low && p.value() <= high;
}

}  // namespace

Result<void> validate(const SensorModelOptions& options) {
  if (!(options.hit.value() > 0.5) || !within(options.hit, kSmallest, 1.0 - kSmallest)) {
    return refuse("must be in (0.5, 0.999999]", options.hit, "hit");
  }
  if (!(options.miss.value() < 0.5) || !within(options.miss, kSmallest, 1.0 - kSmallest)) {
    return refuse("must be in [0.000001, 0.5)", options.miss, "miss");
  }
  if (!(options.clamp_min.value() < 0.5) || !within(options.clamp_min, kSmallest, 0.5)) {
    return refuse("must be in [0.000001, 0.5)", options.clamp_min, "clamp_min");
  }
  if (!(options.clamp_max.value() > 0.5) || !within(options.clamp_max, 0.5, 1.0 - kSmallest)) {
    return refuse("must be in (0.5, 0.999999]", options.clamp_max, "clamp_max");
  }
  if (!within(options.occupied_from, options.clamp_min.value(), options.clamp_max.value())) {
    return refuse(
        "must lie between clamp_min and clamp_max", options.occupied_from, "occupied_from");
  }
  return {};
}

Result<SensorModel> SensorModel::create(const SensorModelOptions& options) {
  HYPERMAP_TRY(validate(options));
  return SensorModel{.hit = to_milli(LogOdds::of(options.hit)),
                     .miss = to_milli(LogOdds::of(options.miss)),
                     .clamp_min = to_milli(LogOdds::of(options.clamp_min)),
                     .clamp_max = to_milli(LogOdds::of(options.clamp_max)),
                     .occupied_from = to_milli(LogOdds::of(options.occupied_from))};
}

}  // namespace hypermap
