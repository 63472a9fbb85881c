// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/places/relation_options.hpp"

#include "hypermap/core/base/option_rows.hpp"
#include "hypermap/core/geometry/map_floor.hpp"
#include "places/class_rules.hpp"

namespace hypermap {
namespace {

constexpr OptionRow kRelationRows[] = {
    option::number<&RelationOptions::voxel_m>(
        "voxel_m",
        {0.001, 1},
        {.unit = "m",
         .effect = "Edge in which gaps are measured; none: that of the map's voxels."}),
    option::number<&RelationOptions::gap_voxels>(
        "gap_voxels",
        {0, 10},
        {.unit = "voxels",
         .effect = "A foot may be so far above its support: segments lose their lowest points."}),
    option::number<&RelationOptions::sink_voxels>(
        "sink_voxels",
        {0, 10},
        {.unit = "voxels",
         .effect = "A foot may be so far below it: segments take some of the support's points."}),
    option::number<&RelationOptions::floor_m>(
        "floor_m",
        {-kMaxFloorHeightM, kMaxFloorHeightM},
        {.unit = "m", .effect = "Height of the floor; none: that of the map's."}),
    option::number<&RelationOptions::min_support_share>(
        "min_support_share",
        option::above(0, 1),
        {.effect = "Share of a footprint over its support: with less it would fall."}),
    option::number<&RelationOptions::min_surface_share>(
        "min_surface_share",
        option::above(0, 1),
        {.effect = "Share of the surface around a foot at its height: a wall has less."}),
    option::number<&RelationOptions::min_under_share>(
        "min_under_share",
        option::above(0, 1),
        {.effect = "Share of a plan below the other's underside: most of it."}),
    option::number<&RelationOptions::max_clearance_m>(
        "max_clearance_m",
        {0, 100},
        {.unit = "m", .effect = "Free height above: nobody says under of a ceiling."}),
    option::number<&RelationOptions::min_inside_share>(
        "min_inside_share",
        option::above(0, 1),
        {.effect = "Share of a volume in its holder: a spoon in a cup sticks out."}),
    option::names<&RelationOptions::holders>("holders", {.effect = "Classes that hold others."}),
    option::number<&RelationOptions::min_part_share>(
        "min_part_share",
        option::above(0, 1),
        {.effect = "Share of a part's volume in the whole: what sticks out is on it."}),
    option::number<&RelationOptions::min_contact_share>(
        "min_contact_share",
        option::above(0, 1),
        {.effect = "Share of a part's surface on that of the whole."}),
    option::names<&RelationOptions::parts>(
        "parts", {.effect = "Which class is a part of which, as \"part of whole\"."}),
    option::number<&RelationOptions::reach_share>(
        "reach_share",
        {0, 10},
        {.effect = "Beside: gap over the longest horizontal side of the smaller one."}),
    option::number<&RelationOptions::least_reach_m>(
        "least_reach_m",
        {0, 100},
        {.unit = "m", .effect = "Beside: gap that small things may have, too; a hand's width."}),
    option::number<&RelationOptions::max_reach_m>(
        "max_reach_m",
        {0, 100},
        {.unit = "m", .effect = "Beside: gap that large things may not exceed; a step."}),
    option::number<&RelationOptions::max_foot_share>(
        "max_foot_share",
        {0, 1},
        {.effect =
             "Beside: feet differ at most by this share of the lower one's height: a foot may "
             "be hidden, a chair is not beside the cups on its table."}),
    option::count<&RelationOptions::max_beside>(
        "max_beside", {0, 64}, {.effect = "Beside: the nearest ones of an object."}),
};

Result<void> check_parts(const RelationOptions& options) {
  for (const std::string& text : options.parts) {
    if (parse_part(text)) continue;
    return fail(ErrorCode::kInvalidArgument,
                "must be \"part of whole\", is \"" + printable(text, 80) + "\"",
                "parts");
  }
  return check_above("least_reach_m", options.least_reach_m, "max_reach_m", options.max_reach_m);
}

}  // namespace

const OptionTable& option_table(const RelationOptions&) {
  static constexpr OptionTable kTable{kRelationRows, kRule<check_parts>};
  return kTable;
}

Result<void> validate(const RelationOptions& options) {
  return check_options(options);
}

}  // namespace hypermap
