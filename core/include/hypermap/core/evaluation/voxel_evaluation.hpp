// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How many voxels of a map bear the right class.
///
/// The rule (docs/EVALUATION.md): a voxel lies *at* an object when its centre is no farther than
/// one voxel edge from the triangles of the object.
#pragma once

#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/core/base/load_budget.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/evaluation/true_surfaces.hpp"
#include "hypermap/core/geometry/leaf.hpp"

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace hypermap {

/// Counts of occupied voxels. A *true* voxel lies at an object of a class that the detector can
/// name.
struct VoxelLabelCounts {
  std::size_t labelled = 0;     ///< With a class.
  std::size_t right = 0;        ///< Of these, at an object of that class.
  std::size_t wrong_class = 0;  ///< Of these, else at an object that the detector can name.
  std::size_t true_voxels = 0;  ///< At such objects, labelled or not.
  std::size_t true_right = 0;   ///< Of the true ones, labelled with a class that is right there.
  std::size_t true_unlabelled = 0;  ///< Of the true ones, without a class.

  /// Shares; none where they would divide by 0.
  [[nodiscard]] std::optional<double> precision() const;
  [[nodiscard]] std::optional<double> recall() const;
  /// Of the labelled ones; what precision and this leave to 1 lies at no such object.
  [[nodiscard]] std::optional<double> wrong_class_share() const;
};

/// The same for one class: `labelled`, `right_labels` and `wrong_class` are voxels that bear the
/// class, `true_voxels` and below those whose nearest nameable object is of the class.
struct ClassVoxelCounts {
  std::size_t labelled = 0;
  std::size_t right_labels = 0;
  std::size_t wrong_class = 0;
  std::size_t true_voxels = 0;
  std::size_t found = 0;  ///< Of the true ones, labelled with a class that is right there.
  std::size_t true_unlabelled = 0;
  std::map<std::string, std::size_t> confused_for = {};  ///< Wrong labels of its true voxels.

  [[nodiscard]] std::optional<double> precision() const;
  [[nodiscard]] std::optional<double> recall() const;
  /// The class that most of its true voxels wrongly bear, the first by name of equals.
  [[nodiscard]] std::optional<std::string> most_confused_for() const;
};

/// How much of what was seen of an object's surface the map has as occupied voxels.
struct SurfaceCoverage {
  ObjectId id = kNoObject;
  std::size_t seen_cells = 0;
  std::size_t covered_cells = 0;
  [[nodiscard]] std::optional<double> share() const;
};

struct VoxelEvaluation {
  VoxelLabelCounts all;
  std::map<std::string, ClassVoxelCounts> classes;  ///< By canonical name.
  std::vector<SurfaceCoverage> coverage;            ///< Of each true object, in its order.
};

/// Compares the labels of a map's occupied voxels with the truth. Classes are compared by
/// canonical_class_name; of objects equally near, the class that comes first by name is nearest.
/// A seen cell is covered when the centre of an occupied voxel is no farther from its own than the
/// longer of the two edges.
///
/// Requires: validate(truth); leaves of one edge, whose classes are in `classes`.
/// Errors: kInterrupted when `stop` says so.
/// Cost: triangles times the voxels near each; no triangle meets voxels far from it.
[[nodiscard]] Result<VoxelEvaluation> evaluate_voxels(const LeafSource& leaves,
                                                      const ClassRegistry& classes,
                                                      const TrueSurfaces& truth,
                                                      const StopCheck& stop = {});

}  // namespace hypermap
