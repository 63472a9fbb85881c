// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/dataset/dataset_reader.hpp"

#include "folder_reader.hpp"
#include "hypermap/io/dataset/detections_parsing.hpp"
#include "images/registration_estimate.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

namespace fs = std::filesystem;

/// The size that most of the first images have; none when none of them can be read.
std::optional<ImageSize> usual_size(const Sequence& sequence, std::string SequenceEntry::*member) {
  constexpr std::size_t kEnough = 5;
  std::vector<ImageSize> sizes;
  for (const SequenceEntry& entry : sequence.entries) {
    if (sizes.size() >= kEnough) break;
    if ((entry.*member).empty()) continue;
    const auto size = read_image_size(sequence.folder / (entry.*member));
    if (size) sizes.push_back(*size);
  }
  if (sizes.empty()) return std::nullopt;
  return *std::max_element(sizes.begin(), sizes.end(), [&](ImageSize a, ImageSize b) {
    return std::count(sizes.begin(), sizes.end(), a) < std::count(sizes.begin(), sizes.end(), b);
  });
}

Result<PinholeCamera> camera_from(const Intrinsics& intrinsics,
                                  std::optional<ImageSize> size,
                                  const std::string& file) {
  const ImageSize images = size.value_or(ImageSize{});
  auto camera = camera_of(intrinsics, images.width_px, images.height_px);
  if (!camera) return Unexpected(in_file(std::move(camera).error(), file));
  return camera;
}

/// Numbers of the description, or of the file that it names.
Result<std::optional<Intrinsics>> intrinsics_from(const fs::path& folder,
                                                  const std::optional<Intrinsics>& numbers,
                                                  const std::string& file,
                                                  std::vector<Finding>& findings) {
  if (numbers || file.empty()) return numbers;
  HYPERMAP_ASSIGN_OR_RETURN(auto loaded, read_intrinsics(folder / file));
  std::move(loaded.findings.begin(), loaded.findings.end(), std::back_inserter(findings));
  return std::optional(loaded.value);
}

Result<void> settle_cameras(Sequence& sequence) {
  DatasetDescription& d = sequence.description;
  std::vector<Finding>& findings = sequence.summary.findings;
  const std::string file = (sequence.folder / d.intrinsics_file).string();
  HYPERMAP_ASSIGN_OR_RETURN(
      const auto color,
      intrinsics_from(sequence.folder, d.intrinsics, d.intrinsics_file, findings));
  HYPERMAP_ASSIGN_OR_RETURN(
      const auto depth,
      intrinsics_from(sequence.folder, d.depth_intrinsics, d.depth_intrinsics_file, findings));
  if (!color) return frame_error(ErrorCode::kNotFound, file, "has no intrinsics");
  if (color->depth_units_per_m) {
    d.depth_format.units_per_m = *color->depth_units_per_m;
  } else if (!d.names_depth_scale) {
    return frame_error(
        ErrorCode::kMalformedFile,
        file,
        "has no depth_scale, so the description must name it: " + std::string(kDepthScaleExample));
  }
  const auto depth_size = usual_size(sequence, &SequenceEntry::depth);
  const auto color_size = usual_size(sequence, &SequenceEntry::color);
  if (!depth) {
    HYPERMAP_ASSIGN_OR_RETURN(sequence.summary.camera, camera_from(*color, depth_size, file));
    return {};
  }
  HYPERMAP_ASSIGN_OR_RETURN(sequence.summary.camera, camera_from(*color, color_size, file));
  HYPERMAP_ASSIGN_OR_RETURN(const PinholeCamera depth_camera,
                            camera_from(*depth, depth_size, file));
  const bool is_same =
      depth_camera == sequence.summary.camera && d.color_from_depth.matrix().isIdentity(0.0);
  if (!is_same) sequence.depth_camera = depth_camera;
  return {};
}

/// Images that the estimate is made from, evenly chosen.
constexpr std::size_t kNumAskedFrames = 8;

