// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/grids/layer_options.hpp"

#include "hypermap/core/base/option_rows.hpp"
#include "hypermap/core/geometry/map_floor.hpp"

namespace hypermap {
namespace {

constexpr OptionRow kLayerRows[] = {
    option::number<&LayerOptions::floor_m>(
        "floor_m",
        {-kMaxFloorHeightM, kMaxFloorHeightM},
        {.unit = "m",
         .effect = "Height of the floor; none: as stated before, else of the lowest large level "
                   "surface, else as "
                   "assumed."}),
    option::number<&LayerOptions::min_height_m>(
        "min_height_m",
        {-1000, 1000},
        {.unit = "m", .effect = "Over the floor: lower voxels are no obstacles."}),
    option::number<&LayerOptions::max_height_m>(
        "max_height_m",
        {-1000, 1000},
        {.unit = "m",
         .effect = "Over the floor: higher voxels are none either, a robot passes under them."}),
    option::number<&LayerOptions::min_free_share>(
        "min_free_share",
        option::above(0, 1),
        {.effect = "A cell is free when so much of its height was seen free."}),
    option::number<&LayerOptions::max_unseen_m>(
        "max_unseen_m",
        {0, 1000},
        {.unit = "m",
         .effect = "And the lowest of it lies at most so high over min_height_m: below may stand "
                   "what no camera saw."}),
    option::flag<&LayerOptions::carve_footprints>(
        "carve_footprints",
        {.effect = "Footprints by policy voxels lack what was looked through and where other "
                   "objects stand, and no cell under them is free; else they are convex."}),
    option::flag<&LayerOptions::class_stack>(
        "class_stack",
        {.effect = "A layer `stack` of log-odds for each class is kept beside the others."}),
};

Result<void> check_band(const LayerOptions& options) {
  return check_above("min_height_m", options.min_height_m, "max_height_m", options.max_height_m);
}

}  // namespace

const OptionTable& option_table(const LayerOptions&) {
  static constexpr OptionTable kTable{kLayerRows, kRule<check_band>};
  return kTable;
}

Result<void> validate(const LayerOptions& options) {
  return check_options(options);
}

}  // namespace hypermap
