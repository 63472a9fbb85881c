// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/bounded_json.hpp"
#include "hypermap/io/codec/byte_source.hpp"
#include "hypermap/io/codec/text_file.hpp"
#include "hypermap/io/dataset/trajectory_file.hpp"
#include "trajectory_lines.hpp"

#include <Eigen/LU>
#include <Eigen/SVD>

#include <optional>
#include <set>
#include <utility>

namespace hypermap {
namespace {

Result<std::vector<double>> parse_rows(const std::vector<TextLine>& lines,
                                       std::size_t first,
                                       const std::filesystem::path& path,
                                       const TrajectoryOptions& options) {
  std::vector<double> numbers;
  for (std::size_t row = 0; row < 4; ++row) {
    if (first + row >= lines.size()) {
      return Unexpected(in_file({.code = ErrorCode::kMalformedFile,
                                 .what = "ends after " + std::to_string(row) +
                                         " rows of a matrix, expected 4 of 4 numbers",
                                 .field = "pose"},
                                path,
                                lines.empty() ? 0 : lines.back().number));
    }
    const TextLine& line = lines[first + row];
    if (auto ok = check_line_length(line.text, options); !ok) {
      return Unexpected(in_file(std::move(ok).error(), path, line.number));
    }
    const auto words = split_words(line.text);
    if (words.size() != 4) {
      return Unexpected(in_file({.code = ErrorCode::kMalformedFile,
                                 .what = "must have 4 numbers, has " + std::to_string(words.size()),
                                 .field = "pose"},
                                path,
                                line.number));
    }
    for (const std::string_view word : words) {
      const bool is_position = row < 3 && numbers.size() % 4 == 3;
      const auto number = is_position ? position_number(word, "pose") : finite_number(word, "pose");
      if (!number) return Unexpected(in_file(number.error(), path, line.number));
      numbers.push_back(*number);
    }
  }
  return numbers;
}

std::vector<TextLine> content_lines(std::string_view text) {
  std::vector<TextLine> lines = split_lines(text);
  std::erase_if(lines, [](const TextLine& line) { return is_comment(line.text); });
  return lines;
}

struct LogRecord {
  NumberedPose pose;
  bool is_normalised = false;
};

Result<LogRecord> parse_log_record(const std::vector<TextLine>& lines,
                                   std::size_t first,
                                   const std::filesystem::path& path,
                                   const TrajectoryOptions& options) {
  const TextLine& header = lines[first];
  const auto words = split_words(header.text);
  const auto number = words.size() == 3 ? parse_unsigned(words[0]) : std::nullopt;
  if (!number) {
    return Unexpected(
        in_file({.code = ErrorCode::kMalformedFile,
                 .what = "must be a header of three numbers, is " + printable(header.text, 60),
                 .field = "record"},
                path,
                header.number));
  }
  HYPERMAP_ASSIGN_OR_RETURN(const auto rows, parse_rows(lines, first + 1, path, options));
  auto pose = rigid_from_rows(rows, options.max_rotation_error);
  if (!pose) return Unexpected(in_file(std::move(pose).error(), path, header.number));
  Eigen::Matrix3d written;
  written << rows[0], rows[1], rows[2], rows[4], rows[5], rows[6], rows[8], rows[9], rows[10];
  return LogRecord{{*number, InputFromCamera(*pose), header.number},
                   rotation_error(written) > kMinReportedNormError};
}

}  // namespace

Result<Loaded<NumberedTrajectory>> read_log_trajectory(const std::filesystem::path& path,
                                                       const TrajectoryOptions& options) {
  HYPERMAP_TRY(validate(options));
  HYPERMAP_ASSIGN_OR_RETURN(const std::string text, read_file(path, options.max_file_bytes));
  const std::vector<TextLine> lines = content_lines(text);
  Loaded<NumberedTrajectory> loaded;
  std::set<std::uint64_t> numbers;
  for (std::size_t first = 0; first < lines.size(); first += 5) {
    auto record = parse_log_record(lines, first, path, options);
    if (record && !numbers.insert(record->pose.number).second) {
      record =
          Unexpected(in_file({.code = ErrorCode::kMalformedFile,
                              .what = "must occur once, is " + std::to_string(record->pose.number),
                              .field = "record"},
                             path,
                             lines[first].number));
    }
    if (record) {
      loaded.value.num_normalised += record->is_normalised ? 1U : 0U;
      loaded.value.poses.push_back(record->pose);
    } else if (options.skip_bad_lines) {
      loaded.findings.push_back({Severity::kWarning, record.error()});
    } else {
      return Unexpected(record.error());
    }
  }
  if (auto cut = find_cut_number(text, path)) loaded.findings.push_back(std::move(*cut));
  return finished(std::move(loaded), path);
}

Result<InputFromCamera> read_pose_matrix(const std::filesystem::path& path,
                                         const TrajectoryOptions& options) {
  HYPERMAP_TRY(validate(options));
  constexpr std::size_t kMaxPoseBytes = 65536;
  HYPERMAP_ASSIGN_OR_RETURN(const std::string text, read_file(path, kMaxPoseBytes));
  const std::vector<TextLine> lines = content_lines(text);
  if (lines.size() == 1 && split_words(lines[0].text).size() == 16) {
    HYPERMAP_ASSIGN_OR_RETURN(const auto line, read_pose_lines(path, options));
    return line.value.poses.front().input_from_camera;
  }
  HYPERMAP_ASSIGN_OR_RETURN(const auto rows, parse_rows(lines, 0, path, options));
  if (lines.size() > 4) {
    return Unexpected(in_file({.code = ErrorCode::kMalformedFile,
                               .what = "has text after the fourth row, expected one 4x4 matrix",
                               .field = "pose"},
                              path,
                              lines[4].number));
  }
  auto pose = rigid_from_rows(rows, options.max_rotation_error);
  if (!pose) return Unexpected(in_file(std::move(pose).error(), path, 0));
  return InputFromCamera(*pose);
}

Result<Eigen::Isometry3d> rigid_from_rows(const std::vector<double>& numbers,
                                          double max_rotation_error) {
  if (numbers.size() != 16) {
    return fail(ErrorCode::kMalformedFile,
                "must have 16 numbers, has " + std::to_string(numbers.size()),
                "pose");
  }
  const Eigen::Matrix4d m =
      Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(numbers.data());
  if (!m.allFinite()) return fail(ErrorCode::kMalformedFile, "must be finite", "pose");
  if (!((m.row(3) - Eigen::RowVector4d(0, 0, 0, 1)).cwiseAbs().maxCoeff() <= 1e-6)) {
    return fail(ErrorCode::kMalformedFile, "last row must be 0 0 0 1", "pose");
  }
  const Eigen::Matrix3d rotation = m.topLeftCorner<3, 3>();
  if (!(rotation_error(rotation) <= max_rotation_error) || rotation.determinant() < 0.0) {
    return fail(ErrorCode::kMalformedFile,
                "must be a rotation, is off by " + json_number(rotation_error(rotation)) +
                    (rotation.determinant() < 0.0 ? " and mirrored" : ""),
                "rotation");
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(rotation, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = svd.matrixU() * svd.matrixV().transpose();
  pose.translation() = m.topRightCorner<3, 1>();
  return pose;
}

}  // namespace hypermap
