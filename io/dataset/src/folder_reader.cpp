// SPDX-License-Identifier: BSD-3-Clause
#include "folder_reader.hpp"

#include "hypermap/io/dataset/trajectory_file.hpp"
#include "images/depth_registration.hpp"

#include <iterator>
#include <system_error>
#include <utility>

namespace hypermap {
namespace {

/// A file that is not there, or is none, is a fault of the dataset; kIo is left to files that the
/// system refuses to read.
Error told_from_system(Error error) {
  if (error.code != ErrorCode::kIo) return error;
  std::error_code unknown;
  const auto type = std::filesystem::status(error.file, unknown).type();
  if (type == std::filesystem::file_type::not_found) {
    error.code = ErrorCode::kNotFound;
  } else if (!unknown && type != std::filesystem::file_type::regular) {
    error.code = ErrorCode::kMalformedFile;
  }
  return error;
}

}  // namespace

Result<RgbdFrame> FolderReader::read(std::size_t index) const {
  auto frame = try_read(index);
  if (!frame) return Unexpected(told_from_system(std::move(frame).error()));
  return frame;
}

Result<RgbdFrame> FolderReader::try_read(std::size_t index) const {
  const SequenceEntry& entry = sequence_.entries[position(index)];
  RgbdFrame frame;
  frame.index = position(index);
  frame.name = entry.name;
  frame.stamp = entry.stamp;
  frame.camera = summary().camera;
  HYPERMAP_ASSIGN_OR_RETURN(InputFromCamera pose, pose_of(entry));
  if (sequence_.poses_are_of_depth) {
    pose = InputFromCamera(pose.isometry() * sequence_.description.color_from_depth.inverse());
  }
  frame.map_from_camera = map_from_input() * pose;
  HYPERMAP_ASSIGN_OR_RETURN(frame.depth_m, depth_of(entry));
  if (options_.read_color && !entry.color.empty()) {
    HYPERMAP_ASSIGN_OR_RETURN(frame.color, read_color(path(entry.color), image_size()));
  }
  HYPERMAP_ASSIGN_OR_RETURN(frame.detections, detections_of(position(index), entry));
  return frame;
}

Result<InputFromCamera> FolderReader::pose_of(const SequenceEntry& entry) const {
  if (entry.pose) return *entry.pose;
  if (entry.pose_file.empty()) {
    return frame_error(ErrorCode::kNotFound, path(entry.name).string(), entry.missing_pose_reason);
  }
  HYPERMAP_ASSIGN_OR_RETURN(const InputFromCamera written, read_pose_matrix(path(entry.pose_file)));
  return as_optical(written, sequence_.description);
}

Result<DepthImage> FolderReader::depth_of(const SequenceEntry& entry) const {
  if (entry.depth.empty()) {
    return frame_error(ErrorCode::kNotFound, path(entry.name).string(), "no depth image");
  }
  const DepthFormat& format = sequence_.description.depth_format;
  if (!sequence_.depth_camera) return read_depth(path(entry.depth), format, image_size());
  const PinholeCamera& camera = *sequence_.depth_camera;
  HYPERMAP_ASSIGN_OR_RETURN(
      const DepthImage depth,
      read_depth(path(entry.depth), format, {camera.width_px, camera.height_px}));
  return register_depth(depth, camera, summary().camera, sequence_.description.color_from_depth);
}

Result<std::vector<Detection>> FolderReader::detections_of(std::size_t position,
                                                           const SequenceEntry& entry) const {
  std::vector<Detection> out;
  for (const PairedDetections& detector : sequence_.detectors) {
    for (const std::size_t i : detector.frames_of_entry[position]) {
      HYPERMAP_TRY(append(
          out, detector.set.frames[i], detector.known_classes, detector.detector, detector.file));
    }
  }
  if (entry.labels.empty() && entry.instances.empty()) return out;
  const auto full = [&](const std::string& p) {
    return p.empty() ? std::filesystem::path{} : path(p);
  };
  HYPERMAP_ASSIGN_OR_RETURN(const FrameDetections labelled,
                            read_label_detections(full(entry.labels),
                                                  full(entry.instances),
                                                  sequence_.label_names,
                                                  options_.detection_reading.limits));
  HYPERMAP_TRY(
      append(out, labelled, sequence_.label_classes, sequence_.label_detector, labelled.image));
  return out;
}

Result<void> FolderReader::append(std::vector<Detection>& out,
                                  const FrameDetections& frame,
                                  std::span<const ClassId> known,
                                  DetectorId detector,
                                  const std::string& file) const {
  auto resolved =
      resolve(frame, registry_, known, detector, image_size().width_px, image_size().height_px);
  if (!resolved) {
    Error error = in_file(std::move(resolved).error(), file);
    error.entry = frame.image;
    return Unexpected(std::move(error));
  }
  std::move(resolved->detections.begin(), resolved->detections.end(), std::back_inserter(out));
  return {};
}

}  // namespace hypermap
