// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// An archive as evaluations see it: shapes, boxes, beliefs, voxels.
#pragma once

#include "hypermap/core/evaluation/object_predictions.hpp"
#include "hypermap/io/archive/map_archive.hpp"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace hypermap {

/// The objects of a layer, the frame in which they are given, and all else of their archive.
struct EvaluatedArchive {
  MapArchive archive = {};
  std::vector<EvaluatedObject> objects = {};
  std::vector<std::uint64_t> ids = {};  ///< Of the objects, in the layer.
  std::string frame_id = {};
};

struct EvaluatedSource {
  std::string layer = {};
  ArchiveLimits limits = {};
  StopCheck stop = {};
};

/// Boxes that the layer does not give are those of the archive's objects of the same ids.
/// Errors: those of load_archive; kNotFound when there is no such layer; kUnsupported when it is no
/// semantic one.
[[nodiscard]] Result<EvaluatedArchive> load_evaluated(const std::filesystem::path& path,
                                                      const EvaluatedSource& source);

/// The same of a map that is to be held against a truth in that frame. Errors: also kUnsupported
/// when the layer is in another one.
[[nodiscard]] Result<EvaluatedArchive> load_in_frame(const std::filesystem::path& path,
                                                     const EvaluatedSource& source,
                                                     const std::string& frame_id);

/// Errors: kNotFound naming a class that is asked for, and of which neither the map nor the truth
/// has an object. `report` is of that map and truth.
[[nodiscard]] Result<void> check_classes(const EvaluationReport& report,
                                         const EvaluationOptions& options,
                                         std::span<const EvaluatedObject> truth);

/// All objects of a map with what it believes; those without a class or a shape are left out.
/// Confirmed ones are those in the layer.
[[nodiscard]] std::vector<BelievedObject> believed_objects(const EvaluatedArchive& map);

}  // namespace hypermap
