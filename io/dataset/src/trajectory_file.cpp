// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/dataset/trajectory_file.hpp"

#include "hypermap/io/codec/bounded_json.hpp"
#include "hypermap/io/codec/byte_source.hpp"
#include "hypermap/io/codec/text_file.hpp"

#include <Eigen/LU>
#include <Eigen/SVD>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

namespace hypermap {
namespace {

constexpr double kNormalisedWorthSaying = 1e-3;
constexpr std::array<std::string_view, 8> kTumFields{
    "timestamp", "tx", "ty", "tz", "qx", "qy", "qz", "qw"};

Error in_file(Error error, const std::filesystem::path& path, int line) {
  error.file = path.string();
  if (error.line == 0) error.line = line;
  return error;
}

Finding warning(const std::filesystem::path& path, int line, std::string field, std::string what) {
  return {Severity::kWarning,
          {.code = ErrorCode::kMalformedFile,
           .what = std::move(what),
           .file = path.string(),
           .field = std::move(field),
           .line = line}};
}

Result<double> finite_number(std::string_view word, std::string_view field) {
  const auto value = parse_double(word);
  if (value && std::isfinite(*value)) return *value;
  return fail(ErrorCode::kMalformedFile,
              "must be a finite number, is " + printable(word, 60),
              std::string(field));
}

Result<void> check_line_length(std::string_view line, const TrajectoryOptions& options) {
  if (line.size() <= options.max_line_bytes) return {};
  return fail(ErrorCode::kLimit,
              "at most " + std::to_string(options.max_line_bytes) +
                  " bytes are read of a line, has " + std::to_string(line.size()),
              "line");
}

struct TumLine {
  ParsedStamp stamp;
  InputFromCamera input_from_camera;
  double norm_error = 0.0;
};

Result<TumLine> parse_tum_line(std::string_view line, const TrajectoryOptions& options) {
  HYPERMAP_TRY(check_line_length(line, options));
  const auto words = split_words(line);
  if (words.size() != kTumFields.size()) {
    return fail(ErrorCode::kMalformedFile,
                "must have 8 fields t tx ty tz qx qy qz qw, has " + std::to_string(words.size()),
                "line");
  }
  TumLine out;
  HYPERMAP_ASSIGN_OR_RETURN(out.stamp, parse_stamp(words[0]));
  std::array<double, 8> v{};
  for (std::size_t i = 1; i < words.size(); ++i) {
    HYPERMAP_ASSIGN_OR_RETURN(v.at(i), finite_number(words[i], kTumFields.at(i)));
  }
  Eigen::Quaterniond rotation(v[7], v[4], v[5], v[6]);
  out.norm_error = std::abs(rotation.norm() - 1.0);
  if (!(out.norm_error <= options.max_rotation_error)) {
    return fail(ErrorCode::kMalformedFile,
                "must have norm 1 within " + json_number(options.max_rotation_error) + ", has " +
                    json_number(rotation.norm()),
                "quaternion");
  }
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = rotation.normalized().toRotationMatrix();
  pose.translation() = Eigen::Vector3d(v[1], v[2], v[3]);
  out.input_from_camera = InputFromCamera(pose);
  return out;
}

bool same_pose(const InputFromCamera& a, const InputFromCamera& b) {
  return a.isometry().matrix() == b.isometry().matrix();
}

/// Grows a trajectory line by line and sees to the rules between lines.
class TumBuilder {
 public:
  TumBuilder(const std::filesystem::path& path, const TrajectoryOptions& options)
      : path_(path), options_(options) {}

  Result<void> add(const TextLine& line) {
    HYPERMAP_ASSIGN_OR_RETURN(const TumLine parsed, parse_tum_line(line.text, options_));
    HYPERMAP_ASSIGN_OR_RETURN(const bool is_new, check_order(parsed));
    if (!is_new) {
      ++loaded_.value.num_repeated;
      return {};
    }
    note(parsed, line.number);
    loaded_.value.poses.push_back({parsed.stamp.stamp, parsed.input_from_camera, line.number});
    return {};
  }

  Loaded<StampedTrajectory>& loaded() { return loaded_; }

 private:
  /// False when the pose is there already.
  [[nodiscard]] Result<bool> check_order(const TumLine& parsed) const {
    if (loaded_.value.poses.empty()) return true;
    const StampedPose& last = loaded_.value.poses.back();
    if (parsed.stamp.is_in_nanoseconds != in_nanoseconds_) {
      return order_error("must be in the unit of the lines before", parsed);
    }
    if (parsed.stamp.stamp < last.stamp) {
      return order_error("must not run back from " + stamp_text(last.stamp), parsed);
    }
    if (parsed.stamp.stamp > last.stamp) return true;
    if (same_pose(parsed.input_from_camera, last.input_from_camera)) return false;
    return order_error(
        "must occur once, occurs with another pose in line " + std::to_string(last.line), parsed);
  }

