// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/base/option_rows.hpp"
#include "hypermap/core/changes/map_changes.hpp"

namespace hypermap {
namespace {

constexpr OptionRow kChangeRows[] = {
    option::number<&ChangeOptions::same_place_m>(
        "same_place_m",
        {0, 100},
        {.unit = "m", .effect = "Objects of a class nearer than this may be one that stayed."}),
    option::number<&ChangeOptions::min_overlap_share>(
        "min_overlap_share",
        option::above(0, 1),
        {.effect = "Of boxes of two classes, over their union: one thing."}),
    option::number<&ChangeOptions::min_known_share>(
        "min_known_share",
        option::above(0, 1),
        {.effect = "Less of an object's points is known: not looked at."}),
    option::number<&ChangeOptions::min_free_share>(
        "min_free_share",
        option::above(0, 1),
        {.effect = "At least so much of what is known is free: nothing is there."}),
    option::number<&ChangeOptions::max_move_m>(
        "max_move_m",
        {0, 100000},
        {.unit = "m", .effect = "Farther: one is gone, another one was added."}),
    option::number<&ChangeOptions::min_size_ratio>(
        "min_size_ratio",
        option::above(0, 1),
        {.effect = "Of the diagonals of a thing that moved."}),
};

}  // namespace

const OptionTable& option_table(const ChangeOptions&) {
  static constexpr OptionTable kTable{kChangeRows};
  return kTable;
}

Result<void> validate(const ChangeOptions& options) {
  return check_options(options);
}

}  // namespace hypermap
