// SPDX-License-Identifier: BSD-3-Clause
// Options of the 2D layers that are derived from the 3D map.
#include "option_row.hpp"

namespace hypermap {

std::vector<OptionRow> layer_option_rows() {
  return {
      option_row("projection.min_height_m",
                 {-1000, 1000},
                 {"m", "ours", "Lower voxels (the floor) are no obstacles."},
                 HYPERMAP_LAYER_OPTION_FIELD(min_height_m)),
      option_row("projection.max_height_m",
                 {-1000, 1000},
                 {"m", "ours", "Higher voxels are none either, a robot passes under them."},
                 HYPERMAP_LAYER_OPTION_FIELD(max_height_m)),
      option_row("projection.min_free_share",
                 {0.000001, 1},
                 {"", "ours", "A cell is free when so much of its height was seen free."},
                 HYPERMAP_LAYER_OPTION_FIELD(min_free_share)),
  };
}

}  // namespace hypermap
