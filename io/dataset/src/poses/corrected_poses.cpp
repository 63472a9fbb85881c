// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/dataset/corrected_poses.hpp"

#include "hypermap/io/dataset/trajectory_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

using PoseOfFrame = std::function<std::optional<InputFromCamera>(const RgbdFrame&)>;

std::uint64_t apart_ns(Stamp a, Stamp b) {
  const auto [low, high] = std::minmax(a.ns, b.ns);
  return static_cast<std::uint64_t>(high) - static_cast<std::uint64_t>(low);
}

/// The pose nearest in time; the earlier of equals.
std::optional<InputFromCamera> nearest_pose(const std::vector<StampedPose>& poses,
                                            Stamp stamp,
                                            std::uint64_t tolerance_ns) {
  const auto after = std::lower_bound(
      poses.begin(), poses.end(), stamp, [](const StampedPose& pose, Stamp wanted) {
        return pose.stamp < wanted;
      });
  const StampedPose* best = nullptr;
  if (after != poses.begin()) best = &*std::prev(after);
  if (after != poses.end() &&
      (best == nullptr || apart_ns(after->stamp, stamp) < apart_ns(best->stamp, stamp))) {
    best = &*after;
  }
  if (best == nullptr || apart_ns(best->stamp, stamp) > tolerance_ns) return std::nullopt;
  return best->input_from_camera;
}

/// Frames of another reader with poses of their own.
class CorrectedDataset final : public DatasetReader {
 public:
  CorrectedDataset(std::unique_ptr<DatasetReader> recorded,
                   DatasetSummary summary,
                   std::string file,
                   PoseOfFrame pose_of)
      : recorded_(std::move(recorded)),
        summary_(std::move(summary)),
        file_(std::move(file)),
        pose_of_(std::move(pose_of)) {}

  [[nodiscard]] std::size_t size() const noexcept override { return recorded_->size(); }
  [[nodiscard]] std::string frame_name(std::size_t index) const override {
    return recorded_->frame_name(index);
  }
  [[nodiscard]] const DatasetSummary& summary() const noexcept override { return summary_; }
  [[nodiscard]] Result<RgbdFrame> read(std::size_t index) const override {
    HYPERMAP_ASSIGN_OR_RETURN(RgbdFrame frame, recorded_->read(index));
    const auto pose = pose_of_(frame);
    if (!pose) {
      return Unexpected(Error{.code = ErrorCode::kNotFound,
                              .what = "has no pose for this frame",
                              .file = file_,
                              .entry = frame.name});
    }
    frame.map_from_camera = map_from_input() * *pose;
    return frame;
  }

 private:
  std::unique_ptr<DatasetReader> recorded_;
  DatasetSummary summary_;
  std::string file_;
  PoseOfFrame pose_of_;
};

struct ReadPoses {
  PoseOfFrame pose_of;
  std::size_t count = 0;
  std::vector<Finding> findings;
};

Result<ReadPoses> read_numbered(const std::filesystem::path& path) {
  HYPERMAP_ASSIGN_OR_RETURN(auto read, read_log_trajectory(path));
  std::map<std::uint64_t, InputFromCamera> by_number;
  for (const NumberedPose& pose : read.value.poses) {
    by_number.emplace(pose.number, pose.input_from_camera);
  }
  const std::size_t count = by_number.size();
  auto pose_of = [by_number = std::move(by_number)](const RgbdFrame& frame) {
    const auto found = by_number.find(frame.index);
    return found == by_number.end() ? std::nullopt : std::optional(found->second);
  };
  return ReadPoses{std::move(pose_of), count, std::move(read.findings)};
}

Result<ReadPoses> read_stamped(const std::filesystem::path& path, double tolerance_s) {
  HYPERMAP_ASSIGN_OR_RETURN(auto read, read_tum_trajectory(path));
  const auto tolerance_ns = static_cast<std::uint64_t>(std::llround(tolerance_s * 1e9));
  const std::size_t count = read.value.poses.size();
  auto pose_of = [poses = std::move(read.value.poses), tolerance_ns](const RgbdFrame& frame) {
    return nearest_pose(poses, frame.stamp, tolerance_ns);
  };
  return ReadPoses{std::move(pose_of), count, std::move(read.findings)};
}

}  // namespace

Result<std::unique_ptr<DatasetReader>> with_corrected_poses(std::unique_ptr<DatasetReader> dataset,
                                                            const std::filesystem::path& poses) {
  DatasetSummary summary = dataset->summary();
  HYPERMAP_ASSIGN_OR_RETURN(auto read,
                            poses.extension() == ".log"
                                ? read_numbered(poses)
                                : read_stamped(poses, summary.stamp_tolerance_s));
  summary.num_poses = read.count;
  summary.pose_direction = PoseDirection::kCameraToWorld;
  summary.camera_axes = CameraAxes::kOptical;
  summary.findings.insert(summary.findings.end(),
                          std::make_move_iterator(read.findings.begin()),
                          std::make_move_iterator(read.findings.end()));
  return std::make_unique<CorrectedDataset>(
      std::move(dataset), std::move(summary), poses.string(), std::move(read.pose_of));
}

}  // namespace hypermap
