// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which detectors a job meets again, and what a network says of itself.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/segmentation/detector_registry.hpp"
#include "hypermap/core/segmentation/stacking.hpp"
#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/io/detector/onnx_detector.hpp"

#include <filesystem>
#include <optional>
#include <vector>

namespace hypermap {

/// The detectors of a map. One of before they were kept has ids in its observation logs alone: each
/// becomes "unnamed detector 0" and so on, so that no detector that comes takes its id.
/// Errors: kLimit for ids from DetectorRegistry::kMaxDetectors on.
[[nodiscard]] Result<DetectorRegistry> known_detectors(const MapArchive& map);

/// The network of a file, called by its stem; its architecture is the form of its outputs.
[[nodiscard]] DetectorDescription described_network(const std::filesystem::path& model,
                                                    const OnnxDetectorOptions& options,
                                                    NetworkForm form);

/// What the rules of stacking need to know of the detectors; the classes of a combiner are added to
/// `classes`. Findings: those of check_weights; rule weighted without any weight; detectors that
/// the combiner does not know. Errors: those of read_combiner and TrainedCombiner::bind;
/// kInvalidArgument, field `stacking.rule`, for rule trained without a combiner, and for a combiner
/// with another rule.
[[nodiscard]] Result<Loaded<StackingModel>> model_of_stacking(
    const StackingOptions& options,
    const std::optional<std::filesystem::path>& combiner,
    const DetectorRegistry& detectors,
    ClassRegistry& classes);

}  // namespace hypermap
