// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// An archive as evaluations see it: shapes, boxes, beliefs, voxels.
#pragma once

#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/core/evaluation/map_evaluation.hpp"
#include "hypermap/core/evaluation/object_predictions.hpp"
#include "hypermap/core/geometry/leaf.hpp"
#include "hypermap/core/vocabulary/class_vocabulary.hpp"
#include "hypermap/io/archive/map_archive.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hypermap {

/// The objects of a layer, the frame in which they are given (empty where the file does not say
/// it), and all else of their archive.
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

/// An archive, a bare configuration, or a semantic YAML file by itself, which is the layer,
/// whatever its name, in the frame of what it is held against. Boxes that the layer does not give
/// are those of the archive's objects of the same ids. Errors: those of load_archive and
/// read_semantic_layer; kNotFound when there is no such layer; kUnsupported when it is no semantic
/// one.
[[nodiscard]] Result<EvaluatedArchive> load_evaluated(const std::filesystem::path& path,
                                                      const EvaluatedSource& source);

/// The same of a map that is to be held against a truth in that frame. Errors: also kUnsupported
/// when the layer is in another one.
[[nodiscard]] Result<EvaluatedArchive> load_in_frame(const std::filesystem::path& path,
                                                     const EvaluatedSource& source,
                                                     const std::string& frame_id);

/// Names of classes become what they mean by the vocabulary: in the objects, in the true surfaces,
/// and wherever the archive is asked.
void understand(EvaluatedArchive& evaluated, const ClassVocabulary& vocabulary);

/// Voxels with the classes that their names mean by the archive's vocabulary.
struct UnderstoodVoxels {
  LeafSource leaves;
  ClassRegistry classes;
};
/// Requires: the archive outlives them. Errors: of ClassRegistry::add.
[[nodiscard]] Result<UnderstoodVoxels> understood_voxels(const MapArchive& archive);

/// The vocabulary that was given, else the map's, else the truth's.
[[nodiscard]] ClassVocabulary vocabulary_of(const std::optional<ClassVocabulary>& given,
                                            const MapArchive& map,
                                            const MapArchive& truth);

/// The options with the names that their classes ask for, by the vocabulary of the truth. Errors:
/// of the field `classes`, those of asked_names; kNotFound for a text that asks for the class of no
/// object. Requires: both are understood.
[[nodiscard]] Result<EvaluationOptions> understood_options(const EvaluationOptions& given,
                                                           const EvaluatedArchive& map,
                                                           const EvaluatedArchive& truth);

/// All objects of a map with what it believes; those without a class or a shape are left out.
/// Confirmed ones are those in the layer. Names that mean one class by the archive's vocabulary are
/// one: their probabilities are summed.
[[nodiscard]] std::vector<BelievedObject> believed_objects(const EvaluatedArchive& map);

}  // namespace hypermap
