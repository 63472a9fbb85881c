// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Where the camera was: trajectories in the forms of TUM, 7-Scenes and Open3D, and without stamps.
#pragma once

#include "hypermap/core/base/ids.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/frames.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap {

struct OptionTable;

struct TrajectoryOptions {
  /// False: one bad line refuses the file. True: it is skipped, and a finding names it.
  bool skip_bad_lines = false;
  /// A faster move between two poses is a finding; 0: never. Unit: m/s. Range: >= 0
  double max_speed_m_per_s = 20.0;
  /// Rotations are normalised; one whose norm (or a product of its rows) is off by more refuses its
  /// line. As a share of 1. Range: 0 .. 1
  double max_rotation_error = 1e-2;
  std::size_t max_file_bytes = std::size_t{256} << 20U;  ///< A larger file is refused.
  std::size_t max_line_bytes = 4096;                     ///< A longer line is refused.
};

/// Errors: kInvalidArgument naming the field.
[[nodiscard]] Result<void> validate(const TrajectoryOptions& options);
[[nodiscard]] const OptionTable& option_table(const TrajectoryOptions& options);

struct StampedPose {
  Stamp stamp;
  InputFromCamera input_from_camera;
  int line = 0;
};

/// Poses in the order of time.
struct StampedTrajectory {
  std::vector<StampedPose> poses;
  std::size_t num_repeated = 0;    ///< The same stamp with the same pose; kept once.
  std::size_t num_normalised = 0;  ///< Rotations off by more than 1e-3.
};

/// Reads lines `t tx ty tz qx qy qz qw`, `#` begins a comment, blanks are free.
///
/// Stamps are seconds or nanoseconds (1e17 and more), exact to the nanosecond; one file has one
/// unit. Errors: those of validate(options); kIo; kLimit; kMalformedFile naming line and field: not
/// eight numbers, a number that is not finite, a position beyond 1e8 m, a quaternion whose norm is
/// off, time that runs back, a stamp twice with two poses, no pose at all. Findings: skipped lines,
/// jumps, stamps that lost digits, normalised rotations, an end that looks cut inside the last
/// number.
[[nodiscard]] Result<Loaded<StampedTrajectory>> read_tum_trajectory(
    const std::filesystem::path& path, const TrajectoryOptions& options = {});

struct NumberedPose {
  std::uint64_t number = 0;  ///< Of the record's header.
  InputFromCamera input_from_camera;
  int line = 0;
};

/// In the order of the file.
struct NumberedTrajectory {
  std::vector<NumberedPose> poses;
  std::size_t num_normalised = 0;
};

/// Reads Open3D's log: records of a header `i i n` and a 4x4 matrix, camera to world. The first
/// number of the header counts.
///
/// Errors: as above, and kMalformedFile for a record that is cut or a number that occurs twice.
[[nodiscard]] Result<Loaded<NumberedTrajectory>> read_log_trajectory(
    const std::filesystem::path& path, const TrajectoryOptions& options = {});

/// Reads a pose a line, camera to world, without stamp: 16 numbers (a 4x4 matrix row by row), 12
/// (its upper three rows) or 7 (`tx ty tz qx qy qz qw`), in all lines alike. Numbers count lines
/// that are no comment from 0 on, those that are skipped too.
///
/// Errors: as above; kMalformedFile for a line of another length.
[[nodiscard]] Result<Loaded<NumberedTrajectory>> read_pose_lines(
    const std::filesystem::path& path, const TrajectoryOptions& options = {});

/// Reads one 4x4 matrix, camera to world, as 7-Scenes and ScanNet keep one beside each image; in
/// four lines or in one.
/// Errors: those of validate(options); kIo; kMalformedFile naming line and rule (ScanNet marks lost
/// tracking by infinities).
[[nodiscard]] Result<InputFromCamera> read_pose_matrix(const std::filesystem::path& path,
                                                       const TrajectoryOptions& options = {});

/// 16 numbers, row by row, as a rigid transform: last row 0 0 0 1, rotation right-handed and
/// orthonormal within `max_rotation_error`, then made exactly so.
/// Errors: kMalformedFile naming the rule.
[[nodiscard]] Result<Eigen::Isometry3d> rigid_from_rows(const std::vector<double>& numbers,
                                                        double max_rotation_error);

/// One line `t tx ty tz qx qy qz qw`, newline included; numbers in shortest exact form.
[[nodiscard]] std::string to_tum_line(Stamp stamp, const InputFromCamera& input_from_camera);

}  // namespace hypermap