  static Unexpected order_error(const std::string& rule, const TumLine& parsed) {
    return fail(
        ErrorCode::kMalformedFile, rule + ", is " + stamp_text(parsed.stamp.stamp), "timestamp");
  }

  void note(const TumLine& parsed, int line) {
    in_nanoseconds_ = parsed.stamp.is_in_nanoseconds;
    if (parsed.norm_error > kNormalisedWorthSaying) ++loaded_.value.num_normalised;
    if (parsed.stamp.is_rounded && !said_rounded_) {
      said_rounded_ = true;
      loaded_.findings.push_back(warning(
          path_, line, "timestamp", "nanoseconds in exponent notation, digits are likely lost"));
    }
    note_jump(parsed, line);
  }

  void note_jump(const TumLine& parsed, int line) {
    if (loaded_.value.poses.empty() || options_.max_speed_m_per_s <= 0.0) return;
    const StampedPose& last = loaded_.value.poses.back();
    const double seconds = static_cast<double>(parsed.stamp.stamp.ns - last.stamp.ns) * 1e-9;
    const double distance_m = (parsed.input_from_camera.isometry().translation() -
                               last.input_from_camera.isometry().translation())
                                  .norm();
    if (distance_m <= options_.max_speed_m_per_s * seconds) return;
    loaded_.findings.push_back(warning(path_,
                                       line,
                                       "position",
                                       "jumps " + json_number(distance_m) + " m in " +
                                           json_number(seconds) + " s, expected at most " +
                                           json_number(options_.max_speed_m_per_s) + " m/s"));
  }

  const std::filesystem::path& path_;
  const TrajectoryOptions& options_;
  Loaded<StampedTrajectory> loaded_;
  bool in_nanoseconds_ = false;
  bool said_rounded_ = false;
};

bool is_comment(std::string_view line) {
  const std::string_view text = trimmed(line);
  return text.empty() || text.front() == '#';
}

void note_normalised(std::size_t count,
                     const std::filesystem::path& path,
                     std::vector<Finding>& findings) {
  if (count == 0) return;
  findings.push_back(
      warning(path,
              0,
              "rotation",
              std::to_string(count) + " rotations off by more than 1e-3 were normalised"));
}

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
      const auto number = finite_number(word, "pose");
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

double rotation_error(const Eigen::Matrix3d& r) {
  return (r.transpose() * r - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
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
                   rotation_error(written) > kNormalisedWorthSaying};
}

}  // namespace

Result<Loaded<StampedTrajectory>> read_tum_trajectory(const std::filesystem::path& path,
                                                      const TrajectoryOptions& options) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::string text, read_file(path, options.max_file_bytes));
  TumBuilder builder(path, options);
  for (const TextLine& line : split_lines(text)) {
    if (is_comment(line.text) && line.text.size() <= options.max_line_bytes) continue;
    const auto added = builder.add(line);
    if (added) continue;
    Error error = in_file(added.error(), path, line.number);
    if (!options.skip_bad_lines) return Unexpected(std::move(error));
    builder.loaded().findings.push_back({Severity::kWarning, std::move(error)});
  }
  Loaded<StampedTrajectory>& loaded = builder.loaded();
  if (loaded.value.poses.empty()) {
    return Unexpected(
        in_file({.code = ErrorCode::kMalformedFile, .what = "has no pose, expected at least one"},
                path,
                0));
  }
  note_normalised(loaded.value.num_normalised, path, loaded.findings);
  return std::move(loaded);
}

Result<Loaded<NumberedTrajectory>> read_log_trajectory(const std::filesystem::path& path,
                                                       const TrajectoryOptions& options) {
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
  if (loaded.value.poses.empty()) {
    return Unexpected(
        in_file({.code = ErrorCode::kMalformedFile, .what = "has no pose, expected at least one"},
                path,
                0));
  }
  note_normalised(loaded.value.num_normalised, path, loaded.findings);
  return loaded;
}

Result<InputFromCamera> read_pose_matrix(const std::filesystem::path& path,
                                         const TrajectoryOptions& options) {
  constexpr std::size_t kMaxBytes = 65536;
  HYPERMAP_ASSIGN_OR_RETURN(const std::string text, read_file(path, kMaxBytes));
  const std::vector<TextLine> lines = content_lines(text);
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

std::string to_tum_line(Stamp stamp, const InputFromCamera& input_from_camera) {
  const Eigen::Vector3d t = input_from_camera.isometry().translation();
  const Eigen::Quaterniond q(input_from_camera.isometry().linear());
  std::string line = stamp_text(stamp);
  for (const double value : {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()}) {
    line += " " + json_number(value);
  }
  return line + "\n";
}

}  // namespace hypermap
