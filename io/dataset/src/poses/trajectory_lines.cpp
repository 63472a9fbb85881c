// SPDX-License-Identifier: BSD-3-Clause
#include "trajectory_lines.hpp"

#include "hypermap/io/codec/bounded_json.hpp"
#include "hypermap/io/codec/text_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace hypermap {
namespace {

template <class Trajectory>
Result<Loaded<Trajectory>> finished_trajectory(Loaded<Trajectory> loaded,
                                               const std::filesystem::path& path) {
  if (loaded.value.poses.empty()) {
    Error error{.code = ErrorCode::kMalformedFile, .what = "has no pose, expected at least one"};
    if (!loaded.findings.empty()) {
      const Error& first = loaded.findings.front().error;
      error.what += "; line " + std::to_string(first.line) + ": " + first.field + ": " + first.what;
    }
    return Unexpected(in_file(std::move(error), path, 0));
  }
  if (loaded.value.num_normalised > 0) {
    loaded.findings.push_back(warning(path,
                                      0,
                                      "rotation",
                                      std::to_string(loaded.value.num_normalised) +
                                          " rotations off by more than 1e-3 were normalised"));
  }
  return loaded;
}

/// Digits behind the point.
std::size_t num_decimals(std::string_view number) {
  const std::size_t point = number.find('.');
  if (point == std::string_view::npos) return 0;
  const std::string_view behind = number.substr(point + 1);
  return std::min(behind.find_first_not_of("0123456789"), behind.size());
}

}  // namespace

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

Result<double> position_number(std::string_view word, std::string_view field) {
  HYPERMAP_ASSIGN_OR_RETURN(const double value, finite_number(word, field));
  if (std::abs(value) <= kMaxPositionM) return value;
  return fail(ErrorCode::kMalformedFile,
              "must be within 1e8 m of the origin, is " + printable(word, 60),
              std::string(field));
}

Result<QuaternionPose> quaternion_pose(std::span<const std::string_view> words,
                                       double max_rotation_error) {
  constexpr std::array<std::string_view, 7> kFields{"tx", "ty", "tz", "qx", "qy", "qz", "qw"};
  std::array<double, 7> v{};
  for (std::size_t i = 0; i < v.size(); ++i) {
    HYPERMAP_ASSIGN_OR_RETURN(
        v.at(i),
        i < 3 ? position_number(words[i], kFields.at(i)) : finite_number(words[i], kFields.at(i)));
  }
  const Eigen::Quaterniond rotation(v[6], v[3], v[4], v[5]);
  QuaternionPose out{.norm_error = std::abs(rotation.norm() - 1.0)};
  if (!(out.norm_error <= max_rotation_error)) {
    return fail(ErrorCode::kMalformedFile,
                "must have norm 1 within " + json_number(max_rotation_error) + ", has " +
                    json_number(rotation.norm()),
                "quaternion");
  }
  out.pose.linear() = rotation.normalized().toRotationMatrix();
  out.pose.translation() = Eigen::Vector3d(v[0], v[1], v[2]);
  return out;
}

Result<void> check_line_length(std::string_view line, const TrajectoryOptions& options) {
  if (line.size() <= options.max_line_bytes) return {};
  return fail(ErrorCode::kLimit,
              "at most " + std::to_string(options.max_line_bytes) +
                  " bytes are read of a line, has " + std::to_string(line.size()),
              "line");
}

bool is_comment(std::string_view line) {
  const std::string_view text = trimmed(line);
  return text.empty() || text.front() == '#';
}

Result<Loaded<StampedTrajectory>> finished(Loaded<StampedTrajectory> loaded,
                                           const std::filesystem::path& path) {
  return finished_trajectory(std::move(loaded), path);
}

Result<Loaded<NumberedTrajectory>> finished(Loaded<NumberedTrajectory> loaded,
                                            const std::filesystem::path& path) {
  return finished_trajectory(std::move(loaded), path);
}

std::optional<Finding> find_cut_number(std::string_view text, const std::filesystem::path& path) {
  if (text.empty() || text.back() == '\n') return std::nullopt;
  const std::vector<TextLine> lines = split_lines(text);
  const auto last = split_words(lines.back().text);
  if (is_comment(lines.back().text)) return std::nullopt;
  std::optional<std::size_t> fewest;
  for (std::size_t i = 0; i + 1 < lines.size(); ++i) {
    const auto words = split_words(lines[i].text);
    if (is_comment(lines[i].text) || words.size() != last.size()) continue;
    const std::size_t decimals = num_decimals(words.back());
    fewest = std::min(fewest.value_or(decimals), decimals);
  }
  const std::size_t decimals = num_decimals(last.back());
  if (!fewest || decimals >= *fewest) return std::nullopt;
  return warning(path,
                 lines.back().number,
                 "line",
                 "ends without a line end after " + printable(last.back(), 60) +
                     ", whose decimals are fewer than in any other line: the file is probably cut");
}

}  // namespace hypermap
