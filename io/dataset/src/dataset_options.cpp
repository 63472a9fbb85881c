// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/base/option_rows.hpp"
#include "hypermap/io/dataset/dataset_reader.hpp"
#include "hypermap/io/dataset/trajectory_file.hpp"
#include "hypermap/io/dataset/up_axis.hpp"

#include <numbers>

namespace hypermap {
namespace {

constexpr OptionRow kDatasetRows[] = {
    option::flag<&DatasetOptions::find_detections>(
        "find_detections", {.effect = "Else detections in the folder are not read unless named."}),
    option::names<&DatasetOptions::detector_names>(
        "detector_names", {.effect = "Whose the first of the named detections are."}),
    option::number<&DatasetOptions::stamp_tolerance_s>(
        "stamp_tolerance_s", {0, 3600}, {.unit = "s", .effect = "Partners may be this far apart."}),
    option::count<&DatasetOptions::first>(
        "first", option::at_least(0), {.effect = "Frames before it are left out."}),
    option::count<&DatasetOptions::stride>("stride", {1, 1000000}, {.effect = "Every n-th frame."}),
    option::count<&DatasetOptions::max_frames>(
        "max_frames", {1, 1000000000}, {.effect = "So many frames at most; none: all."}),
    option::flag<&DatasetOptions::read_color>("read_color",
                                              {.effect = "Else frames have no colour image."}),
};

constexpr OptionRow kTrajectoryRows[] = {
    option::flag<&TrajectoryOptions::skip_bad_lines>(
        "skip_bad_lines", {.effect = "Else one bad line refuses the file."}),
    option::number<&TrajectoryOptions::max_speed_m_per_s>(
        "max_speed_m_per_s",
        option::at_least(0),
        {.unit = "m/s", .effect = "A faster move between two poses is a finding; 0: never."}),
    option::number<&TrajectoryOptions::max_rotation_error>(
        "max_rotation_error",
        {0, 1},
        {.effect = "A rotation whose norm is off by more refuses its line."}),
    option::count<&TrajectoryOptions::max_file_bytes>(
        "max_file_bytes",
        option::at_least(0),
        {.unit = "bytes", .effect = "A larger file is refused."}),
    option::count<&TrajectoryOptions::max_line_bytes>(
        "max_line_bytes",
        option::at_least(0),
        {.unit = "bytes", .effect = "A longer line is refused."}),
};

constexpr OptionRow kFloorRows[] = {
    option::count<&FloorOptions::num_frames>(
        "num_frames", {1, 1000}, {.effect = "Spread evenly over the sequence."}),
    option::count<&FloorOptions::pixel_step>(
        "pixel_step", {1, 64}, {.unit = "px", .effect = "Every n-th pixel each way."}),
    option::number<&FloorOptions::min_range_m>(
        "min_range_m",
        option::above(0, kUnbounded),
        {.unit = "m", .effect = "Nearer depth is not used."}),
    option::number<&FloorOptions::max_range_m>(
        "max_range_m",
        option::above(0, kUnbounded),
        {.unit = "m", .effect = "Farther depth is too noisy."}),
    option::number<&FloorOptions::max_tilt_rad>(
        "max_tilt_rad",
        {0, std::numbers::pi / 2},
        {.unit = "rad", .effect = "Of the floor's normal from the cameras' mean up."}),
    option::number<&FloorOptions::thickness_m>(
        "thickness_m",
        {0.005, 0.5},
        {.unit = "m", .effect = "Points this near to a plane lie on it."}),
    option::number<&FloorOptions::min_level_share>(
        "min_level_share",
        {0, 1},
        {.effect = "The floor is the lowest plane with this share of the level points."}),
};

Result<void> check_floor_range(const FloorOptions& options) {
  return check_above("min_range_m", options.min_range_m, "max_range_m", options.max_range_m);
}

}  // namespace

const OptionTable& option_table(const DatasetOptions&) {
  static constexpr OptionTable kTable{kDatasetRows};
  return kTable;
}

Result<void> validate(const DatasetOptions& options) {
  return check_options(options);
}

const OptionTable& option_table(const TrajectoryOptions&) {
  static constexpr OptionTable kTable{kTrajectoryRows};
  return kTable;
}

Result<void> validate(const TrajectoryOptions& options) {
  return check_options(options);
}

const OptionTable& option_table(const FloorOptions&) {
  static constexpr OptionTable kTable{kFloorRows, kRule<check_floor_range>};
  return kTable;
}

Result<void> validate(const FloorOptions& options) {
  return check_options(options);
}

}  // namespace hypermap
