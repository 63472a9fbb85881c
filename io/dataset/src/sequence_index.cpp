// SPDX-License-Identifier: BSD-3-Clause
#include "sequence_index.hpp"

#include "hypermap/io/codec/text_file.hpp"
#include "hypermap/io/dataset/trajectory_file.hpp"
#include "images/image_list.hpp"
#include "poses/trajectory_lines.hpp"
#include "stamp_units.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <map>
#include <set>
#include <utility>

namespace hypermap {
namespace {

namespace fs = std::filesystem;

std::int64_t nanoseconds(double seconds) {
  return std::llround(seconds * 1e9);
}

std::string seconds_text(double seconds) {
  return stamp_text({nanoseconds(seconds)}) + " s";
}

Result<std::vector<ListedFile>> list_files(const fs::path& folder, const std::string& place) {
  if (place.empty()) return std::vector<ListedFile>{};
  return is_pattern(place) ? list_image_files(folder, place) : read_image_list(folder, place);
}

bool are_numbered(const std::vector<ListedFile>& files) {
  return std::all_of(
      files.begin(), files.end(), [](const ListedFile& file) { return file.number.has_value(); });
}

bool are_stamped(const std::vector<ListedFile>& files) {
  return std::all_of(
      files.begin(), files.end(), [](const ListedFile& file) { return file.stamp.has_value(); });
}

Stamp stamp_of_number(std::uint64_t number, double rate_hz) {
  return {std::llround(static_cast<double>(number) / rate_hz * 1e9)};
}

/// Frames are the numbers of depth and colour images together: one that lacks an image stays a
/// frame, so that it is missed and named.
void pair_by_number(const std::vector<ListedFile>& depth,
                    const std::vector<ListedFile>& color,
                    const DatasetDescription& description,
                    SequenceIndex& index) {
  std::map<std::uint64_t, SequenceEntry> entries;
  const auto entry_of = [&](const ListedFile& file) -> SequenceEntry& {
    SequenceEntry& entry = entries[*file.number];
    entry.number = file.number;
    entry.stamp = stamp_of_number(*file.number, description.frame_rate_hz);
    return entry;
  };
  for (const ListedFile& file : depth) entry_of(file).depth = file.path;
  for (const ListedFile& file : color) entry_of(file).color = file.path;
  for (auto& [number, entry] : entries) {
    entry.name = entry.color.empty() ? entry.depth : entry.color;
    if (entry.depth.empty()) index.unpaired.push_back(entry.color + ": no depth image");
    if (entry.color.empty() && !color.empty()) {
      index.unpaired.push_back(entry.depth + ": no colour image");
    }
    index.entries.push_back(std::move(entry));
  }
}

/// Frames are the depth images; colour is the nearest in time.
void pair_by_stamp(const std::vector<ListedFile>& depth,
                   const std::vector<ListedFile>& color,
                   const DatasetDescription& description,
                   SequenceIndex& index) {
  const std::int64_t tolerance_ns = nanoseconds(description.stamp_tolerance_s);
  const std::string within = " within " + seconds_text(description.stamp_tolerance_s);
  std::set<std::size_t> used;
  for (const ListedFile& file : depth) {
    SequenceEntry entry;
    entry.depth = file.path;
    entry.stamp = *file.stamp;
    const auto partner = nearest_stamp(
        color, entry.stamp, tolerance_ns, [](const ListedFile& f) { return *f.stamp; });
    if (partner) {
      entry.color = color[*partner].path;
      used.insert(*partner);
    } else if (!color.empty()) {
      index.unpaired.push_back(file.path + ": no colour image" + within);
    }
    entry.name = entry.color.empty() ? entry.depth : entry.color;
    index.entries.push_back(std::move(entry));
  }
  for (std::size_t i = 0; i < color.size(); ++i) {
    if (!used.contains(i)) index.unpaired.push_back(color[i].path + ": no depth image" + within);
  }
}

/// Whether a person named the files; else they are those that a layout may have.
bool is_described(const DatasetDescription& description) {
  return description.layout == DatasetDescription{}.layout;
}

Result<void> pair_images(const fs::path& folder,
                         const DatasetDescription& description,
                         SequenceIndex& index) {
  HYPERMAP_ASSIGN_OR_RETURN(const auto depth, list_files(folder, description.depth));
  HYPERMAP_ASSIGN_OR_RETURN(const auto color, list_files(folder, description.color));
  index.num_depth = depth.size();
  index.num_color = color.size();
  if (color.empty() && is_described(description) && !description.color.empty()) {
    index.findings.push_back(
        warning(folder, 0, "color", "no file is named " + printable(description.color)));
  }
  if (depth.empty()) {
    return Unexpected(Error{.code = ErrorCode::kNotFound,
                            .what = "has no depth image " + description.depth,
                            .file = folder.string()});
  }
  if (are_numbered(depth) && are_numbered(color)) {
    pair_by_number(depth, color, description, index);
  } else if (are_stamped(depth) && are_stamped(color)) {
    pair_by_stamp(depth, color, description, index);
  } else {
    return Unexpected(Error{.code = ErrorCode::kMalformedFile,
                            .what = "depth and colour must both have numbers or both have stamps",
                            .file = folder.string()});
  }
  return {};
}

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

Result<void> attach_poses(const fs::path& folder,
                          const DatasetDescription& description,
                          SequenceIndex& index) {
  switch (description.trajectory_format) {
    case TrajectoryFormat::kTum:
      return attach_stamped(folder, description, index);
    case TrajectoryFormat::kLog:
      return attach_numbered(folder, description, index);
    case TrajectoryFormat::kMatrix:
      return attach_matrices(folder, description, index);
  }
  return {};
}

/// Label and instance images, by number.
Result<void> attach_label_images(const fs::path& folder,
                                 const std::string& pattern,
                                 std::string SequenceEntry::*member,
                                 SequenceIndex& index) {
  HYPERMAP_ASSIGN_OR_RETURN(const auto files, list_files(folder, pattern));
  std::map<std::uint64_t, std::string> path_of;
  for (const ListedFile& file : files) {
    if (file.number) path_of.emplace(*file.number, file.path);
  }
  for (SequenceEntry& entry : index.entries) {
    if (!entry.number) continue;
    const auto found = path_of.find(*entry.number);
    if (found != path_of.end()) entry.*member = found->second;
  }
  return {};
}

/// The camera's axes as given, seen from the optical ones.
Eigen::Isometry3d given_from_optical(CameraAxes axes) {
  Eigen::Isometry3d out = Eigen::Isometry3d::Identity();
  if (axes == CameraAxes::kOpenGl) out.linear() = Eigen::Vector3d(1, -1, -1).asDiagonal();
  if (axes == CameraAxes::kRobot) out.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  return out;
}

}  // namespace

InputFromCamera as_optical(const InputFromCamera& written, const DatasetDescription& description) {
  const bool is_inverse = description.pose_direction == PoseDirection::kWorldToCamera;
  const Eigen::Isometry3d input_from_given =
      is_inverse ? written.isometry().inverse() : written.isometry();
  return InputFromCamera(input_from_given * given_from_optical(description.camera_axes));
}

Result<SequenceIndex> index_sequence(const fs::path& folder,
                                     const DatasetDescription& description) {
  SequenceIndex index;
  HYPERMAP_TRY(pair_images(folder, description, index));
  HYPERMAP_TRY(attach_poses(folder, description, index));
  HYPERMAP_TRY(attach_label_images(folder, description.labels, &SequenceEntry::labels, index));
  HYPERMAP_TRY(
      attach_label_images(folder, description.instances, &SequenceEntry::instances, index));
  for (const SequenceEntry& entry : index.entries) {
    if (!entry.pose && entry.pose_file.empty()) {
      index.unpaired.push_back(entry.name + ": " + entry.missing_pose_reason);
    }
  }
  return index;
}

}  // namespace hypermap