std::optional<RegistrationEstimate> estimate_registration(const Sequence& sequence) {
  RegistrationEstimator estimator(sequence.summary.camera);
  std::vector<const SequenceEntry*> entries;
  for (const SequenceEntry& entry : sequence.entries) {
    if (!entry.depth.empty() && !entry.color.empty()) entries.push_back(&entry);
  }
  const std::size_t num = std::min(entries.size(), kNumAskedFrames);
  for (std::size_t i = 0; i < num; ++i) {
    const SequenceEntry& entry = *entries[i * entries.size() / num];
    const auto depth = read_depth(sequence.folder / entry.depth, sequence.description.depth_format);
    const auto color = read_color(sequence.folder / entry.color);
    if (depth && color) estimator.add(*depth, *color);
  }
  return estimator.estimate();
}

/// The colour camera of a recording whose depth turns out not to be registered to it. Its poses are
/// those of depth: what tracked the camera knew nothing of colour.
void settle_registration(Sequence& sequence) {
  if (!sequence.description.may_be_unregistered || sequence.depth_camera) return;
  const auto found = estimate_registration(sequence);
  if (!found || !validate(found->color_camera)) return;
  sequence.depth_camera = sequence.summary.camera;
  sequence.poses_are_of_depth = true;
  sequence.description.color_from_depth = found->color_from_depth;
  sequence.summary.camera = found->color_camera;
  std::array<char, 200> text{};
  std::snprintf(text.data(),
                text.size(),
                "registered to colour by the images: focal length %.1f px, centre (%.1f, "
                "%.1f), %.3f m beside; edges agree %.2f instead of %.2f",
                found->color_camera.fx_px,
                found->color_camera.cx_px,
                found->color_camera.cy_px,
                -found->color_from_depth.translation().x(),
                found->agreement,
                found->agreement_as_is);
  sequence.summary.registration = text.data();
}

/// Takes out the boxes wholly outside the camera's image, in frames that do not state their own
/// size; the reader of the file has refused the others. Returns how many.
std::size_t erase_outside(DetectionSet& set, const PinholeCamera& camera) {
  std::size_t num_erased = 0;
  for (FrameDetections& frame : set.frames) {
    if (frame.width_px != 0) continue;
    const int width = frame.boxes_are_shares ? 1 : camera.width_px;
    const int height = frame.boxes_are_shares ? 1 : camera.height_px;
    num_erased += std::erase_if(frame.detections, [&](const NamedDetection& detection) {
      return !clipped(detection.box_px, width, height);
    });
  }
  return num_erased;
}

Finding boxes_outside(std::size_t num, const PinholeCamera& camera, const fs::path& file) {
  return {Severity::kWarning,
          {.code = ErrorCode::kMalformedFile,
           .what = std::to_string(num) + " box(es) wholly outside the image of " +
                   std::to_string(camera.width_px) + " x " + std::to_string(camera.height_px) +
                   " are left out",
           .file = file.string(),
           .field = "bbox"}};
}

Result<void> read_detection_files(const DatasetOptions& options,
                                  Sequence& sequence,
                                  ClassRegistry& registry) {
  std::vector<fs::path> files = options.detections;
  if (files.empty() && options.find_detections) {
    for (const std::string& file : sequence.description.detections) {
      files.push_back(sequence.folder / file);
    }
  }
  DetectionReadOptions reading = options.detection_reading;
  std::vector<DetectorId> read;
  for (std::size_t i = 0; i < files.size(); ++i) {
    const fs::path& file = files[i];
    const std::string given = i < options.detector_names.size() ? options.detector_names[i] : "";
    HYPERMAP_ASSIGN_OR_RETURN(auto loaded, read_detections(file, reading));
    reading.embeddings = loaded.value.embeddings;
    DatasetSummary& summary = sequence.summary;
    std::move(loaded.findings.begin(), loaded.findings.end(), std::back_inserter(summary.findings));
    if (const std::size_t outside = erase_outside(loaded.value, summary.camera)) {
      summary.findings.push_back(boxes_outside(outside, summary.camera, file));
    }
    PairedDetections paired =
        pair_detections(std::move(loaded.value), sequence.entries, summary.stamp_tolerance_s);
    paired.file = file.string();
    HYPERMAP_TRY(refuse_repeated(paired, sequence.detectors));
    const auto detector = register_detector(paired, given, read, summary.detectors);
    if (!detector) return Unexpected(in_file(detector.error(), paired.file));
    paired.detector = *detector;
    if (auto foreign = find_foreign(paired)) summary.findings.push_back(std::move(*foreign));
    if (auto second = find_second_look(paired, sequence.detectors))
      summary.findings.push_back(std::move(*second));
    read.push_back(*detector);
    auto ids = register_classes(distinct_classes(paired.set.class_names), registry);
    if (!ids) return Unexpected(in_file(std::move(ids).error(), paired.file));
    paired.known_classes = std::move(*ids);
    summary.num_detections += paired.set.num_detections();
    summary.num_detection_frames += paired.set.frames.size();
    std::copy(paired.unpaired.begin(), paired.unpaired.end(), std::back_inserter(summary.unpaired));
    sequence.detectors.push_back(std::move(paired));
  }
  return {};
}

