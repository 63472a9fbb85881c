// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How well the voxels of an archive agree with a cloud that somebody labelled.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/evaluation/cloud_evaluation.hpp"
#include "hypermap/core/geometry/frames.hpp"
#include "hypermap/core/vocabulary/class_vocabulary.hpp"
#include "hypermap/io/archive/map_archive.hpp"

#include <cstddef>
#include <filesystem>
#include <optional>

namespace hypermap {

struct CloudEvaluationJob {
  std::filesystem::path map;
  std::filesystem::path cloud;  ///< PCD or PLY (point_cloud_file.hpp).
  /// What its labels mean (label_names_file.hpp); none: as the cloud itself says.
  std::optional<std::filesystem::path> label_names = std::nullopt;
  MapFromInput map_from_cloud = {};  ///< Where the cloud lies in the frame of the map's octree.
  /// What names of classes mean; none: what the map says.
  std::optional<ClassVocabulary> vocabulary = std::nullopt;
  ArchiveLimits limits = {};
  StopCheck stop = {};  ///< Ends loading and counting with kInterrupted.
};

struct CloudEvaluationOutcome {
  CloudEvaluation evaluation = {};
  std::size_t num_unmeasured = 0;  ///< Points of the file that are no measurement.
};

/// Points whose label has no name are of no class.
/// Errors: those of load_archive, read_point_cloud and read_label_names; kNotFound when the map has
/// no octree, the cloud no measured point or no field of labels, or none of its labels has a name
/// (field "labels").
[[nodiscard]] Result<CloudEvaluationOutcome> run_cloud_evaluation(const CloudEvaluationJob& job);

}  // namespace hypermap
