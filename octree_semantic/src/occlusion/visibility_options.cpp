// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/base/option_rows.hpp"
#include "hypermap/octree_semantic/occlusion/object_visibility.hpp"

namespace hypermap {
namespace {

constexpr OptionRow kVisibilityRows[] = {
    option::count<&VisibilityOptions::max_rays>(
        "max_rays", {1, 65536}, {.effect = "Rays to one object at most."}),
    option::number<&VisibilityOptions::max_range_m>(
        "max_range_m",
        option::above(0, 100000),
        {.unit = "m",
         .effect = "Farther points are out of view; none: as integration.max_range_m."}),
    option::number<&VisibilityOptions::depth_tolerance_m>(
        "depth_tolerance_m",
        {0, 10},
        {.unit = "m", .effect = "Measured and expected depth agree within this,"}),
    option::number<&VisibilityOptions::depth_tolerance_per_m2>(
        "depth_tolerance_per_m2",
        {0, 10},
        {.unit = "1/m", .effect = "plus this times the depth squared."}),
    option::number<&VisibilityOptions::min_in_view_share>(
        "min_in_view_share", {0, 1}, {.effect = "Less of the object in the image: out of view."}),
    option::number<&VisibilityOptions::min_open_share>(
        "min_open_share", {0, 1}, {.effect = "Less of it open to the camera: occluded."}),
    option::number<&VisibilityOptions::absent_share>(
        "absent_share",
        {0, 1},
        {.effect =
             "At least so much shows what lies behind, and so much of all that is not hidden: "
             "absent."}),
    option::number<&VisibilityOptions::partly_occluded_share>(
        "partly_occluded_share",
        {0, 1},
        {.effect = "At least so much is hidden: partly occluded."}),
};

}  // namespace

const OptionTable& option_table(const VisibilityOptions&) {
  static constexpr OptionTable kTable{kVisibilityRows};
  return kTable;
}

Result<void> validate(const VisibilityOptions& options) {
  return check_options(options);
}

}  // namespace hypermap
