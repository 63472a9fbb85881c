// SPDX-License-Identifier: BSD-3-Clause
#include "sequence_index.hpp"

#include "images/image_list.hpp"
#include "poses/trajectory_lines.hpp"
#include "sequence_poses.hpp"
#include "stamp_units.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace hypermap {
namespace {

namespace fs = std::filesystem;

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
