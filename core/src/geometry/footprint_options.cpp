// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/base/option_rows.hpp"
#include "hypermap/core/geometry/occupancy_votes.hpp"

namespace hypermap {
namespace {

using Points = OccupancyVotesOptions;

constexpr OptionRow kPointsRows[] = {
    option::number<&Points::edge_m>(
        "edge_m",
        {0.001, 1},
        {.unit = "m", .effect = "Edge of a cell of the object's own points."}),
    option::count<&Points::max_cells>(
        "max_cells", {64, 65536}, {.effect = "More make cells twice as wide."}),
    option::number<&Points::min_vote_share>(
        "min_vote_share",
        {0, 1},
        {.effect = "A cell with fewer votes does not count.", .hypermap = 0.0}),
    option::number<&Points::min_block_share>(
        "min_block_share",
        {0, 1},
        {.effect = "Nor does one whose block of 4 x 4 x 4 has fewer.", .hypermap = 0.0}),
};

}  // namespace

const OptionTable& option_table(const OccupancyVotesOptions&) {
  static constexpr OptionTable kTable{kPointsRows};
  return kTable;
}

Result<void> validate(const OccupancyVotesOptions& options) {
  return check_options(options);
}

}  // namespace hypermap
