// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How much of what stands in a recorded sequence a map of it has.
///
/// Source: docs/EVALUATION.md, "Listed things".
#pragma once

#include "hypermap/core/base/ids.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/evaluation/instance_comparison.hpp"
#include "hypermap/core/evaluation/listed_instances.hpp"
#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/io/dataset/dataset_reader.hpp"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hypermap {

/// Things that a detector named rightly in fewer frames do not count.
inline constexpr std::size_t kMinFramesNamed = 3;

/// The sequence with its detections, to count how often each thing was named.
struct NamingFrames {
  std::filesystem::path input;
  DatasetOptions dataset = {};
};

struct ListedEvaluationJob {
  std::filesystem::path map;
  std::filesystem::path truth;  ///< A list, listed_instances_file.hpp.
  std::optional<NamingFrames> frames = std::nullopt;
  std::string layer = "semantic";  ///< Semantic layer of the map: its confirmed objects.
  InstanceComparisonOptions options = {};
  /// What names of classes mean; none: what the map says.
  std::optional<ClassVocabulary> vocabulary = std::nullopt;
  ArchiveLimits limits = {};
  StopCheck stop = {};  ///< Ends loading, and counting after the frame in hand, with kInterrupted.
};

struct ListedEvaluation {
  ListedInstances listed = {};
  MapFromInput map_from_input = {};              ///< Where the list's world lies in the map.
  std::vector<ComparedInstance> instances = {};  ///< In the order of the list, in the map.
  std::vector<ComparedObject> objects = {};      ///< Of the map.
  std::vector<ObjectId> object_ids = {};         ///< Likewise.
  InstanceComparison comparison = {};
  std::vector<std::size_t> frames_named = {};  ///< Of each thing; empty when not counted.
  std::size_t num_frames = 0;                  ///< That were counted.
  /// The map is of another sequence by its name; frames that could not be read.
  std::vector<Finding> findings = {};
};

/// The list lies in the map as the newest run of its sequence does by its `map_from_input`; where
/// no run is of a dataset of that name, as the only run, which is a finding.
///
/// Errors: those of load_listed_instances, load_archive, validate(options) and open_dataset;
/// kNotFound when the archive lacks the layer, has no provenance, or has several runs and none of
/// the sequence; kUnsupported when the layer is no semantic one or has an object without a box with
/// positive sides; kMalformedFile when the input has no detections.
[[nodiscard]] Result<ListedEvaluation> run_listed_evaluation(const ListedEvaluationJob& job);

}  // namespace hypermap