/// Label images count as a detector of their own, when no other detections are named.
Result<void> prepare_labels(const DatasetOptions& options,
                            Sequence& sequence,
                            ClassRegistry& registry) {
  const bool has_labels =
      !sequence.description.labels.empty() || !sequence.description.instances.empty();
  if (!has_labels || !options.find_detections || !options.detections.empty()) {
    for (SequenceEntry& entry : sequence.entries) {
      entry.labels.clear();
      entry.instances.clear();
    }
    return {};
  }
  HYPERMAP_ASSIGN_OR_RETURN(sequence.label_names,
                            read_label_names(sequence.folder, sequence.description.label_names));
  std::vector<std::string> names;
  for (const auto& [number, name] : sequence.label_names.of_number) names.push_back(name);
  HYPERMAP_ASSIGN_OR_RETURN(sequence.label_classes,
                            register_classes(distinct_classes(names), registry));
  HYPERMAP_ASSIGN_OR_RETURN(sequence.label_detector,
                            sequence.summary.detectors.add({.name = "labels", .type = "labels"}));
  return {};
}

Result<Loaded<DatasetDescription>> describe(const fs::path& folder, const DatasetOptions& options) {
  if (options.description) return read_dataset_description(*options.description);
  return find_layout(folder);
}

/// How many frames remain after first, stride and max_frames.
std::size_t num_chosen(std::size_t num_entries, const DatasetOptions& options) {
  if (options.first >= num_entries) return 0;
  const std::size_t all = (num_entries - options.first + options.stride - 1) / options.stride;
  return std::min(all, options.max_frames.value_or(all));
}

}  // namespace

Result<std::unique_ptr<DatasetReader>> open_dataset(const std::filesystem::path& path,
                                                    const DatasetOptions& options,
                                                    ClassRegistry& registry) {
  HYPERMAP_TRY(validate(options));
  HYPERMAP_ASSIGN_OR_RETURN(auto described, describe(path, options));
  Sequence sequence;
  sequence.folder = path;
  sequence.description = std::move(described.value);
  DatasetDescription& d = sequence.description;
  if (options.stamp_tolerance_s) d.stamp_tolerance_s = *options.stamp_tolerance_s;
  HYPERMAP_ASSIGN_OR_RETURN(SequenceIndex index, index_sequence(path, d));
  DatasetSummary& summary = sequence.summary;
  summary.layout = d.layout;
  summary.name =
      d.name.empty() ? fs::absolute(path / "").parent_path().filename().string() : d.name;
  summary.world = d.world;
  summary.pose_direction = d.pose_direction;
  summary.camera_axes = d.camera_axes;
  summary.stamp_tolerance_s = d.stamp_tolerance_s;
  summary.num_depth = index.num_depth;
  summary.num_color = index.num_color;
  summary.num_poses = index.num_poses;
  summary.up_axis = d.up_axis;
  summary.unpaired = std::move(index.unpaired);
  summary.findings = std::move(described.findings);
  std::move(index.findings.begin(), index.findings.end(), std::back_inserter(summary.findings));
  sequence.entries = std::move(index.entries);
  summary.num_frames = num_chosen(sequence.entries.size(), options);
  if (summary.num_frames == 0) {
    return frame_error(ErrorCode::kNotFound, path.string(), "has no frame left to read");
  }
  HYPERMAP_TRY(settle_cameras(sequence));
  settle_registration(sequence);
  summary.depth_units_per_m = d.depth_format.units_per_m;
  summary.detectors = options.detectors;
  ClassRegistry grown = registry;
  HYPERMAP_TRY(read_detection_files(options, sequence, grown));
  HYPERMAP_TRY(prepare_labels(options, sequence, grown));
  registry = grown;
  return std::make_unique<FolderReader>(std::move(sequence), std::move(grown), options);
}

}  // namespace hypermap
