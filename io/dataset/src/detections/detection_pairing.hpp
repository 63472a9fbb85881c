// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which detections belong to which frame.
#pragma once

#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/core/segmentation/detector_registry.hpp"
#include "hypermap/io/dataset/detections_file.hpp"
#include "sequence_index.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace hypermap {

/// One detector's file, its classes, and for each frame of the sequence what belongs to it.
struct PairedDetections {
  DetectionSet set;
  std::vector<ClassId> known_classes;
  DetectorId detector;
  std::string file;
  std::vector<std::vector<std::size_t>> frames_of_entry;  ///< Positions in `set.frames`.
  std::vector<std::string> unpaired;
};

/// By the image's path, else its name, else its number, else by stamp.
[[nodiscard]] PairedDetections pair_detections(DetectionSet set,
                                               const std::vector<SequenceEntry>& entries,
                                               double stamp_tolerance_s);

/// Errors: kInvalidArgument, naming its file, when one of those that were read `before` has the
/// same detections in the same frames and does not say that another detector made them: they would
/// count twice. Boundary: without detections nothing counts. Cost: as far as two are equal.
[[nodiscard]] Result<void> refuse_repeated(const PairedDetections& paired,
                                           std::span<const PairedDetections> before);

/// A file that speaks of none of the sequence's images is another sequence's.
[[nodiscard]] std::optional<Finding> find_foreign(const PairedDetections& paired);

/// A detector that speaks of a frame in one of the files that were read `before`, too: what it saw
/// there counts twice. Boundary: a frame without detections is none that it speaks of. Requires:
/// detectors are registered. Cost: O(frames) for each of its files.
[[nodiscard]] std::optional<Finding> find_second_look(const PairedDetections& paired,
                                                      std::span<const PairedDetections> before);

/// The detector whose words these are: `given`, where that is a name, else by its own name, else by
/// the stem of the file, beside those of the files that were `read` before.
/// Errors: those of DetectorRegistry::add; kInvalidArgument for a file that says another name.
[[nodiscard]] Result<DetectorId> register_detector(const PairedDetections& paired,
                                                   std::string_view given,
                                                   std::span<const DetectorId> read,
                                                   DetectorRegistry& detectors);

}  // namespace hypermap
