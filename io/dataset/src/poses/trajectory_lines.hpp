// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What the readers of trajectories share: lines, numbers, and how faults are said.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/dataset/trajectory_file.hpp"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap {

/// Rotations that are off by more are counted when they are normalised.
inline constexpr double kMinReportedNormError = 1e-3;
/// Farther no camera stands: coordinates in UTM zones reach 1e7 m, around the earth 4e7 m.
inline constexpr double kMaxPositionM = 1e8;

/// `error` with the file, and with the line when it names none.
[[nodiscard]] Error in_file(Error error, const std::filesystem::path& path, int line);
[[nodiscard]] Finding warning(const std::filesystem::path& path,
                              int line,
                              std::string field,
                              std::string what);
/// Errors: kMalformedFile naming `field`.
[[nodiscard]] Result<double> finite_number(std::string_view word, std::string_view field);
/// A coordinate of a position. Errors: kMalformedFile naming `field`, also beyond kMaxPositionM.
[[nodiscard]] Result<double> position_number(std::string_view word, std::string_view field);
/// Errors: kLimit.
[[nodiscard]] Result<void> check_line_length(std::string_view line,
                                             const TrajectoryOptions& options);
/// Whether that many numbers are a line of `read_pose_lines`.
[[nodiscard]] constexpr bool is_pose_without_stamp(std::size_t num_words) {
  return num_words == 7 || num_words == 12 || num_words == 16;
}
struct QuaternionPose {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  double norm_error = 0.0;  ///< By how much the quaternion's norm was off 1.
};
/// `tx ty tz qx qy qz qw`. Errors: kMalformedFile naming the field, also for a quaternion whose
/// norm is off by more than `max_rotation_error`. Requires: 7 words.
[[nodiscard]] Result<QuaternionPose> quaternion_pose(std::span<const std::string_view> words,
                                                     double max_rotation_error);
/// Empty, or behind a `#`.
[[nodiscard]] bool is_comment(std::string_view line);
/// Findings: how many rotations were normalised, when there were any.
/// Errors: kMalformedFile when there is no pose.
[[nodiscard]] Result<Loaded<StampedTrajectory>> finished(Loaded<StampedTrajectory> loaded,
                                                         const std::filesystem::path& path);
[[nodiscard]] Result<Loaded<NumberedTrajectory>> finished(Loaded<NumberedTrajectory> loaded,
                                                          const std::filesystem::path& path);
/// A warning when the file probably ends inside its last number: no line end follows, and it has
/// fewer decimals than the last number of every other line of as many words. A cut that leaves as
/// many decimals cannot be told from a file whose last line end is missing.
[[nodiscard]] std::optional<Finding> find_cut_number(std::string_view text,
                                                     const std::filesystem::path& path);

}  // namespace hypermap
