// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/byte_source.hpp"
#include "hypermap/io/codec/text_file.hpp"
#include "hypermap/io/dataset/trajectory_file.hpp"
#include "trajectory_lines.hpp"

#include <array>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

struct PoseLine {
  InputFromCamera input_from_camera;
  bool is_normalised = false;
};

/// 12 numbers get the last row that they leave out.
Result<PoseLine> matrix_of(const std::vector<std::string_view>& words,
                           const TrajectoryOptions& options) {
  std::vector<double> rows;
  rows.reserve(16);
  for (const std::string_view word : words) {
    const bool is_position = rows.size() < 12 && rows.size() % 4 == 3;
    HYPERMAP_ASSIGN_OR_RETURN(
        const double number,
        is_position ? position_number(word, "pose") : finite_number(word, "pose"));
    rows.push_back(number);
  }
  if (rows.size() == 12) rows.insert(rows.end(), {0.0, 0.0, 0.0, 1.0});
  HYPERMAP_ASSIGN_OR_RETURN(const Eigen::Isometry3d pose,
                            rigid_from_rows(rows, options.max_rotation_error));
  Eigen::Matrix3d written;
  written << rows[0], rows[1], rows[2], rows[4], rows[5], rows[6], rows[8], rows[9], rows[10];
  return PoseLine{InputFromCamera(pose), rotation_error(written) > kMinReportedNormError};
}

Result<PoseLine> parse_pose_line(std::string_view line,
                                 std::size_t num_words,
                                 const TrajectoryOptions& options) {
  HYPERMAP_TRY(check_line_length(line, options));
  const auto words = split_words(line);
  if (!is_pose_without_stamp(words.size())) {
    return fail(ErrorCode::kMalformedFile,
                "must have 16 numbers (4x4), 12 (3x4) or 7 (tx ty tz qx qy qz qw), has " +
                    std::to_string(words.size()) +
                    (words.size() == 8 ? ": with a stamp it is `trajectory_format: tum`" : ""),
                "line");
  }
  if (words.size() != num_words) {
    return fail(ErrorCode::kMalformedFile,
                "must have " + std::to_string(num_words) + " numbers as the lines before, has " +
                    std::to_string(words.size()),
                "line");
  }
  if (num_words != 7) return matrix_of(words, options);
  HYPERMAP_ASSIGN_OR_RETURN(const QuaternionPose pose,
                            quaternion_pose(words, options.max_rotation_error));
  return PoseLine{InputFromCamera(pose.pose), pose.norm_error > kMinReportedNormError};
}

}  // namespace

Result<Loaded<NumberedTrajectory>> read_pose_lines(const std::filesystem::path& path,
                                                   const TrajectoryOptions& options) {
  HYPERMAP_TRY(validate(options));
  HYPERMAP_ASSIGN_OR_RETURN(const std::string text, read_file(path, options.max_file_bytes));
  Loaded<NumberedTrajectory> loaded;
  std::uint64_t number = 0;
  std::size_t num_words = 0;
  for (const TextLine& line : split_lines(text)) {
    if (is_comment(line.text)) continue;
    if (num_words == 0) num_words = split_words(line.text).size();
    const auto pose = parse_pose_line(line.text, num_words, options);
    if (pose) {
      loaded.value.poses.push_back({number, pose->input_from_camera, line.number});
      loaded.value.num_normalised += pose->is_normalised ? 1U : 0U;
    } else if (Error error = in_file(pose.error(), path, line.number); options.skip_bad_lines) {
      loaded.findings.push_back({Severity::kWarning, std::move(error)});
    } else {
      return Unexpected(std::move(error));
    }
    ++number;
  }
  if (auto cut = find_cut_number(text, path)) loaded.findings.push_back(std::move(*cut));
  return finished(std::move(loaded), path);
}

}  // namespace hypermap
