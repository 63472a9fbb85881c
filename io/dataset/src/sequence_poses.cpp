// SPDX-License-Identifier: BSD-3-Clause
#include "sequence_poses.hpp"

#include "hypermap/io/codec/text_file.hpp"
#include "hypermap/io/dataset/trajectory_file.hpp"
#include "images/image_list.hpp"
#include "poses/trajectory_lines.hpp"
#include "stamp_units.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

namespace hypermap {
namespace {

namespace fs = std::filesystem;

void attach(SequenceEntry& entry, const StampedPose& pose, const DatasetDescription& description) {
  entry.pose = as_optical(pose.input_from_camera, description);
  if (entry.number) entry.stamp = pose.stamp;
}

/// Numbered images have stamps that only stand for their numbers: those of poses are others.
void explain_pairing(const fs::path& folder,
                     const DatasetDescription& description,
                     SequenceIndex& index) {
  const auto is_lost = [](const SequenceEntry& entry) { return entry.number && !entry.pose; };
  if (!std::all_of(index.entries.begin(), index.entries.end(), is_lost)) return;
  const std::string reason =
      "images have numbers, poses stamps: `pair_by: order` or `pair_by: number` says which belong "
      "together";
  index.findings.insert(index.findings.begin(),
                        warning(folder / description.trajectory, 0, "pair_by", reason));
  for (SequenceEntry& entry : index.entries) entry.missing_pose_reason = reason;
}

Result<void> attach_stamped(const fs::path& folder,
                            const DatasetDescription& description,
                            SequenceIndex& index) {
  HYPERMAP_ASSIGN_OR_RETURN(
      auto loaded, read_tum_trajectory(folder / description.trajectory, {.skip_bad_lines = true}));
  const std::vector<StampedPose>& poses = loaded.value.poses;
  index.num_poses = poses.size();
  std::move(loaded.findings.begin(), loaded.findings.end(), std::back_inserter(index.findings));
  const std::int64_t tolerance_ns = nanoseconds(description.stamp_tolerance_s);
  for (std::size_t i = 0; i < index.entries.size(); ++i) {
    SequenceEntry& entry = index.entries[i];
    std::optional<std::size_t> found;
    if (description.pair_by == PosePairing::kStamp) {
      found = nearest_stamp(
          poses, entry.stamp, tolerance_ns, [](const StampedPose& p) { return p.stamp; });
      entry.missing_pose_reason = "no pose within " + seconds_text(description.stamp_tolerance_s) +
                                  " of " + stamp_text(entry.stamp);
    } else {
      const std::size_t position = description.pair_by == PosePairing::kNumber && entry.number
                                       ? static_cast<std::size_t>(*entry.number)
                                       : i;
      if (position < poses.size()) found = position;
      entry.missing_pose_reason = "no pose at position " + std::to_string(position);
    }
    if (found) attach(entry, poses[*found], description);
  }
  if (description.pair_by != PosePairing::kStamp) return {};
  explain_pairing(folder, description, index);
  if (const auto mismatch = stamps_of_two_units(index.entries, poses, tolerance_ns)) {
    // First: it explains the lines that were skipped.
    index.findings.insert(index.findings.begin(),
                          warning(folder / description.trajectory, 0, "timestamp", *mismatch));
    for (SequenceEntry& entry : index.entries)
      entry.missing_pose_reason += "; " + description.trajectory + " " + *mismatch;
  }
  return {};
}

/// Poses without stamps: the n-th line is the n-th image's, or that of the image of number n.
Result<void> attach_lines(const fs::path& folder,
                          const DatasetDescription& description,
                          SequenceIndex& index) {
  const fs::path path = folder / description.trajectory;
  if (description.pair_by == PosePairing::kStamp) {
    return Unexpected(Error{.code = ErrorCode::kInvalidArgument,
                            .what = "must be order or number: `trajectory_format: lines` has no "
                                    "stamps",
                            .file = path.string(),
                            .field = "pair_by"});
  }
  HYPERMAP_ASSIGN_OR_RETURN(auto loaded, read_pose_lines(path, {.skip_bad_lines = true}));
  index.num_poses = loaded.value.poses.size();
  std::move(loaded.findings.begin(), loaded.findings.end(), std::back_inserter(index.findings));
  std::map<std::uint64_t, InputFromCamera> pose_of;
  for (const NumberedPose& pose : loaded.value.poses)
    pose_of.emplace(pose.number, pose.input_from_camera);
  for (std::size_t i = 0; i < index.entries.size(); ++i) {
    SequenceEntry& entry = index.entries[i];
    const bool by_order = description.pair_by == PosePairing::kOrder;
    const std::uint64_t wanted = by_order ? i : entry.number.value_or(i);
    const auto found = pose_of.find(wanted);
    if (found != pose_of.end()) entry.pose = as_optical(found->second, description);
    entry.missing_pose_reason = "no pose at position " + std::to_string(wanted);
  }
  return {};
}

Result<void> attach_numbered(const fs::path& folder,
                             const DatasetDescription& description,
                             SequenceIndex& index) {
  HYPERMAP_ASSIGN_OR_RETURN(
      auto loaded, read_log_trajectory(folder / description.trajectory, {.skip_bad_lines = true}));
  const std::vector<NumberedPose>& poses = loaded.value.poses;
  index.num_poses = poses.size();
  std::move(loaded.findings.begin(), loaded.findings.end(), std::back_inserter(index.findings));
  std::map<std::uint64_t, std::size_t> position_of;
  for (std::size_t i = 0; i < poses.size(); ++i) position_of.emplace(poses[i].number, i);
  for (std::size_t i = 0; i < index.entries.size(); ++i) {
    SequenceEntry& entry = index.entries[i];
    const bool by_order = description.pair_by == PosePairing::kOrder;
    const std::uint64_t wanted = entry.number.value_or(i);
    const auto found = position_of.find(wanted);
    if (by_order && i < poses.size()) {
      entry.pose = as_optical(poses[i].input_from_camera, description);
    } else if (!by_order && found != position_of.end()) {
      entry.pose = as_optical(poses[found->second].input_from_camera, description);
    }
    entry.missing_pose_reason = "no pose with number " + std::to_string(by_order ? i : wanted);
  }
  return {};
}

Result<void> attach_matrices(const fs::path& folder,
                             const DatasetDescription& description,
                             SequenceIndex& index) {
  HYPERMAP_ASSIGN_OR_RETURN(const auto files, list_files(folder, description.trajectory));
  index.num_poses = files.size();
  std::map<std::uint64_t, std::string> path_of;
  for (const ListedFile& file : files) {
    if (file.number) path_of.emplace(*file.number, file.path);
  }
  for (std::size_t i = 0; i < index.entries.size(); ++i) {
    SequenceEntry& entry = index.entries[i];
    if (description.pair_by == PosePairing::kOrder) {
      if (i < files.size()) entry.pose_file = files[i].path;
    } else if (const auto found = path_of.find(entry.number.value_or(i)); found != path_of.end()) {
      entry.pose_file = found->second;
    }
    entry.missing_pose_reason = "no pose file " + description.trajectory + " with number " +
                                std::to_string(entry.number.value_or(i));
  }
  return {};
}

}  // namespace

Result<void> attach_poses(const fs::path& folder,
                          const DatasetDescription& description,
                          SequenceIndex& index) {
  switch (description.trajectory_format) {
    case TrajectoryFormat::kTum:
      return attach_stamped(folder, description, index);
    case TrajectoryFormat::kLog:
      return attach_numbered(folder, description, index);
    case TrajectoryFormat::kLines:
      return attach_lines(folder, description, index);
    case TrajectoryFormat::kMatrix:
      return attach_matrices(folder, description, index);
  }
  return {};
}

}  // namespace hypermap
