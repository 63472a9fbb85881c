// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A sequence that lies in a folder, read frame by frame.
#pragma once

#include "detections/detection_pairing.hpp"
#include "hypermap/io/dataset/dataset_description.hpp"
#include "hypermap/io/dataset/dataset_reader.hpp"
#include "images/label_images.hpp"
#include "sequence_index.hpp"

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace hypermap {

/// `error` with the file when it names none.
[[nodiscard]] inline Error in_file(Error error, const std::string& file) {
  if (error.file.empty()) error.file = file;
  return error;
}

[[nodiscard]] inline Unexpected frame_error(ErrorCode code,
                                            const std::string& file,
                                            std::string what) {
  return Unexpected(Error{.code = code, .what = std::move(what), .file = file});
}

/// What a sequence is made of, ready for reading frame by frame.
struct Sequence {
  std::filesystem::path folder;
  DatasetDescription description;
  DatasetSummary summary;
  std::vector<SequenceEntry> entries;  ///< All of them, before first and stride.
  std::vector<PairedDetections> detectors;
  std::optional<PinholeCamera> depth_camera;  ///< When depth is not registered to colour.
  bool poses_are_of_depth = false;            ///< Poses are those of the depth camera.
  LabelNames label_names;
  DetectorId label_detector;
  std::vector<ClassId> label_classes;
};

/// All layouts are read by this one: what differs between them is the description.
class FolderReader final : public DatasetReader {
 public:
  FolderReader(Sequence sequence, ClassRegistry registry, const DatasetOptions& options)
      : sequence_(std::move(sequence)), registry_(std::move(registry)), options_(options) {}

  [[nodiscard]] std::size_t size() const noexcept override { return sequence_.summary.num_frames; }
  [[nodiscard]] std::string frame_name(std::size_t index) const override {
    return sequence_.entries[position(index)].name;
  }
  [[nodiscard]] const DatasetSummary& summary() const noexcept override {
    return sequence_.summary;
  }
  [[nodiscard]] Result<RgbdFrame> read(std::size_t index) const override;

 private:
  [[nodiscard]] Result<RgbdFrame> try_read(std::size_t index) const;
  [[nodiscard]] std::size_t position(std::size_t index) const {
    return options_.first + index * options_.stride;
  }
  [[nodiscard]] std::filesystem::path path(const std::string& relative) const {
    return sequence_.folder / relative;
  }
  [[nodiscard]] ImageSize image_size() const {
    return {summary().camera.width_px, summary().camera.height_px};
  }
  [[nodiscard]] Result<InputFromCamera> pose_of(const SequenceEntry& entry) const;
  [[nodiscard]] Result<DepthImage> depth_of(const SequenceEntry& entry) const;
  [[nodiscard]] Result<std::vector<Detection>> detections_of(std::size_t position,
                                                             const SequenceEntry& entry) const;
  [[nodiscard]] Result<void> append(std::vector<Detection>& out,
                                    const FrameDetections& frame,
                                    std::span<const ClassId> known,
                                    DetectorId detector,
                                    const std::string& file) const;

  Sequence sequence_;
  ClassRegistry registry_;  ///< As it was when the dataset was opened; ids do not change.
  DatasetOptions options_;
};

}  // namespace hypermap
