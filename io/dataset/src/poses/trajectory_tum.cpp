// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/bounded_json.hpp"
#include "hypermap/io/codec/byte_source.hpp"
#include "hypermap/io/codec/text_file.hpp"
#include "hypermap/io/dataset/trajectory_file.hpp"
#include "trajectory_lines.hpp"

#include <cmath>
#include <span>
#include <utility>

namespace hypermap {
namespace {

constexpr std::size_t kNumTumFields = 8;

struct TumLine {
  ParsedStamp stamp;
  InputFromCamera input_from_camera;
  double norm_error = 0.0;
};

Result<TumLine> parse_tum_line(std::string_view line, const TrajectoryOptions& options) {
  HYPERMAP_TRY(check_line_length(line, options));
  const auto words = split_words(line);
  if (words.size() != kNumTumFields) {
    return fail(ErrorCode::kMalformedFile,
                "must have 8 fields t tx ty tz qx qy qz qw, has " + std::to_string(words.size()) +
                    (is_pose_without_stamp(words.size())
                         ? ": a pose without stamp, which `trajectory_format: lines` reads"
                         : ""),
                "line");
  }
  TumLine out;
  HYPERMAP_ASSIGN_OR_RETURN(out.stamp, parse_stamp(words[0]));
  HYPERMAP_ASSIGN_OR_RETURN(
      const QuaternionPose pose,
      quaternion_pose(std::span(words).subspan(1), options.max_rotation_error));
  out.norm_error = pose.norm_error;
  out.input_from_camera = InputFromCamera(pose.pose);
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
    if (parsed.norm_error > kMinReportedNormError) ++loaded_.value.num_normalised;
    if (parsed.stamp.is_rounded && !warned_rounded_) {
      warned_rounded_ = true;
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
  bool warned_rounded_ = false;
};

}  // namespace

Result<Loaded<StampedTrajectory>> read_tum_trajectory(const std::filesystem::path& path,
                                                      const TrajectoryOptions& options) {
  HYPERMAP_TRY(validate(options));
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
  if (auto cut = find_cut_number(text, path)) builder.loaded().findings.push_back(std::move(*cut));
  return finished(std::move(builder.loaded()), path);
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
