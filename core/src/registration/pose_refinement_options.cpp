// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/base/option_rows.hpp"
#include "hypermap/core/registration/pose_refinement.hpp"

namespace hypermap {
namespace {

constexpr std::string_view kRefinementNames[] = {"none", "point_to_plane"};

constexpr OptionRow kRefinementRows[] = {
    option::choice<&PoseRefinementOptions::rule>(
        "rule",
        kRefinementNames,
        {.effect = "Whether given poses are refined by the surfaces that other frames showed."}),
    option::number<&PoseRefinementOptions::sigma_m>(
        "sigma_m",
        option::above(0, 1),
        {.unit = "m", .effect = "Error to expect of each coordinate of a given position."}),
    option::number<&PoseRefinementOptions::sigma_rad>(
        "sigma_rad",
        option::above(0, 0.5),
        {.unit = "rad", .effect = "Error to expect of a given orientation about each axis."}),
    option::number<&PoseRefinementOptions::max_translation_m>(
        "max_translation_m",
        option::above(0, 2),
        {.unit = "m", .effect = "A larger correction is refused; the given pose is used."}),
    option::number<&PoseRefinementOptions::max_rotation_rad>(
        "max_rotation_rad",
        option::above(0, 0.5),
        {.unit = "rad", .effect = "A larger correction is refused; the given pose is used."}),
    option::number<&PoseRefinementOptions::cell_m>(
        "cell_m",
        {0.02, 1},
        {.unit = "m",
         .effect = "Edge of the large cells in which surfaces are kept; small ones have half."}),
    option::count<&PoseRefinementOptions::max_cells>(
        "max_cells",
        {1024, 16'777'216},
        {.effect = "Of either size, those seen least recently go first; 130 B each."}),
    option::count<&PoseRefinementOptions::num_points>(
        "num_points", {200, 100'000}, {.effect = "Pixels that are brought onto the surfaces."}),
    option::number<&PoseRefinementOptions::max_depth_m>(
        "max_depth_m",
        option::above(0, 100),
        {.unit = "m", .effect = "Farther pixels are left out."}),
    option::count<&PoseRefinementOptions::window_frames>(
        "window_frames",
        {1, 1000},
        {.effect = "Corrections are none on the mean over about so many frames."}),
    option::count<&PoseRefinementOptions::lag_frames>(
        "lag_frames",
        {0, 1000},
        {.effect = "Later frames that a frame of a sequence waits for; 2 to 3 MB each."}),
};

}  // namespace

const OptionTable& option_table(const PoseRefinementOptions&) {
  static constexpr OptionTable kTable{kRefinementRows};
  return kTable;
}

Result<void> validate(const PoseRefinementOptions& options) {
  return check_options(options);
}

}  // namespace hypermap
